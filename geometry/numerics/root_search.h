// All solutions of a system of equations in a box of parameters, certified by interval arithmetic (Moore, Kearfott,
// Cloud 2009, chapter 8).
//
// A box X with the middle m is left out where an equation cannot vanish on it, and where Krawczyk's operator
//
//   K(X) = m - C F(m) + (I - C F'(X)) (X - m),   C about the inverse of F'(m),
//
// does not meet it: every solution in X lies in K(X). Where the rows of I - C F'(X), weighed with the sides of X, sum
// up to less than 1, F is one-to-one on X: there is at most one solution, and Newton's iteration, kept inside X, finds
// it or ends on the border with a step left that leads out. Else X is cut to K(X) or halved in the direction in which F
// changes most. What is not decided in the smallest boxes stays open: a multiple solution, several that are nearer to
// each other than that, or a place where F comes near zero but for rounding. Open boxes that touch are one.
//
// With more equations than unknowns C is the pseudo-inverse: the search is for places where the equations hold in the
// sense of least squares, which are solutions where each holds to the tolerance.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/numerics/interval.h"

namespace lekalo::geometry {

template <int N>
using ParameterPoint = std::array<double, N>;
template <int N>
using ParameterBox = std::array<Interval, N>;

// Values of M functions of N parameters and their derivatives, derivative[equation][parameter].
template <class S, int N, int M>
struct SystemValue {
  std::array<S, M> value{};
  std::array<std::array<S, N>, M> derivative{};
};

template <int N, int M>
struct RootSearchOptions {
  // Boxes are not halved below these sides.
  std::array<double, N> least{};
  // So far outside of the box a solution still counts (it is moved to the border).
  std::array<double, N> slack{};
  // An equation holds where it is no larger than this. Zero unless there are more equations than unknowns.
  std::array<double, M> tolerance{};
  // Where more boxes of one size than that may hold solutions these are not isolated, and the boxes are left open.
  int max_boxes = 4096;
};

template <int N>
struct RootSearchResult {
  std::vector<ParameterPoint<N>> isolated;  // one-to-one around each, so simple
  std::vector<ParameterBox<N>> open;        // hulls of what is not decided
  bool complete = true;                     // false where there were more than max_boxes
};

// Hulls of boxes that touch, or nearly (`by`).
template <int N>
std::vector<ParameterBox<N>> joined_boxes(const std::vector<ParameterBox<N>>& boxes, const std::array<double, N>& by) {
  std::vector<ParameterBox<N>> joined;
  for (ParameterBox<N> box : boxes) {
    for (size_t k = 0; k < joined.size();) {
      bool touch = true;
      for (int i = 0; i < N; ++i)
        touch = touch && joined[k][i].lo - by[i] <= box[i].hi && box[i].lo <= joined[k][i].hi + by[i];
      if (!touch) {
        ++k;
        continue;
      }
      for (int i = 0; i < N; ++i) box[i] = hull(box[i], joined[k][i]);
      joined[k] = joined.back();
      joined.pop_back();
      k = 0;
    }
    joined.push_back(box);
  }
  return joined;
}

namespace root_search {

template <int N>
using Matrix = std::array<std::array<double, N>, N>;

// False for a singular matrix.
template <int N>
bool invert(Matrix<N> a, Matrix<N>& inverse) {
  if constexpr (N == 3) {
    // By cofactors, where these do not cancel.
    const auto cofactor = [&](int i, int j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      return a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1];
    };
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) inverse[j][i] = cofactor(i, j);
    double determinant = 0, size = 0;
    for (int j = 0; j < 3; ++j) {
      determinant += a[0][j] * inverse[j][0];
      size += std::abs(a[0][j]) *
              (std::abs(a[1][(j + 1) % 3] * a[2][(j + 2) % 3]) + std::abs(a[1][(j + 2) % 3] * a[2][(j + 1) % 3]));
    }
    if (std::abs(determinant) > 1e-3 * size && std::isfinite(1 / determinant)) {
      for (auto& row : inverse)
        for (double& x : row) x /= determinant;
      return true;
    }
  }
  inverse = {};
  for (int i = 0; i < N; ++i) inverse[i][i] = 1;
  for (int column = 0; column < N; ++column) {
    int pivot = column;
    for (int row = column + 1; row < N; ++row)
      if (std::abs(a[row][column]) > std::abs(a[pivot][column])) pivot = row;
    if (!(std::abs(a[pivot][column]) > 0) || !std::isfinite(a[pivot][column])) return false;
    std::swap(a[pivot], a[column]);
    std::swap(inverse[pivot], inverse[column]);
    const double by = 1 / a[column][column];
    for (int k = 0; k < N; ++k) a[column][k] *= by, inverse[column][k] *= by;
    for (int row = 0; row < N; ++row) {
      if (row == column) continue;
      const double factor = a[row][column];
      if (factor == 0) continue;
      for (int k = 0; k < N; ++k) a[row][k] -= factor * a[column][k], inverse[row][k] -= factor * inverse[column][k];
    }
  }
  for (const auto& row : inverse)
    for (const double x : row)
      if (!std::isfinite(x)) return false;
  return true;
}

