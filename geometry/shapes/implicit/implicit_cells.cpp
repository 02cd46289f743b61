#include "geometry/shapes/implicit/implicit_cells.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <deque>

#include "geometry/numerics/instruction_sets.h"
#include "geometry/numerics/majorant.h"
#include "geometry/shapes/implicit/sign_changes.h"

namespace lekalo::geometry {

namespace {

// Cells are taken so much larger, of the coordinates' size, than where a line is followed through them.
constexpr double kCellSlack = 1e-13;
// A model is good whose error is this part of what F changes in the cell.
constexpr double kGoodModel = 1.0 / 8;
// An error so many times larger than the model itself, beside a pole or a root, asks for a part of the line for each
// unit of its fourth root: interval arithmetic, which sees every part for itself, is faster.
constexpr double kHopelessModel = 1e6;
// Fourth derivatives are enclosed anew in boxes down to this part of the region, and in smaller ones as long as that
// makes the bounds smaller by kGain than what follows from those of the box around.
constexpr double kSmallBox = 0.13;
constexpr double kGain = 0.25;
constexpr int kMaxCuts = 36;
constexpr int kMaxGridBoxes = 4096;
// Axes along which a box is halved: all whose side is at least this part of its longest.
constexpr double kLongSide = 0.7;
// A stretch gets its own model where that is so much better than the one it has.
constexpr double kBetterModel = 0.25;
// Bounds on a zero's place, of the region's size.
constexpr double kSameZero = 1e-13;

Box3 with_slack(const Box3& box) { return box.inflated(kCellSlack * (glm::length(box.lo) + glm::length(box.hi))); }
Interval side(const Box3& box, int axis) { return {box.lo[axis], box.hi[axis]}; }

double sum(const Vec3& v) { return v.x + v.y + v.z; }
double largest(const Vec3& v) { return std::max({v.x, v.y, v.z}); }
// Those along which boxes of this size are halved.
std::array<bool, 3> long_axes(const Vec3& size) {
  const double least = kLongSide * largest(size);
  return {size.x >= least, size.y >= least, size.z >= least};
}
double fourth_power(double x) { return sqr(sqr(x)); }

// A cubic polynomial over a stretch of the line, s from 0 to 1.
struct Bernstein {
  double b0, b1, b2, b3;

