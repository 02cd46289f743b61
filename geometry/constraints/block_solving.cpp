// A system solved block by block: each finds its unknowns while those of the blocks before stay as they were found.
// That is the solution with the least change, of those near the start, where each unknown of the over- and well
// determined blocks is held by its block's equations, so that the blocks after have no say in it.
#include <Eigen/Dense>
#include <algorithm>
#include <memory>
#include <optional>

#include "geometry/constraints/constraint_system.h"
#include "geometry/constraints/decomposition.h"

namespace lekalo::geometry {

namespace {

// The equations of a block over its own unknowns; `all` holds the others, and room for these.
ConstraintSystem system_of(const ConstraintSystem& whole, const SystemBlock& block,
                           const std::shared_ptr<std::vector<double>>& all) {
  ConstraintSystem result;
  result.size = whole.size;
  const std::vector<int>& unknowns = block.unknowns;
  for (const int x : unknowns) {
    result.start.push_back(whole.start[static_cast<size_t>(x)]);
    result.weights.push_back(whole.weights[static_cast<size_t>(x)]);
  }
  for (size_t k = 0; k < block.equations.size();) {
    const int number = block.equations[k].constraint;
    const Constraint& full = whole.constraints[static_cast<size_t>(number)];
    std::vector<int> rows;
    for (; k < block.equations.size() && block.equations[k].constraint == number; ++k)
      rows.push_back(block.equations[k].number);
    Constraint part{full.name, static_cast<int>(rows.size()), false, {}, {}};
    for (const int x : full.unknowns) {
      const auto found = std::lower_bound(unknowns.begin(), unknowns.end(), x);
      if (found != unknowns.end() && *found == x) part.unknowns.push_back(static_cast<int>(found - unknowns.begin()));
    }
    part.evaluate = [&full, all, rows, &unknowns](std::span<const double> values, Eigen::Ref<Eigen::VectorXd> f,
                                                  Eigen::Ref<Eigen::MatrixXd> jacobian) {
      for (size_t i = 0; i < unknowns.size(); ++i) (*all)[static_cast<size_t>(unknowns[i])] = values[i];
      Eigen::VectorXd whole_f = Eigen::VectorXd::Zero(full.count);
      Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(full.count, static_cast<Eigen::Index>(all->size()));
      full.evaluate(*all, whole_f, slopes);
      f = whole_f(rows);
      jacobian = slopes(rows, unknowns);
    };
    result.constraints.push_back(std::move(part));
  }
  return result;
}

// All rows of the equations at the unknowns.
void evaluate_all(const ConstraintSystem& system, const std::vector<double>& p, Eigen::VectorXd& f,
                  Eigen::MatrixXd& jacobian) {
  int count = 0;
  for (const Constraint& one : system.constraints) count += one.is_inequality ? 0 : one.count;
  f = Eigen::VectorXd::Zero(count);
  jacobian = Eigen::MatrixXd::Zero(count, static_cast<Eigen::Index>(p.size()));
  int row = 0;
  for (const Constraint& one : system.constraints) {
    if (one.is_inequality) continue;
    one.evaluate(p, f.segment(row, one.count), jacobian.middleRows(row, one.count));
    row += one.count;
  }
}

bool is_violated(const ConstraintSystem& system, const Constraint& inequality, const std::vector<double>& p) {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(1);
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(1, static_cast<Eigen::Index>(p.size()));
  inequality.evaluate(p, f, slopes);
  return !(f[0] > 1e-9 * system.size);
}

// With rank and what follows from it; the multipliers from W (p - start) + J^T l = 0.
ConstraintSolution finished(const ConstraintSystem& system, const std::vector<double>& p, int rank) {
  Eigen::VectorXd f;
  Eigen::MatrixXd jacobian;
  evaluate_all(system, p, f, jacobian);
  const auto n = static_cast<Eigen::Index>(p.size());
  const Eigen::VectorXd by =
      Eigen::Map<const Eigen::VectorXd>(p.data(), n) - Eigen::Map<const Eigen::VectorXd>(system.start.data(), n);
  const auto weights = Eigen::Map<const Eigen::VectorXd>(system.weights.data(), n);
  ConstraintSolution result;
  result.by_blocks = true;
  result.unknowns = p;
  result.change = 0.5 * weights.dot(by.cwiseAbs2());
  result.equations = static_cast<int>(f.size());
  result.rank = rank;
  result.freedom = static_cast<int>(n) - rank;
  result.redundant = result.equations - rank;
  result.residual = f.size() > 0 ? f.lpNorm<Eigen::Infinity>() : 0;
  for (size_t i = 0; i < system.constraints.size(); ++i)
    if (!system.constraints[i].is_inequality) result.active.push_back(static_cast<int>(i));
  if (f.size() == 0) return result;
  const Eigen::VectorXd multipliers =
      jacobian.transpose().completeOrthogonalDecomposition().solve(Eigen::VectorXd(-weights.cwiseProduct(by)));
  result.multipliers.assign(multipliers.data(), multipliers.data() + multipliers.size());
  return result;
}

}  // namespace

std::optional<ConstraintSolution> solved_by_blocks(const ConstraintSystem& system) {
  const std::vector<SystemBlock> blocks = decomposed(system).blocks;
  const auto all = std::make_shared<std::vector<double>>(system.start);
  int rank = 0;
  for (const SystemBlock& block : blocks) {
    if (block.equations.empty()) continue;
    if (block.unknowns.empty()) return std::nullopt;
    try {
      const ConstraintSolution found = solved_as_one(system_of(system, block, all));
      // Numbers that leave an unknown free let the blocks after have a say in it.
      if (block.part != Determined::under && found.freedom > 0) return std::nullopt;
      rank += found.rank;
      for (size_t i = 0; i < block.unknowns.size(); ++i)
        (*all)[static_cast<size_t>(block.unknowns[i])] = found.unknowns[i];
    } catch (const ConstraintError&) {
      return std::nullopt;
    }
  }
  for (const Constraint& one : system.constraints)
    if (one.is_inequality && is_violated(system, one, *all)) return std::nullopt;
  return finished(system, *all, rank);
}

ConstraintSolution solve(const ConstraintSystem& system) {
  const auto by_blocks = solved_by_blocks(system);
  return by_blocks ? *by_blocks : solved_as_one(system);
}

}  // namespace lekalo::geometry