// The inverse of a square matrix of derivatives, the pseudo-inverse (J^T J)^-1 J^T of a tall one; false if singular.
template <int N, int M>
bool solve_for(const std::array<std::array<double, N>, M>& j, std::array<std::array<double, M>, N>& c) {
  if constexpr (N == M) {
    return invert<N>(j, c);
  } else {
    Matrix<N> square{}, inverse;
    for (int a = 0; a < N; ++a)
      for (int b = 0; b < N; ++b)
        for (int k = 0; k < M; ++k) square[a][b] += j[k][a] * j[k][b];
    if (!invert<N>(square, inverse)) return false;
    for (int a = 0; a < N; ++a)
      for (int k = 0; k < M; ++k) {
        c[a][k] = 0;
        for (int b = 0; b < N; ++b) c[a][k] += inverse[a][b] * j[k][b];
      }
    return true;
  }
}

template <int N, int M, class System>
class Search {
 public:
  Search(const System& system, const ParameterBox<N>& domain, const RootSearchOptions<N, M>& options)
      : system_(system), domain_(domain), options_(options) {}

  RootSearchResult<N> run(const ParameterBox<N>& start) {
    // Level by level: what is isolated stays few, what is not shows soon.
    std::vector<ParameterBox<N>> level{start};
    while (!level.empty()) {
      if (static_cast<int>(level.size()) > options_.max_boxes) {
        result_.complete = false;
        result_.open.insert(result_.open.end(), level.begin(), level.end());
        break;
      }
      boxes_.clear();
      for (const ParameterBox<N>& box : level) visit(box);
      level.swap(boxes_);
    }
    join_open();
    return std::move(result_);
  }

 private:
  using Inverse = std::array<std::array<double, M>, N>;

  void visit(ParameterBox<N> box) {
    for (int again = 0; again < kMaxCuts; ++again) {
      const SystemValue<Interval, N, M> range = system_.enclose(box);
      for (int k = 0; k < M; ++k)
        if (range.value[k].lo > options_.tolerance[k] || range.value[k].hi < -options_.tolerance[k]) return;
      Inverse c;
      ParameterPoint<N> middle;
      for (int i = 0; i < N; ++i) middle[i] = box[i].middle();
      const SystemValue<double, N, M> there = system_.evaluate(middle);
      if (!solve_for<N, M>(there.derivative, c)) return divide(box, range);
      // The rows of |I - C F'(X)| times the half sides.
      std::array<double, N> reach{};
      double shrinks = 0;
      bool finite = true;
      for (int i = 0; i < N; ++i) {
        for (int j = 0; j < N; ++j) {
          Interval e = i == j ? Interval(1) : Interval(0);
          for (int k = 0; k < M; ++k) e -= Interval(c[i][k]) * range.derivative[k][j];
          reach[i] = next_up(reach[i] + next_up(magnitude(e) * half(box[j])));
        }
        finite = finite && std::isfinite(reach[i]);
        const double side = half(box[i]);
        shrinks = std::max(shrinks, side > 0 ? reach[i] / side : reach[i] > 0 ? 2.0 : 0.0);
      }
      if (!finite) return divide(box, range);
      if (shrinks < kOneToOne) {
        if (follow(box, middle, c)) return;
        return divide(box, range);
      }
      const std::array<Interval, M> at_middle = values(thin(middle));
      ParameterBox<N> cut;
      for (int i = 0; i < N; ++i) {
        Interval newton(middle[i]);
        for (int k = 0; k < M; ++k)
          newton -= Interval(c[i][k]) * hull(at_middle[k] - Interval(options_.tolerance[k]),
                                             at_middle[k] + Interval(options_.tolerance[k]));
        cut[i] = intersect(box[i], newton + Interval(-reach[i], reach[i]));
        if (cut[i].empty()) return;
      }
      double volume = 1;
      for (int i = 0; i < N; ++i) volume *= box[i].width() > 0 ? cut[i].width() / box[i].width() : 1.0;
      box = cut;
      if (volume > kWorthCutting) return divide(box, range);
    }
    boxes_.push_back(box);
  }

