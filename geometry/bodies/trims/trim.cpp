#include "geometry/bodies/trims/trim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

Vec2 plane_point(const Vec4& p) { return {p.x / p.w, p.y / p.w}; }

// Control points of an arc. Those of usual degrees take no memory of their own: arcs are halved for every hit of every
// ray near their edge.
class Points {
 public:
  Points() = default;
  explicit Points(std::span<const Vec4> points) {
    resize(points.size());
    std::copy(points.begin(), points.end(), data());
  }
  void resize(size_t n) {
    size_ = n;
    if (n > kFew) many_.resize(n);
  }
  size_t size() const { return size_; }
  Vec4* data() { return size_ > kFew ? many_.data() : few_.data(); }
  const Vec4* begin() const { return size_ > kFew ? many_.data() : few_.data(); }
  const Vec4* end() const { return begin() + size_; }
  const Vec4& front() const { return *begin(); }
  const Vec4& back() const { return begin()[size_ - 1]; }

 private:
  static constexpr size_t kFew = 6;
  size_t size_ = 0;
  std::array<Vec4, kFew> few_;  // not initialised
  std::vector<Vec4> many_;
};

void split_in_two(const Points& points, Points& left, Points& right) {
  const size_t n = points.size();
  left.resize(n);
  right = points;
  Vec4 *const first = left.data(), *const work = right.data();
  // Row after row of de Casteljau's scheme: its left edge is the left half, what stays in place the right one.
  for (size_t k = 0; k < n; ++k) {
    first[k] = work[0];
    for (size_t i = 0; i + 1 < n - k; ++i) work[i] = 0.5 * (work[i] + work[i + 1]);
  }
}

bool monotone_in_y(const Points& points) {
  bool up = true, down = true;
  for (const Vec4* p = points.begin(); p + 1 < points.end(); ++p) {
    const double a = p[0].y / p[0].w, b = p[1].y / p[1].w;
    up = up && b >= a;
    down = down && b <= a;
  }
  return up || down;
}

// An arc or a part of it by control points.
class BezierPart {
 public:
  explicit BezierPart(Points points) : points_(std::move(points)) {}
  BezierPart() = default;

  Rectangle box() const {
    Rectangle result{{kInfinity, -kInfinity}, {kInfinity, -kInfinity}};
    for (const Vec4& p : points_) {
      // A weight that is not positive: the hull bounds nothing.
      if (!(p.w > 0)) return {Interval::entire(), Interval::entire()};
      const Vec2 q = plane_point(p);
      result.u = {std::min(result.u.lo, q.x), std::max(result.u.hi, q.x)};
      result.v = {std::min(result.v.lo, q.y), std::max(result.v.hi, q.y)};
    }
    return result;
  }
  Vec2 begin() const { return plane_point(points_.front()); }
  Vec2 end() const { return plane_point(points_.back()); }
  bool is_monotone() const {
    return std::all_of(points_.begin(), points_.end(), [](const Vec4& p) { return p.w > 0; }) && monotone_in_y(points_);
  }
  void halve(BezierPart& first, BezierPart& second) const { split_in_two(points_, first.points_, second.points_); }
  // The segment between its ends.
  BezierPart chord() const { return BezierPart(Points(std::array{points_.front(), points_.back()})); }
  const Points& points() const { return points_; }

 private:
  Points points_;
};

// The same of a curve that has none.
class CurvePart {
 public:
  CurvePart() = default;
  CurvePart(const Curve* curve, const Interval& t) : curve_(curve), t_(t) {}

  Rectangle box() const {
    const Box3 box = curve_->enclose(t_, 0).d[0];
    return {{box.lo.x, box.hi.x}, {box.lo.y, box.hi.y}};
  }
  Vec2 begin() const { return Vec2(curve_->point(t_.lo)); }
  Vec2 end() const { return Vec2(curve_->point(t_.hi)); }
  bool is_monotone() const {
    const Box3 slope = curve_->enclose(t_, 1).d[1];
    return slope.lo.y >= 0 || slope.hi.y <= 0;
  }
  void halve(CurvePart& first, CurvePart& second) const {
    const double middle = t_.middle();
    first = {curve_, {t_.lo, middle}};
    second = {curve_, {middle, t_.hi}};
  }
  const Interval& t() const { return t_; }

