#include "geometry/constraints/constraint_system.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

namespace lekalo::geometry {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxSteps = 60, kMaxHalvings = 30;
constexpr double kMet = 1e-11;       // of a residual, relative to the size
constexpr double kRounding = 4e-15;  // of a residual, relative to the unknowns times its slopes
constexpr double kStep = 1e-13;      // of the last step, relative to the size
constexpr double kLongest = 2;       // of a step of least norm, relative to the size and the unknowns
constexpr double kAside =
    0.01;  // of the size: a step from where the conditions have no slope; at most that, as angles are unknowns too
constexpr double kRank = 1e-9;        // of singular values
constexpr double kDifference = 1e-6;  // of the unknowns, for second derivatives: they only steer the steps

struct Values {
  VectorXd f;
  MatrixXd jacobian;
};

// Where the gradient of the change is a combination of those of the equations.
struct Stationary {
  VectorXd p, multipliers;
};

// An orthonormal basis, one vector a column.
MatrixXd null_space(const MatrixXd& jacobian) {
  const Eigen::Index n = jacobian.cols();
  if (jacobian.rows() == 0) return MatrixXd::Identity(n, n);
  Eigen::ColPivHouseholderQR<MatrixXd> qr(jacobian.transpose());
  qr.setThreshold(kRank);
  return MatrixXd(qr.householderQ()).rightCols(n - qr.rank());
}

class Solving {
 public:
  explicit Solving(const ConstraintSystem& system) : system_(system), n_(static_cast<int>(system.start.size())) {
    start_ = Eigen::Map<const VectorXd>(system.start.data(), n_);
    weights_ = Eigen::Map<const VectorXd>(system.weights.data(), n_);
    for (size_t i = 0; i < system.constraints.size(); ++i)
      if (!system.constraints[i].is_inequality) active_.push_back(static_cast<int>(i));
  }

  ConstraintSolution run() {
    // Each round one inequality begins or ceases to be an equation.
    const size_t rounds = 4 * system_.constraints.size() + 4;
    for (size_t round = 0; round < rounds; ++round) {
      const VectorXd p = least_change_of_some();
      if (!change_active(p)) return finish(p);
    }
    throw ConstraintError("no set of inequalities was found that holds with equality", names_of(active_));
  }

  Values values(const VectorXd& p, const std::vector<int>& which) const {
    int count = 0;
    for (const int i : which) count += system_.constraints[i].count;
    Values result{VectorXd::Zero(count), MatrixXd::Zero(count, n_)};
    int row = 0;
    for (const int i : which) {
      const Constraint& one = system_.constraints[i];
      one.evaluate(std::span(p.data(), n_), result.f.segment(row, one.count),
                   result.jacobian.middleRows(row, one.count));
      row += one.count;
    }
    return result;
  }

 private:
  // What is left of each number that counts as 0: a share of the size, and what rounding of large unknowns leaves.
  VectorXd tolerances(const VectorXd& p, const MatrixXd& jacobian) const {
    return (kRounding * (jacobian.cwiseAbs() * p.cwiseAbs())).array() + kMet * system_.size;
  }
  bool is_met(const VectorXd& p, const Values& at) const {
    return at.f.allFinite() && (at.f.cwiseAbs().array() <= tolerances(p, at.jacobian).array()).all();
  }

  std::vector<std::string> names_of(const std::vector<int>& which) const {
    std::vector<std::string> names;
    for (const int i : which) names.push_back(system_.constraints[i].name);
    return names;
  }

  double change(const VectorXd& p) const { return 0.5 * weights_.dot((p - start_).cwiseAbs2()); }

