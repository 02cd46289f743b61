#include "geometry/shapes/implicit_cells.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <deque>

#include "geometry/numerics/jet2.h"
#include "geometry/shapes/sign_changes.h"

namespace lekalo::geometry {

namespace {

// Cells are taken so much larger, of the coordinates' size, than where a line is followed through them.
constexpr double kCellSlack = 1e-13;
// A model is good whose error is this part of what F changes in the cell.
constexpr double kGoodModel = 1.0 / 64;
constexpr int kMostCuts = 36;

Box3 with_slack(const Box3& box) { return box.inflated(kCellSlack * (glm::length(box.lo) + glm::length(box.hi))); }

struct Bernstein {
  double b0, b1, b2;
};

// Where the quadratic polynomial with values of two signs at the ends is zero.
double zero_of(const Bernstein& b) {
  // b0 - 2 (b0 - b1) s + (b0 - 2 b1 + b2) s^2, without cancellation.
  const double half = b.b0 - b.b1, square = half - (b.b1 - b.b2);
  const double root = std::sqrt(std::max(half * half - b.b0 * square, 0.0));
  const double s = half > 0 ? b.b0 / (half + root) : b.b0 < 0 || b.b0 > 0 ? b.b0 / (half - root) : 0;
  return s >= 0 && s <= 1 ? s : b.b0 / (b.b0 - b.b2);
}

}  // namespace

ImplicitCells::ImplicitCells(ImplicitFormula formula, const Box3& region,
                             const std::function<bool(const Box3&)>& outside, int most, bool models)
    : formula_(std::move(formula)) {
  size_ = glm::length(region.size());
  models = models && formula_.smoothness() == Expression::Smoothness::smooth;
  struct Open {
    int node;
    Box3 box;
    int cuts;
  };
  struct Made {
    Cell cell;
    bool may_be_zero;
  };
  std::deque<Open> open{{0, region, 0}};  // the largest first
  std::deque<Made> ready;                 // cells of the first of them
  nodes_.emplace_back();
  while (!open.empty()) {
    if (ready.empty()) {
      // All that is open comes before its parts: threads make the cells, in any order.
      ready.resize(open.size());
      tbb::parallel_for(tbb::blocked_range<size_t>(0, open.size()), [&](const tbb::blocked_range<size_t>& part) {
        for (size_t i = part.begin(); i < part.end(); ++i)
          ready[i].may_be_zero = !outside(open[i].box) && make_cell(open[i].box, models, ready[i].cell);
      });
    }
    const Open at = open.front();
    const auto [cell, may_be_zero] = ready.front();
    open.pop_front();
    ready.pop_front();
    if (!may_be_zero) continue;
    const Vec3 size = at.box.size();
    const double change = glm::dot(glm::abs(cell.g), 0.5 * size);
    const bool good = models && cell.error <= kGoodModel * change;
    if (good || at.cuts == kMostCuts || count() + static_cast<int>(open.size()) + 1 >= most) {
      nodes_[at.node].child = count();
      cells_.push_back(cell);
      rounding_ = std::max(rounding_, cell.rounding);
      where_zero_.include(at.box);
      continue;
    }
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const double cut = at.box.center()[axis];
    const int child = static_cast<int>(nodes_.size());
    nodes_[at.node] = {axis, cut, child};
    Box3 below = at.box, above = at.box;
    below.hi[axis] = above.lo[axis] = cut;
    open.push_back({child, below, at.cuts + 1});
    open.push_back({child + 1, above, at.cuts + 1});
    nodes_.resize(nodes_.size() + 2);
  }
}

bool ImplicitCells::make_cell(const Box3& given, bool with_model, Cell& cell) const {
  const Box3 box = with_slack(given);
  if (!formula_.enclose(box).contains(0.0)) return false;
  cell.center = given.center();
  const Vec3 half = 0.5 * box.size() + kCellSlack * glm::abs(cell.center);
  using Pair = Jet2<Interval, 2>;
  // Value and slopes at the middle, slopes and second derivatives over the box. Kinks have the slopes of both sides.
  const Interval value = formula_.enclose({cell.center, cell.center});
  cell.rounding = 4 * value.width();
  Interval slope[3], second[3][3];
  const auto side = [&](int k) { return Interval(box.lo[k], box.hi[k]); };
  if (formula_.smoothness() == Expression::Smoothness::jumps) return true;
  const auto over_box = formula_.with_gradient(side(0), side(1), side(2));
  Interval range = value;
  for (int k = 0; k < 3; ++k) range += over_box.c[1 + k] * Interval(-half[k], half[k]);
  if (!range.contains(0.0)) return false;
  if (!with_model) return true;
  const auto at_center =
      formula_.with_gradient(Interval(cell.center.x), Interval(cell.center.y), Interval(cell.center.z));
  for (int k = 0; k < 3; ++k) {
    slope[k] = at_center.c[1 + k];
    const int other = (k + 1) % 3;
    const auto over = [&](int axis) {
      return axis == k ? Pair::u_variable(side(axis)) : axis == other ? Pair::v_variable(side(axis)) : Pair(side(axis));
    };
    const Pair pair = formula_(over(0), over(1), over(2));
    second[k][k] = pair.derivative(2, 0);
    second[k][other] = second[other][k] = pair.derivative(1, 1);
  }
  // Twice the rounding at the middle stands for that of F and of the model elsewhere in the cell.
  double error = cell.rounding;
  for (int i = 0; i < 3; ++i) {
    cell.g[i] = slope[i].middle();
    cell.slope_error[i] = cell.slope_rounding[i] = 4 * slope[i].width();
    for (int j = 0; j < 3; ++j) {
      cell.h[i][j] = second[i][j].middle();
      cell.h_error[i][j] = (0.5 + 1e-12) * second[i][j].width();
      cell.slope_error[i] += cell.h_error[i][j] * half[j];
    }
    // By Taylor's formula half of the second derivatives' part is enough.
    error += 0.5 * (cell.slope_error[i] + cell.slope_rounding[i]) * half[i];
  }
  cell.f = value.middle();
  if (std::isfinite(error) && std::isfinite(cell.f)) cell.error = error;
  // What the model itself can reach.
  cell.bend = cell.error;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) cell.bend += 0.5 * std::abs(cell.h[i][j]) * half[i] * half[j];
  return !(std::abs(cell.f) > cell.bend + glm::dot(glm::abs(cell.g), half));
}