 private:
  const Curve* curve_ = nullptr;
  Interval t_;
};

double distance(const Rectangle& box, const Vec2& p) {
  return glm::length(glm::max(glm::max(Vec2(box.u.lo, box.v.lo) - p, p - Vec2(box.u.hi, box.v.hi)), Vec2(0)));
}

template <class Part>
bool is_near(const Part& part, const Vec2& p, double tolerance, int depth) {
  if (distance(part.box(), p) > tolerance) return false;
  if (glm::length(part.begin() - p) <= tolerance || glm::length(part.end() - p) <= tolerance || depth == 0) return true;
  Part first, second;
  part.halve(first, second);
  return is_near(first, p, tolerance, depth - 1) || is_near(second, p, tolerance, depth - 1);
}

bool meet(const Rectangle& a, const Rectangle& b) {
  return a.u.lo <= b.u.hi && b.u.lo <= a.u.hi && a.v.lo <= b.v.hi && b.v.lo <= a.v.hi;
}

template <class Part>
bool may_meet(const Part& part, const Rectangle& rectangle, int depth) {
  if (!meet(part.box(), rectangle)) return false;
  const Vec2 begin = part.begin();
  if (depth == 0 || rectangle.contains(begin.x, begin.y)) return true;
  Part first, second;
  part.halve(first, second);
  return may_meet(first, rectangle, depth - 1) || may_meet(second, rectangle, depth - 1);
}

// Whether an arc that crosses the height v does so to the right of u: it is halved until its box lies on one side of
// the point or is a rounding error wide.
template <class Part>
bool crosses_right(Part part, bool begins_below, double u, double v) {
  for (int depth = 0;; ++depth) {
    const Interval x = part.box().u;
    if (x.lo > u || x.hi <= u || depth == 60) return x.lo > u;
    Part first, second;
    part.halve(first, second);
    part = begins_below != (first.end().y <= v) ? first : second;
  }
}

// An arc that is not monotone after so many halvings is a point or an extremum narrower than the rounding of its ends.
constexpr int kDeepestCut = 40;
// Nor are arcs cut that are no higher than this share of their loop: of an arc along a parameter line the slope may be
// nothing but rounding.
constexpr double kFlat = 1e-13;
// Nor when so many halvings in turn left the bounds as high as they were, as next to a singular point of a contour.
constexpr int kUnchangedHalvings = 6;
constexpr double kSameHeight = 0.99;

struct CutState {
  double flat = 0, height = kInfinity;  // of its loop, what is none; of the part that was halved
  int depth = 0, unchanged = 0;
};

template <class Part, class Add>
void cut_to_monotone(const Part& part, CutState state, Add&& add) {
  if (part.is_monotone() || state.depth == kDeepestCut) return add(part);
  const double height = part.box().v.width();
  state.unchanged = height > kSameHeight * state.height ? state.unchanged + 1 : 0;
  if (height <= state.flat || state.unchanged == kUnchangedHalvings) return add(part);
  state.height = height, ++state.depth;
  Part first, second;
  part.halve(first, second);
  cut_to_monotone(first, state, add);
  cut_to_monotone(second, state, add);
}

// Cells with so few arcs and turns are not cut.
constexpr size_t kFewArcs = 2;
constexpr int kDeepestCell = 14;

// A rectangle around a rounding error more.
Rectangle widened(const Rectangle& r, double by) { return {{r.u.lo - by, r.u.hi + by}, {r.v.lo - by, r.v.hi + by}}; }

}  // namespace

class TrimRegion::Building {
 public:
  explicit Building(TrimRegion& region) : region_(region), arcs_(region.arcs_) {}