  VectorXd least_change() {
    std::optional<Stationary> best = lagrange(start_);
    if (!best || way_down(*best)) {
      // Least only to first order, or none: from a solution near the start, and down from what is found.
      const auto keep = [&](const std::optional<Stationary>& one) {
        if (one && (!best || change(one->p) < change(best->p))) best = one;
      };
      auto [feasible, at] = min_norm(start_);
      // Where all ways look alike, as from a circle's centre, a step aside, the same each time.
      if (!is_met(feasible, at) && !best) {
        auto [other, there] = min_norm(aside(feasible));
        if (is_met(other, there)) feasible = std::move(other), at = std::move(there);
      }
      if (is_met(feasible, at))
        keep(lagrange(feasible));
      else if (!best)
        refuse(feasible, at);
      // A solution, if not the nearest.
      if (!best) best = Stationary{feasible, VectorXd::Zero(at.f.size())};
      if (const auto way = way_down(*best)) {
        const VectorXd top = best->p;
        for (const double length : {0.1, -0.1, 0.3, -0.3, 1.0, -1.0, 3.0, -3.0}) {
          const auto [foot, there] = min_norm(top + length * system_.size * *way);
          if (is_met(foot, there)) keep(lagrange(foot));
        }
      }
    }
    multipliers_ = best->multipliers;
    return best->p;
  }

  // Without one of the inequalities, or all but the newest, where they cannot all be equations; it comes back if it is
  // violated then. No set is tried twice.
  VectorXd least_change_of_some() {
    std::vector<std::vector<int>> sets{active_};
    const auto is_old = [&](int i) { return system_.constraints[i].is_inequality && i != newest_; };
    for (const int one : active_) {
      if (!is_old(one)) continue;
      sets.push_back(active_);
      std::erase(sets.back(), one);
    }
    if (sets.size() > 2) {
      sets.push_back(active_);
      std::erase_if(sets.back(), is_old);
    }
    std::exception_ptr first;
    for (const std::vector<int>& set : sets) {
      active_ = set;
      if (std::vector<int> sorted = set;
          std::sort(sorted.begin(), sorted.end()), !tried_.insert(sorted).second && first)
        continue;
      try {
        return least_change();
      } catch (const ConstraintError&) {
        if (!first) first = std::current_exception();
      }
    }
    std::rethrow_exception(first);
  }

  VectorXd aside(VectorXd p) const {
    for (int i = 0; i < n_; ++i) {
      const double golden = 0.6180339887498949 * (i + 1);
      p[i] += kAside * std::min(system_.size, 1.0) * (0.5 + golden - std::floor(golden));
    }
    return p;
  }

  // A direction in which the equations let the change fall; nothing where the change is least among its neighbours:
  // where W + curvature is positive on the null space of the Jacobian.
  std::optional<VectorXd> way_down(const Stationary& at) const {
    const MatrixXd jacobian = values(at.p, active_).jacobian;
    MatrixXd hessian = curvature(at.p, at.multipliers);
    hessian.diagonal() += weights_;
    const MatrixXd directions = null_space(jacobian);
    if (directions.cols() == 0) return std::nullopt;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(directions.transpose() * hessian * directions);
    if (!(solver.eigenvalues()[0] < -1e-6 * weights_.maxCoeff())) return std::nullopt;
    return VectorXd(directions * solver.eigenvectors().col(0));
  }

  // Sum of the multipliers times second derivatives, by differences of the gradients.
  MatrixXd curvature(const VectorXd& p, const VectorXd& multipliers) const {
    MatrixXd result = MatrixXd::Zero(n_, n_);
    VectorXd moved = p;
    int row = 0;
    for (const int number : active_) {
      const Constraint& one = system_.constraints[number];
      for (const int i : one.unknowns) {
        const double h = std::max(kDifference * system_.size, 1e-4 * kDifference * std::abs(p[i]));
        moved[i] = p[i] + h;
        const MatrixXd after = values(moved, {number}).jacobian;
        moved[i] = p[i] - h;
        const MatrixXd before = values(moved, {number}).jacobian;
        moved[i] = p[i];
        for (const int j : one.unknowns)
          result(j, i) += (after.col(j) - before.col(j)).dot(multipliers.segment(row, one.count)) / (2 * h);
      }
      row += one.count;
    }
    return 0.5 * (result + result.transpose());
  }