  std::array<Interval, M> values(const ParameterBox<N>& box) const {
    if constexpr (requires { system_.values(box); })
      return system_.values(box);
    else
      return system_.enclose(box).value;
  }

  static double half(const Interval& x) { return next_up(0.5 * x.width()); }
  static ParameterBox<N> thin(const ParameterPoint<N>& place) {
    ParameterBox<N> box;
    for (int i = 0; i < N; ++i) box[i] = Interval(place[i]);
    return box;
  }

  // F is one-to-one on the box: keeps the solution that it has, if any. False where no iteration converges.
  bool follow(const ParameterBox<N>& box, ParameterPoint<N> x, const Inverse& c) {
    // Newton's iteration is soon there if there is a solution: until its steps are rounding and no longer get shorter.
    double before = kInfinity;
    for (int step = 0; step < kMaxNewtonSteps; ++step) {
      Inverse own;
      const SystemValue<double, N, M> there = system_.evaluate(x);
      if (!solve_for<N, M>(there.derivative, own)) break;
      const Step next = stepped(box, x, own, there);
      x = next.to;
      const bool settled = next.length <= kSettled || (next.length <= kNearlySettled && next.length > 0.5 * before);
      before = next.length;
      if (!settled) continue;
      if (next.leads_out) break;
      if (holds(x)) keep(x, next.moved_back);
      return true;
    }
    // With C kept the step, moved back to the box, is a contraction: after so many it stands at the solution, or there
    // is none.
    Step last;
    for (int step = 0; step < kMaxSteps; ++step) {
      last = stepped(box, x, c, system_.evaluate(x));
      x = last.to;
      if (last.length <= kSettled) break;
    }
    if (!(last.length <= kNearlySettled)) return false;
    if (!last.leads_out && holds(x)) keep(x, last.moved_back);
    return true;
  }

  struct Step {
    ParameterPoint<N> to;
    double length = 0;      // the longest of all parameters, of the domain's sides
    double moved_back = 0;  // to the box, likewise
    bool leads_out = false;
  };
  Step stepped(const ParameterBox<N>& box, const ParameterPoint<N>& x, const Inverse& c,
               const SystemValue<double, N, M>& there) const {
    Step step;
    for (int i = 0; i < N; ++i) {
      double free = x[i];
      for (int k = 0; k < M; ++k) free -= c[i][k] * there.value[k];
      step.to[i] = box[i].clamp(free);
      step.length = std::max(step.length, std::abs(step.to[i] - x[i]) / domain_[i].width());
      step.moved_back = std::max(step.moved_back, std::abs(free - step.to[i]) / domain_[i].width());
      step.leads_out = step.leads_out || !(std::abs(free - step.to[i]) <= options_.slack[i]);
    }
    return step;
  }

  bool holds(const ParameterPoint<N>& x) const {
    if constexpr (N == M) return true;
    const SystemValue<double, N, M> there = system_.evaluate(x);
    for (int k = 0; k < M; ++k)
      if (!(std::abs(there.value[k]) <= options_.tolerance[k])) return false;
    return true;
  }

