#include "geometry/shapes/implicit_cells.h"

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
constexpr int kMostHalvings = 6;  // of a line's part in a cell, before interval arithmetic takes over

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
  models = models && formula_.smoothness() == Expression::Smoothness::smooth;
  struct Open {
    int node;
    Box3 box;
    int cuts;
  };
  std::deque<Open> open{{0, region, 0}};  // the largest first
  nodes_.emplace_back();
  while (!open.empty()) {
    const Open at = open.front();
    open.pop_front();
    Cell cell;
    if (outside(at.box) || !make_cell(at.box, models, cell)) continue;
    const Vec3 size = at.box.size();
    const double change = glm::dot(glm::abs(cell.g), 0.5 * size);
    const bool good = models && cell.error <= kGoodModel * change;
    if (good || at.cuts == kMostCuts || count() + static_cast<int>(open.size()) + 1 >= most) {
      nodes_[at.node].child = count();
      cells_.push_back(cell);
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
  using Jet = geometry::Jet<Interval, 1>;
  using Pair = Jet2<Interval, 2>;
  // Value and slopes at the middle, slopes and second derivatives over the box. Kinks have the slopes of both sides.
  const Interval value = formula_.enclose({cell.center, cell.center});
  Interval slope[3], slope_over[3], second[3][3];
  const auto side = [&](int k) { return Interval(box.lo[k], box.hi[k]); };
  if (formula_.smoothness() == Expression::Smoothness::jumps) return true;
  Interval range = value;
  for (int k = 0; k < 3; ++k) {
    const auto over = [&](int axis) { return axis == k ? Jet::variable(side(axis)) : Jet(side(axis)); };
    slope_over[k] = formula_(over(0), over(1), over(2)).c[1];
    range += slope_over[k] * Interval(-half[k], half[k]);
  }
  if (!range.contains(0.0)) return false;
  if (!with_model) return true;
  for (int k = 0; k < 3; ++k) {
    const auto at = [&](int axis) {
      return axis == k ? Jet::variable(Interval(cell.center[axis])) : Jet(Interval(cell.center[axis]));
    };
    slope[k] = formula_(at(0), at(1), at(2)).c[1];
    const int other = (k + 1) % 3;
    const auto over = [&](int axis) {
      return axis == k ? Pair::u_variable(side(axis)) : axis == other ? Pair::v_variable(side(axis)) : Pair(side(axis));
    };
    const Pair pair = formula_(over(0), over(1), over(2));
    second[k][k] = pair.derivative(2, 0);
    second[k][other] = second[other][k] = pair.derivative(1, 1);
  }
  // Twice the rounding at the middle stands for that of F and of the model elsewhere in the cell.
  double error = 4 * value.width();
  for (int i = 0; i < 3; ++i) {
    cell.g[i] = slope[i].middle();
    cell.slope_error[i] = 2 * slope[i].width();
    for (int j = 0; j < 3; ++j) {
      cell.h[i][j] = second[i][j].middle();
      cell.slope_error[i] += (0.5 + 1e-12) * second[i][j].width() * half[j];
    }
    error += cell.slope_error[i] * half[i];
  }
  cell.f = value.middle();
  if (std::isfinite(error) && std::isfinite(cell.f)) cell.error = error;
  // What the model itself can reach.
  double reach = cell.error;
  for (int i = 0; i < 3; ++i) {
    reach += std::abs(cell.g[i]) * half[i];
    for (int j = 0; j < 3; ++j) reach += 0.5 * std::abs(cell.h[i][j]) * half[i] * half[j];
  }
  return !(std::abs(cell.f) > reach);
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

void ImplicitCells::follow_cell(const Cell& cell, const Line& line, double t0, double t1, SignChanges& changes) const {
  const double error = cell.error, size = 2 * glm::length(where_zero_.hi - where_zero_.lo);
  if (error == kInfinity) return follow_by_intervals(formula_, line, t0, t1, size, changes);
  struct Part {
    double begin, width;  // of the way from t0 to t1
    Bernstein b;
  };
  Part stack[kMostHalvings + 1];
  int top = 0;
  {
    const Vec3 p = line.at(t0) - cell.center, q = line.at(t1) - cell.center, hp = cell.h * p, hq = cell.h * q;
    const double gp = cell.f + glm::dot(cell.g, p), gq = cell.f + glm::dot(cell.g, q);
    stack[0] = {0, 1, {gp + 0.5 * glm::dot(p, hp), 0.5 * (gp + gq + glm::dot(p, hq)), gq + 0.5 * glm::dot(q, hq)}};
  }
  const double slope_error = 0.5 * (t1 - t0) * glm::dot(cell.slope_error, glm::abs(line.direction));
  const double smallest = std::ldexp(1.0, -kMostHalvings);
  const auto sign_at = [&](double model, double t) {
    return model > error || (!(model < -error) && is_positive(formula_(line.at(t))));
  };
  const auto place = [&](double s) { return s == 1 ? t1 : t0 + s * (t1 - t0); };
  while (top >= 0) {
    const Part part = stack[top--];
    const auto& [b0, b1, b2] = part.b;
    const double lo = std::min({b0, b1, b2}), hi = std::max({b0, b1, b2});
    const double begin = place(part.begin), end = place(part.begin + part.width);
    const double slack = part.width * slope_error;
    if (lo > error || hi < -error) {
      changes.pass(begin, lo > error);
    } else if ((b1 - b0 > slack && b2 - b1 > slack) || (b1 - b0 < -slack && b2 - b1 < -slack)) {
      const bool from = sign_at(b0, begin), to = sign_at(b2, end);
      changes.pass(begin, from);
      if (from != to) changes.add(find_zero(formula_, line, begin, end, to, begin + zero_of(part.b) * (end - begin)));
    } else if (part.width <= smallest || hi - lo <= 4 * error) {
      changes.pass(begin, is_positive(formula_(line.at(begin))));
      follow_by_intervals(formula_, line, begin, end, size, changes);
    } else {
      const double left = 0.5 * (b0 + b1), right = 0.5 * (b1 + b2), middle = 0.5 * (left + right);
      const double half = 0.5 * part.width;
      stack[++top] = {part.begin + half, half, {middle, right, b2}};
      stack[++top] = {part.begin, half, {b0, left, middle}};
    }
    if (changes.is_done()) return;
  }
}

}  // namespace lekalo::geometry