  void add_loop(const std::vector<Part>& loop) {
    const size_t first = arcs_.size();
    Interval heights{kInfinity, -kInfinity};
    for (const Part& part : loop) {
      const Box3 box = bounds(*part.curve);
      heights = hull(heights, {box.lo.y, box.hi.y});
    }
    const double flat = heights.width() < kInfinity ? kFlat * heights.width() : 0;
    for (const Part& part : loop) {
      const size_t begin = arcs_.size();
      for (const CurvePiece& piece : part.curve->pieces()) {
        if (piece.is_rational()) {
          cut_to_monotone(BezierPart(Points(piece.points)), {flat}, [&](const BezierPart& cut) {
            const Points points = cut.is_monotone() ? cut.points() : cut.chord().points();
            add({{points.begin(), points.end()}, nullptr}, cut.box(), cut.begin().y, cut.end().y);
          });
        } else {
          cut_to_monotone(CurvePart(part.curve.get(), piece.domain), {flat}, [&](const CurvePart& cut) {
            add({{}, part.curve, cut.t()}, cut.box(), cut.begin().y, cut.end().y);
          });
        }
      }
      if (!part.forward) std::reverse(arcs_.begin() + static_cast<std::ptrdiff_t>(begin), arcs_.end());
      forward_.resize(arcs_.size(), part.forward);
    }
    // Neighbours meet at one height: rounding must not open the loop for the lines between.
    const size_t count = arcs_.size() - first;
    for (size_t k = 0; k < count; ++k) {
      const size_t here = first + k, next = first + (k + 1) % count;
      double& end = forward_[here] ? arcs_[here].y_end : arcs_[here].y_begin;
      const double begin = forward_[next] ? arcs_[next].y_begin : arcs_[next].y_end;
      end = begin;
      arcs_[here].y_lo = std::min(arcs_[here].y_lo, begin);
      arcs_[here].y_hi = std::max(arcs_[here].y_hi, begin);
    }
  }

  void build_cells() {
    std::vector<int> all(arcs_.size());
    for (size_t k = 0; k < all.size(); ++k) all[k] = static_cast<int>(k);
    room_ = 64 * all.size() + 1024;
    region_.cells_.emplace_back();
    cut(0, {region_.u_, region_.v_}, all, {}, false, 0);
  }

 private:
  void add(Arc arc, const Rectangle& box, double y_begin, double y_end) {
    arc.x_lo = box.u.lo, arc.x_hi = box.u.hi, arc.y_lo = box.v.lo, arc.y_hi = box.v.hi;
    arc.y_begin = y_begin, arc.y_end = y_end;
    arcs_.push_back(std::move(arc));
  }

  // `arcs` are those of the parent cell, `turns` its heights.
  void cut(int number, const Rectangle& box, const std::vector<int>& arcs, const std::vector<double>& turns, bool odd,
           int depth) {
    std::vector<int> own;
    std::vector<double> heights = turns;
    for (const int k : arcs) {
      const Arc& arc = arcs_[k];
      if (arc.y_hi < box.v.lo || arc.y_lo > box.v.hi || arc.x_hi < box.u.lo) continue;
      if (arc.x_lo > box.u.hi)
        heights.insert(heights.end(), {arc.y_begin, arc.y_end});
      else
        own.push_back(k);
    }
    // The parity of the arcs to the right at v is that of their ends at or below v: common ends cancel.
    std::sort(heights.begin(), heights.end());
    std::vector<double> own_turns;
    for (const double y : heights) {
      if (y <= box.v.lo)
        odd = !odd;
      else if (!own_turns.empty() && own_turns.back() == y)
        own_turns.pop_back();
      else if (y <= box.v.hi)
        own_turns.push_back(y);
    }
    const bool few = own.size() <= kFewArcs && own_turns.size() <= kFewArcs;
    if (few || depth == kDeepestCell || room_ < 4 * own.size()) {
      Cell& cell = region_.cells_[number];
      cell.odd = odd;
      cell.first_arc = static_cast<int>(region_.cell_arcs_.size());
      cell.arc_count = static_cast<int>(own.size());
      cell.first_turn = static_cast<int>(region_.turns_.size());
      cell.turn_count = static_cast<int>(own_turns.size());
      region_.cell_arcs_.insert(region_.cell_arcs_.end(), own.begin(), own.end());
      region_.turns_.insert(region_.turns_.end(), own_turns.begin(), own_turns.end());
      return;
    }
    room_ -= 4 * own.size();
    const int children = static_cast<int>(region_.cells_.size());
    region_.cells_[number].children = children;
    region_.cells_.resize(region_.cells_.size() + 4);
    const double u = box.u.middle(), v = box.v.middle();
    for (int child = 0; child < 4; ++child) {
      const Interval part_u = child & 1 ? Interval(u, box.u.hi) : Interval(box.u.lo, u);
      const Interval part_v = child & 2 ? Interval(v, box.v.hi) : Interval(box.v.lo, v);
      cut(children + child, {part_u, part_v}, own, own_turns, odd, depth + 1);
    }
  }