  double least() const { return std::min(std::min(b0, b1), std::min(b2, b3)); }
  double largest() const { return std::max(std::max(b0, b1), std::max(b2, b3)); }
  // How far it is from a straight one.
  double bend() const { return std::max(std::abs(b0 - 2 * b1 + b2), std::abs(b1 - 2 * b2 + b3)); }
  void halve(Bernstein& below, Bernstein& above) const {
    const double c0 = 0.5 * (b0 + b1), c1 = 0.5 * (b1 + b2), c2 = 0.5 * (b2 + b3);
    const double d0 = 0.5 * (c0 + c1), d1 = 0.5 * (c1 + c2), middle = 0.5 * (d0 + d1);
    below = {b0, c0, d0, middle};
    above = {middle, d1, c2, b3};
  }
  // Where it is zero, being monotone with values of two signs at the ends, to a small part of the stretch: Newton's
  // iteration from the zero of the chord.
  double zero() const {
    constexpr double kNear = 1e-4;  // the step after would be of its square
    const double c1 = 3 * (b1 - b0), c2 = 3 * ((b2 - b1) - (b1 - b0)), c3 = (b3 - b2) - 2 * (b2 - b1) + (b1 - b0);
    double s = b0 / (b0 - b3);
    for (int step = 0; step < 8; ++step) {
      const double value = b0 + s * (c1 + s * (c2 + s * c3)), slope = c1 + s * (2 * c2 + 3 * s * c3);
      const double before = s;
      s = std::clamp(s - value / slope, 0.0, 1.0);
      if (std::abs(s - before) < kNear) break;
    }
    return s;
  }
};

}  // namespace

ImplicitCells::ImplicitCells(ImplicitFormula formula, const Box3& region,
                             const std::function<bool(const Box3&)>& outside, int most, bool models)
    : formula_(std::move(formula)) {
  size_ = glm::length(region.size());
  models = models && formula_.smoothness() == Expression::Smoothness::smooth;
  struct Open {
    int node;
    Box3 box;
    int rounds, cuts;
    FourthDerivatives fourth;  // first of the box around, then its own
  };
  struct Made {
    Cell cell;
    bool may_be_zero;
  };
  std::deque<Open> open{{0, region, 0, 0, {}}};  // the largest first
  std::deque<Made> ready;                        // cells of the first of them
  int rounds = 0;
  nodes_.emplace_back();
  while (!open.empty()) {
    if (ready.empty()) {
      // All that is open comes before its parts: threads make the cells, in any order.
      ready.resize(open.size());
      tbb::parallel_for(tbb::blocked_range<size_t>(0, open.size()), [&](const tbb::blocked_range<size_t>& part) {
        for (size_t i = part.begin(); i < part.end(); ++i) {
          const Box3& box = open[i].box;
          ready[i].may_be_zero =
              !outside(box) && (models ? make_cell(box, open[i].fourth, ready[i].cell) : may_be_zero(box));
        }
      });
    }
    const Open at = open.front();
    const auto [cell, may_be_zero] = ready.front();
    open.pop_front();
    ready.pop_front();
    if (!may_be_zero) continue;
    const Vec3 size = at.box.size();
    const bool good = models && cell.error <= kGoodModel * sum(glm::abs(cell.g));
    if (good || at.cuts >= kMaxCuts || count() + static_cast<int>(open.size()) + 1 >= most) {
      nodes_[at.node].child = count();
      cells_.push_back(cell);
      rounding_ = std::max(rounding_, cell.rounding);
      where_zero_.include(at.box);
      continue;
    }
    const size_t first = open.size();
    const auto halved = long_axes(size);
    open.push_back(at);
    rounds = std::max(rounds, ++open.back().rounds);
    for (int axis = 0; axis < 3; ++axis) {
      if (!halved[axis]) continue;
      for (size_t i = first, end = open.size(); i < end; ++i) {
        Open& below = open[i];
        const double cut = below.box.center()[axis];
        const int child = static_cast<int>(nodes_.size());
        nodes_[below.node] = {cut, axis, child};
        nodes_.resize(nodes_.size() + 2);
        Open above = below;
        below.node = child;
        above.node = child + 1;
        below.box.hi[axis] = above.box.lo[axis] = cut;
        ++below.cuts, ++above.cuts;
        open.push_back(above);
      }
    }
  }
  make_grid(region, rounds);
}

bool ImplicitCells::may_be_zero(const Box3& given) const {
  const Box3 box = with_slack(given);
  if (!formula_.enclose(box).contains(0.0)) return false;
  if (formula_.smoothness() == Expression::Smoothness::jumps) return true;
  // Kinks have the slopes of both sides.
  const auto over_box = formula_.with_gradient(side(box, 0), side(box, 1), side(box, 2));
  const Vec3 center = given.center();
  Interval range = formula_.enclose({center, center});
  for (int k = 0; k < 3; ++k) range += over_box.c[1 + k] * (side(box, k) - center[k]);
  return range.contains(0.0);
}

ImplicitCells::FourthDerivatives ImplicitCells::enclose_fourth(const Box3& box, const Vec3& half) const {
  const auto over = [&](int axis) { return Majorant<4>::variable(side(box, axis), half[axis]); };
  const double error = magnitude(formula_(over(0), over(1), over(2)).c[4]);
  if (!std::isfinite(error)) return {half};
  return {half, error, 4 * error};  // D^4 F [w, w, w, v] / 6 is the coefficient of s^3 t
}

bool ImplicitCells::make_cell(const Box3& given, FourthDerivatives& fourth, Cell& cell) const {
  const Box3 box = with_slack(given);
  const Vec3 center = given.center(), half = 0.5 * box.size() + kCellSlack * glm::abs(center);
  cell.center = center;
  cell.scale = 1.0 / half;
  // F and its slopes at the middle, with their rounding.
  const auto at_center = formula_.with_gradient(Interval(center.x), Interval(center.y), Interval(center.z));
  cell.rounding = 4 * at_center.c[0].width();
  cell.slope_rounding = 0;
  for (int k = 0; k < 3; ++k) cell.slope_rounding += 4 * half[k] * at_center.c[1 + k].width();
  using Space = Jet3<double, 3>;
  const auto along = [&](int axis) {
    Space r(center[axis]);
    r.c[1 + axis] = half[axis];
    return r;
  };
  const Space at = formula_(along(0), along(1), along(2));
  double bend = 0;
  cell.f = at.c[0];
  for (int k = 0; k < 3; ++k) cell.g[k] = at.c[1 + k];
  for (int k = 0; k < 6; ++k) bend += std::abs(cell.second[k] = at.c[4 + k]);
  for (int k = 0; k < 10; ++k) bend += std::abs(cell.third[k] = at.c[10 + k]);
  // Twice the rounding at the middle stands for that of F elsewhere in the cell. The model's values have at most
  // twelve roundings in each term, and its coefficients six times theirs.
  const double slope = sum(glm::abs(cell.g));
  cell.model_rounding = 2e-14 * (std::abs(cell.f) + slope + bend);
  const double rounding = 2 * cell.rounding + cell.slope_rounding + cell.model_rounding;
  if (std::isfinite(bend + slope + cell.f)) {
    const auto inherit = [&] {
      const double smaller = fourth_power(std::min(largest(half / fourth.half), 1.0));
      fourth = {half, smaller * fourth.error, smaller * fourth.slope_error, fourth.is_sharp};
    };
    if (fourth.error < kInfinity) inherit();
    if (!fourth.is_sharp && !(fourth.error <= kGoodModel * slope)) {
      const FourthDerivatives own = enclose_fourth(box, half);
      const bool is_sharp = own.error > kGain * fourth.error && glm::length(given.size()) < kSmallBox * size_;
      if (own.error < fourth.error) fourth = own;
      fourth.is_sharp = is_sharp;
    }
    const bool is_hopeless = fourth.error > kHopelessModel * (std::abs(cell.f) + slope + bend);
    cell.error = is_hopeless ? kInfinity : fourth.error + rounding;
    cell.slope_error = fourth.slope_error + rounding;
    if (!straighten(cell.error, half, cell)) return false;
    // Where boxes are large, and few, the formula's own range may still tell more.
    if (cell.error <= kGoodModel * slope && glm::length(given.size()) < kSmallBox * size_) return true;
  }
  return formula_.enclose(box).contains(0.0);
}

// x^2 = 1/2 + T_2(x)/2, x^3 = 3/4 x + T_3(x)/4, x^2 y = y/2 + T_2(x) y/2, and |T_n| <= 1: what is left out is half or a
// quarter of the terms.
bool ImplicitCells::straighten(double error, const Vec3& half, Cell& cell) const {
  const auto& [xx, xy, xz, yy, yz, zz] = cell.second;
  const auto& [xxx, xxy, xxz, xyy, xyz, xzz, yyy, yyz, yzz, zzz] = cell.third;
  const double f = cell.f + 0.5 * (xx + yy + zz);
  const Vec3 g = cell.g + 0.75 * Vec3(xxx, yyy, zzz) + 0.5 * Vec3(xyy + xzz, xxy + yzz, xxz + yyz);
  const auto size = [](auto... terms) { return (std::abs(terms) + ...); };
  const double left_out = 0.5 * size(xx, yy, zz) + size(xy, xz, yz) + 0.25 * size(xxx, yyy, zzz) +
                          0.5 * size(xxy, xxz, xyy, xzz, yyz, yzz) + std::abs(xyz);
  cell.slope = g / half;
  cell.offset = f - glm::dot(cell.slope, cell.center);
  // The rounding of these, and of offset + slope (o + t d) for lines that begin near the region.
  const double far = std::abs(f) + sum(glm::abs(cell.slope) * (glm::abs(cell.center) + 4 * size_));
  cell.bend = error + left_out + 1e-14 * (far + left_out);
  return std::abs(f) <= cell.bend + sum(glm::abs(g));
}

void ImplicitCells::make_grid(const Box3& region, int rounds) {
  grid_.lo = region.lo;
  grid_.side = region.size();
  int total = 1;
  for (; rounds > 0; --rounds) {
    const auto halved = long_axes(grid_.side);
    for (const bool is_halved : halved) total *= is_halved ? 2 : 1;
    if (total > kMaxGridBoxes) break;
    for (int axis = 0; axis < 3; ++axis) {
      if (!halved[axis]) continue;
      grid_.count[axis] *= 2;
      grid_.side[axis] *= 0.5;
    }
  }
  grid_.per_side = 1.0 / grid_.side;
  grid_.boxes.resize(static_cast<size_t>(grid_.count[0]) * grid_.count[1] * grid_.count[2]);
  fill_grid(0, {0, 0, 0}, grid_.count);
}

void ImplicitCells::fill_grid(int node, const std::array<int, 3>& first, const std::array<int, 3>& count) {
  const int axis = nodes_[node].axis;
  if (axis < 0 || count[axis] == 1) {
    const int child = nodes_[node].child, held = axis >= 0 ? ~node : child >= 0 ? child : kNothing;
    for (int k = first[2]; k < first[2] + count[2]; ++k)
      for (int j = first[1]; j < first[1] + count[1]; ++j)
        for (int i = first[0]; i < first[0] + count[0]; ++i)
          grid_.boxes[(static_cast<size_t>(k) * grid_.count[1] + j) * grid_.count[0] + i] = held;
    return;
  }
  std::array<int, 3> half = count, above = first;
  half[axis] /= 2;
  above[axis] += half[axis];
  fill_grid(nodes_[node].child, first, half);
  fill_grid(nodes_[node].child + 1, above, half);
}

inline void ImplicitCells::follow_cell(const Cell& cell, const Line& line, double t0, double t1,
                                       SignChanges& changes) const {
  const double at_origin = cell.offset + glm::dot(cell.slope, line.origin), rate = glm::dot(cell.slope, line.direction);
  const double begin = at_origin + t0 * rate, end = at_origin + t1 * rate;
  if (std::min(begin, end) > cell.bend || std::max(begin, end) < -cell.bend)
    changes.pass(t0, begin > 0);
  else
    follow_model(cell, line, t0, t1, changes);
}

// From box to box of the grid (Amanatides, Woo 1987), each place computed from the box and not from the one before.
LEKALO_WIDE void ImplicitCells::follow(const Line& line, double t0, double t1, SignChanges& changes) const {
  const Vec3 start = line.at(t0);
  double first[3], side[3], plane[3], step[3], next[3];  // along each axis: t at the first
  // plane and from plane to plane; number of the next plane, its change, its t
  int stride[3], left[3];
  int box = 0, size = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = line.direction[axis];
    const int last = grid_.count[axis] - 1;
    const double inverse = 1 / d;
    const int at =
        static_cast<int>(std::clamp((start[axis] - grid_.lo[axis]) * grid_.per_side[axis], 0.0, double(last)));
    const bool rises = d > 0;
    box += at * size;
    step[axis] = rises ? 1 : -1;
    stride[axis] = rises ? size : -size;
    left[axis] = rises ? last - at : at;
    plane[axis] = rises ? at + 1 : at;
    first[axis] = (grid_.lo[axis] - line.origin[axis]) * inverse;
    side[axis] = grid_.side[axis] * inverse;
    next[axis] = d == 0 ? kInfinity : first[axis] + plane[axis] * side[axis];
    size *= grid_.count[axis];
  }
  int held = grid_.boxes[box];
  for (double from = t0;;) {
    const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const double to = next[axis];
    const bool is_last = !(to < t1) || left[axis] == 0;
    if (!is_last) {
      --left[axis];
      box += stride[axis];
      plane[axis] += step[axis];
      next[axis] = first[axis] + plane[axis] * side[axis];
      if (grid_.boxes[box] == held) continue;
    }
    const double end = is_last ? t1 : to;
    if (from < end) {
      if (held >= 0)
        follow_cell(cells_[held], line, from, end, changes);
      else if (held != kNothing)
        follow_node(~held, line, from, end, changes);
      if (is_last || changes.is_done()) return;
      from = end;
    }
    if (is_last) return;
    held = grid_.boxes[box];
  }
}