  // Newton's method for p and the multipliers: W (p - start) + J^T l = 0, f(p) = 0.
  std::optional<Stationary> lagrange(VectorXd p) const {
    Values at = values(p, active_);
    const int m = static_cast<int>(at.f.size());
    VectorXd multipliers = VectorXd::Zero(m);
    if (m > 0 && p != start_)
      multipliers = at.jacobian.transpose().completeOrthogonalDecomposition().solve(
          VectorXd(-(weights_.cwiseProduct(p - start_))));
    for (int step = 0; step < kMaxSteps; ++step) {
      MatrixXd matrix = MatrixXd::Zero(n_ + m, n_ + m);
      matrix.topLeftCorner(n_, n_) = curvature(p, multipliers);
      matrix.topLeftCorner(n_, n_).diagonal() += weights_;
      matrix.topRightCorner(n_, m) = at.jacobian.transpose();
      matrix.bottomLeftCorner(m, n_) = at.jacobian;
      VectorXd right(n_ + m);
      right.head(n_) = -(weights_.cwiseProduct(p - start_) + at.jacobian.transpose() * multipliers);
      right.tail(m) = -at.f;
      Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver(matrix);
      solver.setThreshold(kRank);
      const VectorXd by = solver.solve(right);
      if (!by.allFinite()) return std::nullopt;
      p += by.head(n_), multipliers += by.tail(m);
      at = values(p, active_);
      if (!at.f.allFinite() || by.head(n_).norm() > 1e3 * (system_.size + start_.norm())) return std::nullopt;
      if (is_met(p, at) && by.head(n_).lpNorm<Eigen::Infinity>() <= kStep * (system_.size + p.norm()))
        return Stationary{p, multipliers};
    }
    // Where second derivatives by differences leave the last digits to a slow end.
    if (!is_met(p, at)) return std::nullopt;
    return Stationary{p, multipliers};
  }

  // Steps of least norm, each halved until the residual falls: as near to a solution as they come.
  std::pair<VectorXd, Values> min_norm(VectorXd p) const {
    Values at = values(p, active_);
    const VectorXd inverse = weights_.cwiseInverse();
    for (int step = 0; step < kMaxSteps && !is_met(p, at); ++step) {
      const MatrixXd scaled = at.jacobian * inverse.cwiseSqrt().asDiagonal();
      Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver(scaled);
      solver.setThreshold(kRank);
      const VectorXd by = inverse.cwiseSqrt().cwiseProduct(VectorXd(solver.solve(VectorXd(-at.f))));
      // A slope near none asks for any length.
      double share = std::min(1.0, kLongest * (system_.size + p.norm()) / by.norm());
      Values next = values(p + share * by, active_);
      for (int k = 0; k < kMaxHalvings && !(next.f.norm() < at.f.norm()); ++k) {
        share /= 2;
        next = values(p + share * by, active_);
      }
      if (!(next.f.norm() < at.f.norm() * (1 - 1e-12))) break;
      p += share * by, at = std::move(next);
    }
    return {p, at};
  }