void ImplicitCells::follow(const Line& line, double t0, double t1, SignChanges& changes) const {
  struct Part {
    int node;
    double t0, t1;
  };
  Part stack[kMostCuts + 2];
  int top = 0;
  stack[0] = {0, t0, t1};
  while (top >= 0) {
    Part part = stack[top--];
    while (nodes_[part.node].axis >= 0) {
      const Node& node = nodes_[part.node];
      const double o = line.origin[node.axis], d = line.direction[node.axis];
      const double t = (node.cut - o) / d;
      const bool rising = d > 0;
      const int near = node.child + (rising ? 0 : 1), far = node.child + (rising ? 1 : 0);
      if (d == 0) {
        part.node = node.child + (o < node.cut ? 0 : 1);
      } else if (t >= part.t1) {
        part.node = near;
      } else if (t <= part.t0) {
        part.node = far;
      } else {
        stack[++top] = {far, t, part.t1};
        part = {near, part.t0, t};
      }
    }
    const int cell = nodes_[part.node].child;
    if (cell < 0) continue;
    follow_cell(cells_[cell], line, part.t0, part.t1, changes);
    if (changes.is_done()) return;
  }
}

namespace {

// A stretch of a line with a model of F on it.
struct Stretch {
  double t0, t1;
  Bernstein b;
  double error;
  double slope_error;  // of dF/dt
};

// What a model tells.
enum class Told { no_zero, monotone, nothing };
Told tell(const Stretch& stretch) {
  const auto& [b0, b1, b2] = stretch.b;
  if (std::min({b0, b1, b2}) > stretch.error || std::max({b0, b1, b2}) < -stretch.error) return Told::no_zero;
  const double slack = 0.5 * stretch.slope_error * (stretch.t1 - stretch.t0);
  const double first = b1 - b0, second = b2 - b1;
  return (first > slack && second > slack) || (first < -slack && second < -slack) ? Told::monotone : Told::nothing;
}

}  // namespace