  TrimRegion& region_;
  std::vector<Arc>& arcs_;
  std::vector<char> forward_;
  size_t room_ = 0;  // for entries in cells
};

TrimRegion::TrimRegion(const std::vector<std::vector<Part>>& loops, const Periods& periods) : periods_(periods) {
  Building building(*this);
  for (const auto& loop : loops) building.add_loop(loop);
  u_ = v_ = {kInfinity, -kInfinity};
  for (const Arc& arc : arcs_) {
    u_ = {std::min(u_.lo, arc.x_lo), std::max(u_.hi, arc.x_hi)};
    v_ = {std::min(v_.lo, arc.y_lo), std::max(v_.hi, arc.y_hi)};
  }
  building.build_cells();
}

template <class Visit>
bool TrimRegion::any_shift(const Rectangle& rectangle, Visit&& visit) const {
  const auto first = [](const Interval& range, const Interval& x, double period) {
    return period > 0 ? period * std::ceil((range.lo - x.hi) / period) : 0.0;
  };
  const double from_u = first(u_, rectangle.u, periods_.u), from_v = first(v_, rectangle.v, periods_.v);
  for (double u = from_u; rectangle.u.lo + u <= u_.hi; u += periods_.u) {
    for (double v = from_v; rectangle.v.lo + v <= v_.hi; v += periods_.v) {
      if (visit(Vec2(u, v))) return true;
      if (periods_.v == 0) break;
    }
    if (periods_.u == 0) break;
  }
  return false;
}

bool TrimRegion::contains(double u, double v, double tolerance) const {
  if (periods_.u == 0 && periods_.v == 0) return holds_or_touches(u, v, tolerance);
  return any_shift({{u - tolerance, u + tolerance}, {v - tolerance, v + tolerance}},
                   [&](const Vec2& by) { return holds_or_touches(u + by.x, v + by.y, tolerance); });
}

bool TrimRegion::is_right_of(const Arc& arc, double u, double v) {
  // Half-open in y, by the ends, so that a vertex between two arcs counts once.
  const bool begins_below = arc.y_begin <= v;
  if (begins_below == (arc.y_end <= v) || arc.x_hi < u) return false;
  if (arc.x_lo > u) return true;
  return arc.curve ? crosses_right(CurvePart(arc.curve.get(), arc.t), begins_below, u, v)
                   : crosses_right(BezierPart(Points(arc.points)), begins_below, u, v);
}

