// Adaptive integration: the cell with the largest error is split until the goal is met. Value: Kronrod's 15 points.
// Error, QUADPACK's: with d = |Kronrod - Gauss| and a = integral of |f - mean f|, it is a min(1, (200 d / a)^(3/2)),
// since the Kronrod rule is much better than the Gauss rule it is compared with.
//
// A node where an integrand is not finite tells nothing about its integral: |x|^(-1/2) has one over [-1, 1]. Its cell
// is split, which makes the place an end, where no rule has nodes, or leaves it between them; the halves get finer
// there as their errors ask. A cell too narrow to be split, whose nodes may be rounded onto the place, counts without
// them. What such a cell misses is of the order of what it holds.
#include "geometry/numerics/quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>

namespace lekalo::geometry {
namespace {

constexpr int kPoints = 15;
constexpr int kMiddle = 7;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// Positive half of the 15 Kronrod nodes, outermost first; every second is a node of the 7-point Gauss rule.
constexpr std::array<double, 8> kKronrodNodes{0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                                              0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                                              0.586087235467691130294144691693361, 0.405845151377397166906606412076961,
                                              0.207784955007898467600689403773245, 0.0};
constexpr std::array<double, 8> kKronrodWeights{
    0.022935322010529224963732008058970, 0.063092092629978553290700663189204, 0.104790010322250183839876322541518,
    0.140653259715525918745189590510238, 0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
    0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
constexpr std::array<double, 4> kGaussWeights{0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
                                              0.381830050505118944950369775488975, 0.417959183673469387755102040816327};

struct Node {
  double x, kronrod, gauss;
};
constexpr Node node(int i) {
  const int half = i <= kMiddle ? i : 2 * kMiddle - i;
  return {i <= kMiddle ? -kKronrodNodes[half] : kKronrodNodes[half], kKronrodWeights[half],
          half % 2 == 1 ? kGaussWeights[half / 2] : 0.0};
}

// A part of the domain; one-dimensional ones have a v of zero width.
struct Cell {
  Interval u, v;
  std::vector<double> value, error, size;  // by integrand; size is the integral of |f|
  bool split_u = true;
  double priority = 0;
  std::size_t unknown = 0;  // values that are not finite
};
bool operator<(const Cell& a, const Cell& b) { return a.priority < b.priority; }

double error_estimate(double difference, double spread, double size) {
  double error = difference;
  if (spread > 0 && difference > 0) error = spread * std::min(1.0, std::pow(200 * difference / spread, 1.5));
  return std::max(error, 50 * kEpsilon * size);
}

// The tensor rule on a cell: Kronrod in both directions, and Gauss in one direction against it. `rows` is kPoints for a
// rectangle and 1 (with weight 1) for an interval.
template <class Evaluate>
void apply_rule(Cell& cell, int count, int rows, Evaluate evaluate, std::vector<double>& f) {
  const double u_middle = 0.5 * (cell.u.lo + cell.u.hi), u_half = 0.5 * cell.u.width();
  const double v_middle = 0.5 * (cell.v.lo + cell.v.hi), v_half = 0.5 * cell.v.width();
  const double measure = rows == 1 ? u_half : u_half * v_half;
  f.resize(static_cast<std::size_t>(rows) * kPoints * count);
  for (int j = 0; j < rows; ++j) {
    const double v = rows == 1 ? v_middle : v_middle + v_half * node(j).x;
    for (int i = 0; i < kPoints; ++i) {
      evaluate(u_middle + u_half * node(i).x, v, std::span<double>(&f[(j * kPoints + i) * count], count));
    }
  }
  cell.value.resize(count), cell.error.resize(count), cell.size.resize(count);
  std::array<bool, kPoints> bad_u{}, bad_v{};
  for (std::size_t n = 0; n < f.size(); ++n)
    if (!std::isfinite(f[n])) {
      bad_u[n / count % kPoints] = bad_v[n / count / kPoints] = true;
      f[n] = 0;
      ++cell.unknown;
    }
  const auto bad_columns = std::count(bad_u.begin(), bad_u.end(), true),
             bad_rows = std::count(bad_v.begin(), bad_v.end(), true);
  double worst_u = 0, worst_v = 0;
  for (int k = 0; k < count; ++k) {
    const auto sum = [&](auto term) {
      double total = 0;
      for (int j = 0; j < rows; ++j) {
        const Node q = rows == 1 ? Node{0, 1, 1} : node(j);
        for (int i = 0; i < kPoints; ++i) total += term(node(i), q, f[(j * kPoints + i) * count + k]);
      }
      return total * measure;
    };
    const double value = sum([](const Node& p, const Node& q, double x) { return p.kronrod * q.kronrod * x; });
    const double gauss_u = sum([](const Node& p, const Node& q, double x) { return p.gauss * q.kronrod * x; });
    const double gauss_v = sum([](const Node& p, const Node& q, double x) { return p.kronrod * q.gauss * x; });
    const double size =
        sum([](const Node& p, const Node& q, double x) { return p.kronrod * q.kronrod * std::fabs(x); });
    const double mean = value / (measure * (rows == 1 ? 2 : 4));
    const double spread =
        sum([mean](const Node& p, const Node& q, double x) { return p.kronrod * q.kronrod * std::fabs(x - mean); });
    const double u_error = error_estimate(std::fabs(value - gauss_u), spread, size);
    const double v_error = rows == 1 ? 0.0 : error_estimate(std::fabs(value - gauss_v), spread, size);
    cell.value[k] = value, cell.size[k] = size;
    cell.error[k] = u_error + v_error;
    if (size > 0) worst_u = std::max(worst_u, u_error / size), worst_v = std::max(worst_v, v_error / size);
  }
  if (cell.unknown > 0) {
    cell.split_u = rows == 1 || bad_columns <= bad_rows;  // a column of them is a line across u
    cell.error = cell.size;
  } else {
    cell.split_u = worst_u >= worst_v;
  }
}

template <class Evaluate>
class Adaptive {
 public:
  Adaptive(Evaluate evaluate, int count, int rows, const IntegrationGoal& goal)
      : evaluate_(evaluate), count_(count), rows_(rows), goal_(goal), error_(count), size_(count), stuck_(count) {}

  Integral run(std::span<const double> u_breaks, std::span<const double> v_breaks) {
    std::vector<Cell> first;
    for (std::size_t j = 0; j + 1 < v_breaks.size(); ++j) {
      for (std::size_t i = 0; i + 1 < u_breaks.size(); ++i) {
        if (u_breaks[i] == u_breaks[i + 1] || (rows_ > 1 && v_breaks[j] == v_breaks[j + 1])) continue;
        first.push_back(measured({u_breaks[i], u_breaks[i + 1]}, {v_breaks[j], v_breaks[j + 1]}));
      }
    }
    for (Cell& cell : first) push(std::move(cell));
    while (!done() && result_.evaluations < goal_.evaluations && !cells_.empty() && cells_.top().priority > 0) {
      const Cell cell = cells_.top();
      cells_.pop();
      if (cell.unknown > 0) --unknown_;
      for (int k = 0; k < count_; ++k) error_[k] -= cell.error[k], size_[k] -= cell.size[k];
      const Interval& side = cell.split_u ? cell.u : cell.v;
      const double middle = side.middle();
      for (const Interval& half : {Interval{side.lo, middle}, Interval{middle, side.hi}}) {
        push(cell.split_u ? measured(half, cell.v) : measured(cell.u, half));
      }
    }
    return total();
  }

 private:
  Cell measured(const Interval& u, const Interval& v) {
    Cell cell{u, v, {}, {}, {}};
    apply_rule(cell, count_, rows_, evaluate_, scratch_);
    result_.evaluations += kPoints * rows_;
    if (cell.unknown > 0) ++unknown_;
    for (int k = 0; k < count_; ++k) error_[k] += cell.error[k], size_[k] += cell.size[k];
    return cell;
  }

  // Cells whose error is all rounding, or that have become too narrow to split, have priority zero.
  void push(Cell cell) {
    const Interval& side = cell.split_u ? cell.u : cell.v;
    const bool splittable = side.width() > 64 * kEpsilon * magnitude(side);
    if (cell.unknown > 0 && splittable) {
      cell.priority = std::numeric_limits<double>::infinity();
    } else if (cell.unknown > 0) {
      if (2 * cell.unknown > scratch_.size()) is_hopeless_ = true;
      --unknown_;
    }
    for (int k = 0; k < count_; ++k) {
      if (!(cell.error[k] > std::max(101 * kEpsilon * cell.size[k], goal_.noise * cell.size[0]))) continue;
      if (splittable) {
        cell.priority = std::max(cell.priority, cell.error[k] / goal_of(k));
      } else {
        error_[k] += 2 * cell.size[k] - cell.error[k];
        stuck_[k] += cell.error[k] = 2 * cell.size[k];
      }
    }
    cells_.push(std::move(cell));
  }

  double goal_of(int k) const {
    return std::max(
        {goal_.absolute, goal_.relative * size_[k], goal_.noise * size_[0], std::numeric_limits<double>::min()});
  }
  // Also when an integrand is not finite in many places, or the sums are not: nothing can mend that.
  bool is_lost() const { return is_hopeless_ || unknown_ > kMaxUnknown; }
  bool done() const {
    if (is_lost() || unknown_ > 0) return is_lost();
    for (int k = 0; k < count_; ++k) {
      if (!std::isfinite(error_[k])) return true;
    }
    for (int k = 0; k < count_; ++k) {
      if (!(error_[k] <= std::max(goal_of(k), 1.01 * stuck_[k])))
        return false;  // what is left can only get little better
    }
    return true;
  }

  // Running totals have drifted: the sums are formed afresh, with compensation (Neumaier 1974).
  Integral total() {
    result_.value.assign(count_, 0), result_.error.assign(count_, 0);
    std::vector<double> lost(count_, 0.0), size(count_, 0.0);
    for (; !cells_.empty(); cells_.pop()) {
      const Cell& cell = cells_.top();
      for (int k = 0; k < count_; ++k) {
        const double before = result_.value[k], x = cell.value[k], sum = before + x;
        lost[k] += std::fabs(before) >= std::fabs(x) ? (before - sum) + x : (x - sum) + before;
        result_.value[k] = sum;
        result_.error[k] += cell.error[k];
        size[k] += cell.size[k];
      }
    }
    result_.converged = true;
    for (int k = 0; k < count_; ++k) {
      result_.value[k] += lost[k];
      const double goal = std::max({goal_.absolute, goal_.relative * size[k], goal_.noise * size[0]});
      if (is_lost() || unknown_ > 0 || !std::isfinite(result_.value[k])) {
        result_.value[k] = std::numeric_limits<double>::quiet_NaN();
        result_.error[k] = std::numeric_limits<double>::infinity();
        result_.converged = false;
      }
      if (!(result_.error[k] <= goal)) result_.converged = false;
    }
    return std::move(result_);
  }

  // More such cells at a time are no single places.
  static constexpr int kMaxUnknown = 256;

  Evaluate evaluate_;
  int count_, rows_;
  int unknown_ = 0;  // cells with nodes where an integrand is not finite
  bool is_hopeless_ = false;
  IntegrationGoal goal_;
  std::vector<double> error_, size_, scratch_;
  std::vector<double> stuck_;  // errors of cells too narrow to be split
  std::priority_queue<Cell> cells_;
  Integral result_;
};

}  // namespace

// Roots of the Legendre polynomial P_n by Newton's method from Tricomi's estimate; w = 2 / ((1 - x^2) P_n'(x)^2).
// In long double, so that the result is right to an ulp.
GaussRule gauss_legendre(int n) {
  GaussRule rule;
  rule.nodes.resize(n), rule.weights.resize(n);
  for (int i = 0; i < (n + 1) / 2; ++i) {
    long double x =
        std::cos(std::numbers::pi_v<long double> * (i + 0.75L) / (n + 0.5L)) * (1 - (1 - 1.0L / n) / (8.0L * n * n));
    long double slope = 1;
    for (int step = 0; step < 100; ++step) {
      long double p = 1, previous = 0;
      for (int k = 1; k <= n; ++k) {
        const long double next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
        previous = p;
        p = next;
      }
      slope = n * (previous - x * p) / (1 - x * x);
      const long double change = p / slope;
      x -= change;
      if (std::fabs(change) < 1e-17L) break;
    }
    if (2 * i + 1 == n) x = 0;
    const double weight = static_cast<double>(2 / ((1 - x * x) * slope * slope));
    rule.nodes[i] = static_cast<double>(-x), rule.nodes[n - 1 - i] = static_cast<double>(x);
    rule.weights[i] = rule.weights[n - 1 - i] = weight;
  }
  return rule;
}

Integral integrate(const Integrand& f, int count, std::span<const double> breaks, const IntegrationGoal& goal) {
  const auto evaluate = [&f](double u, double, std::span<double> values) { f(u, values); };
  const double point[] = {0, 0};
  return Adaptive(evaluate, count, 1, goal).run(breaks, point);
}

Integral integrate(const Integrand& f, int count, const Interval& range, const IntegrationGoal& goal) {
  const double breaks[] = {range.lo, range.hi};
  return integrate(f, count, breaks, goal);
}

Integral integrate(const Integrand2& f, int count, std::span<const double> u_breaks, std::span<const double> v_breaks,
                   const IntegrationGoal& goal) {
  const auto evaluate = [&f](double u, double v, std::span<double> values) { f(u, v, values); };
  return Adaptive(evaluate, count, kPoints, goal).run(u_breaks, v_breaks);
}

Integral integrate(const Integrand2& f, int count, const Interval& u, const Interval& v, const IntegrationGoal& goal) {
  const double u_breaks[] = {u.lo, u.hi}, v_breaks[] = {v.lo, v.hi};
  return integrate(f, count, u_breaks, v_breaks, goal);
}

}  // namespace lekalo::geometry