void ImplicitCells::follow_cell(const Cell& cell, const Line& line, double t0, double t1, SignChanges& changes) const {
  if (cell.error == kInfinity) return follow_by_intervals(formula_, line, t0, t1, size_, changes);
  constexpr int kRoom = 64;
  Stretch stack[kRoom];
  int top = 0;
  {
    const Vec3 p = line.at(t0) - cell.center, q = line.at(t1) - cell.center;
    const double gp = cell.f + glm::dot(cell.g, p), gq = cell.f + glm::dot(cell.g, q);
    if (std::min(gp, gq) > cell.bend || std::max(gp, gq) < -cell.bend) return changes.pass(t0, gp > 0);
    const Vec3 hp = cell.h * p, hq = cell.h * q;
    stack[0] = {t0, t1, {}, cell.error, glm::dot(cell.slope_error, glm::abs(line.direction))};
    stack[0].b = {gp + 0.5 * glm::dot(p, hp), 0.5 * (gp + gq + glm::dot(p, hq)), gq + 0.5 * glm::dot(q, hq)};
  }
  const auto sign_at = [&](double model, double error, double t) {
    return model > error || (!(model < -error) && is_positive(formula_(line.at(t))));
  };
  // A model of its own, from the middle.
  const auto with_model = [&](double from, double to) -> Stretch {
    const Vec3& d = line.direction;
    const Vec3 size = glm::abs(d);
    const double half = 0.5 * (to - from), second = glm::dot(d, cell.h * d);
    const double second_error = glm::dot(size, cell.h_error * size);
    const auto at = formula_.along(line, Jet<double, 1>::variable(0.5 * (from + to)));
    const double f = at.c[0], change = at.c[1] * half, bend = 0.5 * second * half * half;
    return {from,
            to,
            {f - change + bend, f - bend, f + change + bend},
            cell.rounding + 0.5 * second_error * half * half,
            glm::dot(cell.slope_rounding, size) + second_error * half};
  };
  while (top >= 0) {
    const Stretch stretch = stack[top--];
    const Bernstein& b = stretch.b;
    switch (tell(stretch)) {
      case Told::no_zero:
        changes.pass(stretch.t0, b.b0 > 0);
        break;
      case Told::monotone: {
        const bool from = sign_at(b.b0, stretch.error, stretch.t0), to = sign_at(b.b2, stretch.error, stretch.t1);
        changes.pass(stretch.t0, from);
        const double length = stretch.t1 - stretch.t0;
        if (from != to)
          changes.add(find_zero(formula_, line, stretch.t0, stretch.t1, to, stretch.t0 + zero_of(b) * length,
                                2 * (b.b0 - 2 * b.b1 + b.b2) / (length * length)));
        break;
      }
      case Told::nothing: {
        const double middle = 0.5 * (stretch.t0 + stretch.t1);
        if (stretch.error <= 2 * cell.rounding || top + 3 > kRoom || !(stretch.t0 < middle && middle < stretch.t1)) {
          changes.pass(stretch.t0, is_positive(formula_(line.at(stretch.t0))));
          follow_by_intervals(formula_, line, stretch.t0, stretch.t1, size_, changes);
          break;
        }
        stack[++top] = with_model(middle, stretch.t1);
        stack[++top] = with_model(stretch.t0, middle);
      }
    }
    if (changes.is_done()) return;
  }
}

}  // namespace lekalo::geometry