void ImplicitCells::follow_node(int node, const Line& line, double t0, double t1, SignChanges& changes) const {
  struct Part {
    int node;
    double t0, t1;
  };
  Part stack[kMaxCuts + 4];
  int top = 0;
  stack[0] = {node, t0, t1};
  while (top >= 0) {
    Part part = stack[top--];
    while (nodes_[part.node].axis >= 0) {
      const Node& at = nodes_[part.node];
      const double o = line.origin[at.axis], d = line.direction[at.axis];
      const double t = (at.cut - o) / d;
      const int near = at.child + (d > 0 ? 0 : 1), far = at.child + (d > 0 ? 1 : 0);
      if (d == 0) {
        part.node = at.child + (o < at.cut ? 0 : 1);
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
  double slope_error;  // of dF/ds
};

// What a model tells.
enum class Told { no_zero, monotone, nothing };
Told tell(const Stretch& stretch) {
  const Bernstein& b = stretch.b;
  if (b.least() > stretch.error || b.largest() < -stretch.error) return Told::no_zero;
  const double slack = stretch.slope_error / 3;
  const double first = b.b1 - b.b0, second = b.b2 - b.b1, third = b.b3 - b.b2;
  if (std::min(std::min(first, second), third) > slack || std::max(std::max(first, second), third) < -slack)
    return Told::monotone;
  return Told::nothing;
}

}  // namespace

LEKALO_WIDE void ImplicitCells::follow_model(const Cell& cell, const Line& line, double t0, double t1,
                                             SignChanges& changes) const {
  if (cell.error == kInfinity) return follow_by_intervals(formula_, line, t0, t1, size_, changes);
  const Vec3 origin = (line.origin - cell.center) * cell.scale, direction = line.direction * cell.scale;
  const Vec3 p = origin + t0 * direction, step = (t1 - t0) * direction;
  // How fast the line goes through the cell: a stretch of length t is at most t * speed in any coordinate.
  const double speed = largest(glm::abs(direction)), length = t1 - t0;
  constexpr int kRoom = 64;
  Stretch stack[kRoom];
  int top = 0;
  {
    // The model at four places, which tell its Bernstein coefficients.
    using Four = double __attribute__((vector_size(32)));
    const Four s{0, 1.0 / 3, 2.0 / 3, 1};
    const Four x = p.x + s * step.x, y = p.y + s * step.y, z = p.z + s * step.z;
    const auto& [xx, xy, xz, yy, yz, zz] = cell.second;
    const auto& [xxx, xxy, xxz, xyy, xyz, xzz, yyy, yyz, yzz, zzz] = cell.third;
    const Four by_x =
        cell.g.x + x * (xx + xxx * x + xxy * y + xxz * z) + y * (xy + xyy * y + xyz * z) + z * (xz + xzz * z);
    const Four by_y = cell.g.y + y * (yy + yyy * y + yyz * z) + z * (yz + yzz * z);
    const Four by_z = cell.g.z + z * (zz + zzz * z);
    const Four at = cell.f + x * by_x + y * by_y + z * by_z;
    constexpr double kSixth = 1.0 / 6;
    stack[0] = {t0,
                t1,
                {at[0], kSixth * (18 * at[1] - 9 * at[2] - 5 * at[0] + 2 * at[3]),
                 kSixth * (18 * at[2] - 9 * at[1] - 5 * at[3] + 2 * at[0]), at[3]},
                cell.error,
                cell.slope_error * speed * length + 6 * cell.model_rounding};
  }
  const auto sign_at = [&](double model, double error, double t) {
    return model > error || (!(model < -error) && is_positive(formula_(line.at(t))));
  };
  // The error of a model from the middle of a stretch.
  const auto own_error = [&](const Stretch& stretch) {
    return cell.rounding + cell.error * fourth_power(0.5 * speed * (stretch.t1 - stretch.t0));
  };
  const auto with_model = [&](const Stretch& stretch) -> Stretch {
    const double half = 0.5 * (stretch.t1 - stretch.t0), error = own_error(stretch);
    const auto at = formula_.along(line, Jet<double, 3>::variable(0.5 * (stretch.t0 + stretch.t1)));
    const double f = at.c[0], c1 = at.c[1] * half, c2 = at.c[2] * sqr(half), c3 = at.c[3] * half * sqr(half);
    return {stretch.t0,
            stretch.t1,
            {f - c1 + c2 - c3, f - c1 / 3 - c2 / 3 + c3, f + c1 / 3 - c2 / 3 - c3, f + c1 + c2 + c3},
            error,
            8 * (error - cell.rounding) + 2 * speed * half * cell.slope_rounding};
  };
  while (top >= 0) {
    const Stretch stretch = stack[top--];
    const Bernstein& b = stretch.b;
    switch (tell(stretch)) {
      case Told::no_zero:
        changes.pass(stretch.t0, b.b0 > 0);
        break;
      case Told::monotone: {
        // What lies before ends with the same sign.
        const bool from = std::abs(b.b0) <= stretch.error && changes.has_begun()
                              ? changes.positive()
                              : sign_at(b.b0, stretch.error, stretch.t0);
        const bool to = sign_at(b.b3, stretch.error, stretch.t1);
        changes.pass(stretch.t0, from);
        if (from != to) changes.add(zero_in(cell, line, speed, stretch.t0, stretch.t1, to, b.zero()));
        break;
      }
      case Told::nothing: {
        const double middle = 0.5 * (stretch.t0 + stretch.t1);
        const bool is_bent = b.bend() > 2 * stretch.error, is_rounding = stretch.error <= 2 * cell.rounding;
        const double own = own_error(stretch);
        if (!is_bent && (own <= kBetterModel * stretch.error || (own <= 2 * cell.rounding && !is_rounding))) {
          stack[++top] = with_model(stretch);
          break;
        }
        if ((!is_bent && is_rounding) || top + 3 > kRoom || !(stretch.t0 < middle && middle < stretch.t1)) {
          changes.pass(stretch.t0, is_positive(formula_(line.at(stretch.t0))));
          follow_by_intervals(formula_, line, stretch.t0, stretch.t1, size_, changes);
          break;
        }
        Stretch& above = stack[++top] = stretch;
        Stretch& below = stack[++top] = stretch;
        b.halve(below.b, above.b);
        below.t1 = above.t0 = middle;
        below.slope_error = above.slope_error = 0.5 * stretch.slope_error;
      }
    }
    if (changes.is_done()) return;
  }
}

// The only zero between t0 and t1, where the signs differ. That of the jet at t is as near to F's as the fourth
// derivatives allow.
double ImplicitCells::zero_in(const Cell& cell, const Line& line, double speed, double t0, double t1, bool rising,
                              double share) const {
  constexpr int kMaxSteps = 3;
  const double tolerance = kSameZero * size_ / glm::length(line.direction);
  double t = t0 + share * (t1 - t0);
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto at = formula_.along(line, Jet<double, 3>::variable(t));
    double off = -at.c[0] / at.c[1], slope = at.c[1], change = kInfinity;
    for (int k = 0; k < 4 && std::abs(change) > tolerance; ++k) {
      const double value = at.c[0] + off * (at.c[1] + off * (at.c[2] + off * at.c[3]));
      slope = at.c[1] + off * (2 * at.c[2] + 3 * off * at.c[3]);
      change = value / slope;
      off -= change;
    }
    const double next = t + off;
    if (!(t0 <= next && next <= t1)) break;
    t = next;
    if (std::abs(change) <= tolerance && cell.error * fourth_power(speed * off) <= tolerance * std::abs(slope))
      return t;
  }
  return find_zero(formula_, line, t0, t1, rising, t);
}

}  // namespace lekalo::geometry