  // Neighbouring boxes both find what lies on their border or next to it: that counts in whose box it lies.
  void keep(const ParameterPoint<N>& x, double moved_back) {
    for (size_t k = 0; k < result_.isolated.size(); ++k) {
      ParameterPoint<N>& other = result_.isolated[k];
      bool same = true;
      for (int i = 0; i < N; ++i) same = same && std::abs(other[i] - x[i]) <= 2 * options_.slack[i];
      if (!same) continue;
      if (moved_back < moved_back_[k]) other = x, moved_back_[k] = moved_back;
      return;
    }
    result_.isolated.push_back(x);
    moved_back_.push_back(moved_back);
  }

  void divide(const ParameterBox<N>& box, const SystemValue<Interval, N, M>& range) {
    int best = -1;
    double most = -1;
    for (int i = 0; i < N; ++i) {
      if (box[i].width() <= options_.least[i]) continue;
      // By the share of each equation's change that this parameter makes.
      double change = 0;
      for (int k = 0; k < M; ++k) {
        double all = 0;
        for (int j = 0; j < N; ++j) all += magnitude(range.derivative[k][j]) * box[j].width();
        const double own = magnitude(range.derivative[k][i]) * box[i].width();
        change = std::max(change, std::isfinite(all) && all > 0 ? own / all : 1.0);
      }
      const double side = domain_[i].width() > 0 ? box[i].width() / domain_[i].width() : 0;
      const double weight = change + 1e-3 * std::sqrt(side);
      if (weight > most) best = i, most = weight;
    }
    if (best < 0) {
      result_.open.push_back(box);
      return;
    }
    const double middle = box[best].middle();
    ParameterBox<N> lower = box, upper = box;
    lower[best].hi = middle;
    upper[best].lo = middle;
    boxes_.push_back(upper);
    boxes_.push_back(lower);
  }

  // Isolated solutions inside of an open box belong to it.
  void join_open() {
    std::vector<ParameterBox<N>> joined = joined_boxes<N>(result_.open, options_.least);
    std::erase_if(result_.isolated, [&](const ParameterPoint<N>& x) {
      return std::any_of(joined.begin(), joined.end(), [&](const ParameterBox<N>& box) {
        for (int i = 0; i < N; ++i)
          if (x[i] < box[i].lo - options_.least[i] || x[i] > box[i].hi + options_.least[i]) return false;
        return true;
      });
    });
    result_.open = std::move(joined);
  }

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr double kSettled = 1e-15, kNearlySettled = 1e-8;
  static constexpr double kOneToOne = 0.9;      // rows that sum up to less, so that rounding does not matter
  static constexpr double kWorthCutting = 0.5;  // of the volume: a cut that leaves more is followed by a halving
  static constexpr int kMaxCuts = 20;
  static constexpr int kMaxNewtonSteps = 20;
  static constexpr int kMaxSteps = 400;  // 0.9^400 is less than the rounding of a double

  const System& system_;
  const ParameterBox<N> domain_;
  const RootSearchOptions<N, M>& options_;
  std::vector<ParameterBox<N>> boxes_;
  RootSearchResult<N> result_;
  std::vector<double> moved_back_;  // of each isolated root: how far from where the iteration led
};

}  // namespace root_search

// `system` has the members
//   SystemValue<Interval, N, M> enclose(const ParameterBox<N>&) const      certified ranges over a box in the domain
//   SystemValue<double, N, M> evaluate(const ParameterPoint<N>&) const     the same at a place, to rounding
// and where the values of enclose() alone are had for less
//   std::array<Interval, M> values(const ParameterBox<N>&) const
template <int N, int M, class System>
RootSearchResult<N> search_roots(const System& system, const ParameterBox<N>& domain,
                                 const RootSearchOptions<N, M>& options) {
  return root_search::Search<N, M, System>(system, domain, options).run(domain);
}
// Only in `part` of the domain, whose sides are what Newton's steps are measured by.
template <int N, int M, class System>
RootSearchResult<N> search_roots(const System& system, const ParameterBox<N>& domain,
                                 const RootSearchOptions<N, M>& options, const ParameterBox<N>& part) {
  return root_search::Search<N, M, System>(system, domain, options).run(part);
}

}  // namespace lekalo::geometry