bool TrimRegion::holds(double u, double v) const {
  if (!u_.contains(u) || !v_.contains(v)) return false;
  const Cell* cell = cells_.data();
  Interval x = u_, y = v_;
  while (cell->children >= 0) {
    const double middle_x = x.middle(), middle_y = y.middle();
    const bool right = u > middle_x, upper = v > middle_y;
    (right ? x.lo : x.hi) = middle_x;
    (upper ? y.lo : y.hi) = middle_y;
    cell = &cells_[cell->children + (right ? 1 : 0) + (upper ? 2 : 0)];
  }
  bool inside = cell->odd;
  for (int k = 0; k < cell->turn_count; ++k)
    if (turns_[cell->first_turn + k] <= v) inside = !inside;
  for (int k = 0; k < cell->arc_count; ++k)
    if (is_right_of(arcs_[cell_arcs_[cell->first_arc + k]], u, v)) inside = !inside;
  return inside;
}

template <class Visit>
bool TrimRegion::any_arc(const Rectangle& rectangle, Visit&& visit) const {
  const auto search = [&](auto&& self, const Cell& cell, const Rectangle& box) -> bool {
    if (!meet(box, rectangle)) return false;
    if (cell.children < 0) {
      for (int k = 0; k < cell.arc_count; ++k)
        if (visit(arcs_[cell_arcs_[cell.first_arc + k]])) return true;
      return false;
    }
    const double u = box.u.middle(), v = box.v.middle();
    for (int child = 0; child < 4; ++child)
      if (self(self, cells_[cell.children + child],
               {child & 1 ? Interval(u, box.u.hi) : Interval(box.u.lo, u),
                child & 2 ? Interval(v, box.v.hi) : Interval(box.v.lo, v)}))
        return true;
    return false;
  };
  return search(search, cells_.front(), {u_, v_});
}

bool TrimRegion::near_border(double u, double v, double tolerance) const {
  const Rectangle around = widened({u, v}, tolerance);
  return any_arc(around, [&](const Arc& arc) {
    if (!meet({{arc.x_lo, arc.x_hi}, {arc.y_lo, arc.y_hi}}, around)) return false;
    constexpr int kDeepest = 50;
    return arc.curve ? is_near(CurvePart(arc.curve.get(), arc.t), {u, v}, tolerance, kDeepest)
                     : is_near(BezierPart(Points(arc.points)), {u, v}, tolerance, kDeepest);
  });
}

TrimRegion::Coverage TrimRegion::coverage_unshifted(const Rectangle& rectangle) const {
  const bool crossed = any_arc(rectangle, [&](const Arc& arc) {
    if (!meet({{arc.x_lo, arc.x_hi}, {arc.y_lo, arc.y_hi}}, rectangle)) return false;
    constexpr int kDeepest = 8;
    return arc.curve ? may_meet(CurvePart(arc.curve.get(), arc.t), rectangle, kDeepest)
                     : may_meet(BezierPart(Points(arc.points)), rectangle, kDeepest);
  });
  if (crossed) return Coverage::mixed;
  return holds(rectangle.u.middle(), rectangle.v.middle()) ? Coverage::inside : Coverage::outside;
}

TrimRegion::Coverage TrimRegion::coverage(const Rectangle& rectangle) const {
  // Hits of lines that hardly cross the surface count so far beyond the border.
  const Rectangle wide = widened(rectangle, kShallowReach * std::max(u_.width(), v_.width()));
  Coverage result = Coverage::outside;
  any_shift(wide, [&](const Vec2& by) {
    const Coverage one = coverage_unshifted({wide.u + Interval(by.x), wide.v + Interval(by.y)});
    if (one != Coverage::outside) result = one;
    return one == Coverage::inside;
  });
  return result;
}

std::shared_ptr<const TrimRegion> trim_of(const Body& body, int face_index) {
  const Face& face = body.faces[face_index];
  if (!face.trimmed) return nullptr;
  std::vector<std::vector<TrimRegion::Part>> loops;
  for (int loop : face.loops) {
    loops.emplace_back();
    for (int c : body.loops[loop].coedges) loops.back().push_back({body.coedges[c].image, body.coedges[c].forward});
  }
  return std::make_shared<const TrimRegion>(loops, face.surface->periods());
}

}  // namespace lekalo::geometry