  [[noreturn]] void refuse(const VectorXd& p, const Values& at) const {
    const VectorXd tolerance = tolerances(p, at.jacobian);
    std::vector<std::pair<double, std::string>> unmet;
    int row = 0;
    for (const int i : active_) {
      const Constraint& one = system_.constraints[i];
      const double worst = at.f.segment(row, one.count).lpNorm<Eigen::Infinity>();
      if ((at.f.segment(row, one.count).cwiseAbs().array() > tolerance.segment(row, one.count).array()).any())
        unmet.emplace_back(worst, one.name);
      row += one.count;
    }
    std::stable_sort(unmet.begin(), unmet.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::string> names;
    for (const auto& [worst, name] : unmet) names.push_back(name);
    const bool conflict = (at.jacobian.transpose() * at.f).norm() <= 1e-6 * at.f.norm() * at.jacobian.norm();
    throw ConstraintError(
        fmt::format("{} ({:.3g} is left of {})",
                    conflict ? "the conditions contradict each other" : "no solution was found",
                    unmet.empty() ? 0.0 : unmet.front().first, names.empty() ? "them" : "'" + names.front() + "'"),
        names);
  }

  // True if an inequality began to be an equation, or ceased to.
  bool change_active(const VectorXd& p) {
    int worst = -1;
    double least = 0;
    for (size_t i = 0; i < system_.constraints.size(); ++i) {
      if (!system_.constraints[i].is_inequality ||
          std::find(active_.begin(), active_.end(), static_cast<int>(i)) != active_.end())
        continue;
      const Values at = values(p, {static_cast<int>(i)});
      if (!(at.f[0] < -tolerances(p, at.jacobian)[0])) continue;
      // As far as the unknowns must go, not as large as the formula is written.
      const double slope = at.jacobian.norm(), f = slope > 0 ? at.f[0] / slope : at.f[0];
      if (f < least) least = f, worst = static_cast<int>(i);
    }
    if (worst >= 0) {
      active_.push_back(worst);
      newest_ = worst;
      return true;
    }
    // W dp = -J^T l: an inequality f >= 0 pushes along its gradient, l < 0.
    int row = 0;
    for (size_t k = 0; k < active_.size(); ++k) {
      const Constraint& one = system_.constraints[active_[k]];
      if (one.is_inequality && multipliers_[row] > 1e-9 * system_.size && !left_[active_[k]]) {
        left_[active_[k]] = true;
        active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(k));
        return true;
      }
      row += one.count;
    }
    return false;
  }

  ConstraintSolution finish(const VectorXd& p) const {
    const Values at = values(p, active_);
    ConstraintSolution result;
    result.unknowns.assign(p.data(), p.data() + n_);
    result.active = active_;
    result.change = change(p);
    result.equations = static_cast<int>(at.f.size());
    result.rank = rank_of(at.jacobian);
    result.freedom = n_ - result.rank;
    result.redundant = result.equations - result.rank;
    result.residual = at.f.size() > 0 ? at.f.lpNorm<Eigen::Infinity>() : 0;
    result.multipliers.assign(multipliers_.data(), multipliers_.data() + multipliers_.size());
    return result;
  }

 public:
  static int rank_of(const MatrixXd& jacobian) {
    if (jacobian.size() == 0) return 0;
    const VectorXd values = Eigen::BDCSVD<MatrixXd>(jacobian).singularValues();
    return static_cast<int>((values.array() > kRank * std::max(values[0], 1e-300)).count());
  }

 private:
  const ConstraintSystem& system_;
  int n_;
  VectorXd start_, weights_, multipliers_;
  std::vector<int> active_;
  int newest_ = -1;                   // the last inequality that became an equation
  std::set<std::vector<int>> tried_;  // sets of equations
  std::map<int, bool> left_;  // inequalities that ceased to be equations once: each does so once, or it might go round
};

}  // namespace

ConstraintSolution solved_as_one(const ConstraintSystem& system) { return Solving(system).run(); }

int jacobian_rank(const ConstraintSystem& system, std::span<const double> unknowns) {
  std::vector<int> equations;
  for (size_t i = 0; i < system.constraints.size(); ++i)
    if (!system.constraints[i].is_inequality) equations.push_back(static_cast<int>(i));
  const VectorXd p = Eigen::Map<const VectorXd>(unknowns.data(), static_cast<int>(unknowns.size()));
  return Solving::rank_of(Solving(system).values(p, equations).jacobian);
}

Eigen::MatrixXd allowed_velocities(const ConstraintSystem& system, const ConstraintSolution& solution) {
  const VectorXd p = Eigen::Map<const VectorXd>(solution.unknowns.data(), static_cast<int>(solution.unknowns.size()));
  return null_space(Solving(system).values(p, solution.active).jacobian);
}

}  // namespace lekalo::geometry
