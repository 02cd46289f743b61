#include "geometry/queries/intersections/crossing_candidates.h"

#include <algorithm>
#include <cmath>

#include "geometry/queries/intersections/leaving_border.h"

namespace lekalo::geometry {

namespace {

// Second derivatives are bounded anew for so many levels; below, those of the cell above do as long as the bulge is a
// small part of the cell (near poles they fall with it).
constexpr int kBoundedLevels = 4;
constexpr double kCrooked = 0.05;
// Rounding of corners, and of what is computed from them, of the coordinates.
constexpr double kRounding = 1e-14;
// A Newton iteration's place counts for a cell from so far outside of it, of its width.
constexpr double kOutside = 1e-6;
// Columns of a Jacobian whose components are taken at different places: their bounds are those of components.
constexpr double kComponents = 1.8;

// The narrower one of what is known and the box.
void narrow(VectorRange& range, const Box3& box) {
  const Vec3 half = 0.5 * box.size();
  if (glm::length(half) < glm::length(range.half))
    range = {box.center(), half, glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi)))};
}

Box3 common(const Box3& a, const Box3& b) { return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)}; }

// Of f(t) - (the chord's place) along the axis, f'' being in the range and the chord over a stretch h. `sizes`: of the
// axis.
Interval off_chord(const Vec3& axis, const Vec3& sizes, const VectorRange& second, double h) {
  const double middle = glm::dot(axis, second.middle), half = glm::dot(sizes, second.half);
  const double scale = -h * h / 8;
  return {scale * std::max(0.0, middle + half), scale * std::min(0.0, middle - half)};
}

double largest(const Vec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

double det(const Vec3& a, const Vec3& b, const Vec3& c) { return glm::dot(a, glm::cross(b, c)); }

}  // namespace

CurveCells::CurveCells(const Curve& curve, double end_share) : curve_(curve) {
  const Interval domain = curve.domain();
  const double left_out = end_share * domain.width();
  inner_ = {domain.lo + left_out, domain.hi - left_out};
  ends_[0] = {1, curve.point(domain.lo), left_out};
  ends_[1] = {-1, curve.point(next_down(domain.hi)), left_out};
  for (const CurvePiece& piece : curve.pieces()) {
    const Interval t = intersect(piece.domain, inner_);
    if (!(t.hi > t.lo)) continue;
    cells_.push_back(make(t, curve.point(t.lo), curve.point(t.hi), nullptr));
  }
  roots_ = static_cast<int>(cells_.size());
}

const CurveCells::End* CurveCells::end_at(const Cell& cell) const {
  return cell.t.lo == inner_.lo ? &ends_[0] : cell.t.hi == inner_.hi ? &ends_[1] : nullptr;
}

CurveCells::Cell CurveCells::make(const Interval& t, const Vec3& begin, const Vec3& end, const Cell* above) const {
  Cell cell{t, begin, end};
  cell.rounding = kRounding * std::max(largest(begin), largest(end));
  cell.box.include(begin), cell.box.include(end);
  if (above) cell.depth = above->depth + 1, cell.first = above->first, cell.second = above->second;
  const auto bulge = [&] { return cell.second.largest * t.width() * t.width() / 8 + cell.rounding; };
  const bool inherits = above && cell.depth > kBoundedLevels && above->bulge <= kCrooked * glm::length(end - begin);
  Box3 hull = Box3::everything();
  if (!inherits) {
    const Interval up_to_ends{t.lo == inner_.lo ? curve_.domain().lo : t.lo,
                              t.hi == inner_.hi ? curve_.domain().hi : t.hi};
    const CurveEnclosure bounds = curve_.enclose(up_to_ends, 2);
    hull = bounds.d[0];
    narrow(cell.first, bounds.d[1]), narrow(cell.second, bounds.d[2]);
  }
  cell.bulge = bulge();
  cell.box = std::isfinite(cell.bulge) ? common(cell.box.inflated(cell.bulge), hull.inflated(cell.rounding)) : hull;
  return cell;
}

int CurveCells::children(int index) {
  if (cells_[index].children >= 0) return cells_[index].children;
  const Cell& cell = cells_[index];
  const double middle = cell.t.middle();
  const Vec3 at = curve_.point(middle);
  const Interval halves[] = {{cell.t.lo, middle}, {middle, cell.t.hi}};
  cells_[index].children = static_cast<int>(cells_.size());
  for (int k = 0; k < 2; ++k)
    cells_.push_back(make(halves[k], k == 0 ? cell.begin : at, k == 0 ? at : cell.end, &cell));
  return cells_[index].children;
}

SurfaceCells::SurfaceCells(const Surface& surface) : surface_(surface) {
  for (const SurfacePiece& piece : surface.pieces()) {
    Cell cell;
    cell.domain = piece.domain;
    for (int k = 0; k < 4; ++k)
      cell.corners[k] =
          surface.point(k % 2 ? cell.domain.u.hi : cell.domain.u.lo, k / 2 ? cell.domain.v.hi : cell.domain.v.lo);
    complete(cell);
    cells_.push_back(cell);
  }
  roots_ = static_cast<int>(cells_.size());
}

void SurfaceCells::complete(Cell& cell) const {
  const double hu = cell.domain.u.width(), hv = cell.domain.v.width();
  Box3 corners;
  for (const Vec3& corner : cell.corners) corners.include(corner);
  const auto bulge = [&] { return (hu * hu * cell.second_uu.largest + hv * hv * cell.second_vv.largest) / 8; };
  Box3 hull = Box3::everything();
  if (cell.depth <= kBoundedLevels || !(bulge() <= kCrooked * corners.diameter())) {
    const SurfaceEnclosure bounds = surface_.enclose(cell.domain, 2);
    hull = bounds.d(0, 0);
    narrow(cell.first_u, bounds.d(1, 0)), narrow(cell.first_v, bounds.d(0, 1));
    narrow(cell.second_uu, bounds.d(2, 0)), narrow(cell.second_uv, bounds.d(1, 1));
    narrow(cell.second_vv, bounds.d(0, 2));
  }
  cell.rounding = 0;
  for (const Vec3& corner : cell.corners) cell.rounding = std::max(cell.rounding, kRounding * largest(corner));
  // The bilinear patch of the corners differs from the surface as interpolation along u and along v does.
  cell.bulge = bulge() + cell.rounding;
  cell.box = std::isfinite(cell.bulge) ? common(corners.inflated(cell.bulge), hull.inflated(cell.rounding)) : hull;
}

int SurfaceCells::children(int index) {
  if (cells_[index].children >= 0) return cells_[index].children;
  const Cell& cell = cells_[index];
  // Across the longer way, as far as that is known.
  const double along_u = std::max(glm::length(cell.corners[1] - cell.corners[0]),
                                  glm::length(cell.corners[3] - cell.corners[2])) +
                         std::min(cell.domain.u.width() * cell.domain.u.width() * cell.second_uu.largest, 1e300) / 8,
               along_v = std::max(glm::length(cell.corners[2] - cell.corners[0]),
                                  glm::length(cell.corners[3] - cell.corners[1])) +
                         std::min(cell.domain.v.width() * cell.domain.v.width() * cell.second_vv.largest, 1e300) / 8;
  const bool by_u = along_u == along_v ? cell.depth % 2 == 0 : along_u > along_v;
  const double middle = by_u ? cell.domain.u.middle() : cell.domain.v.middle();
  const Vec3 at[2] = {by_u ? surface_.point(middle, cell.domain.v.lo) : surface_.point(cell.domain.u.lo, middle),
                      by_u ? surface_.point(middle, cell.domain.v.hi) : surface_.point(cell.domain.u.hi, middle)};
  cells_[index].children = static_cast<int>(cells_.size());
  for (int k = 0; k < 2; ++k) {
    Cell half = cell;
    half.depth = cell.depth + 1;
    half.children = -1;
    half.box = {};
    (by_u ? half.domain.u : half.domain.v) = k == 0 ? Interval((by_u ? cell.domain.u : cell.domain.v).lo, middle)
                                                    : Interval(middle, (by_u ? cell.domain.u : cell.domain.v).hi);
    // Corners on the cut: of the first half those at its upper end.
    for (int j = 0; j < 2; ++j) half.corners[by_u ? (k == 0 ? 1 : 0) + 2 * j : (k == 0 ? 2 : 0) + j] = at[j];
    complete(half);
    cells_.push_back(half);
  }
  return cells_[index].children;
}

bool SurfaceCells::holds(const Vec3& point, double tolerance) {
  // Cells that may hold it; Newton's iteration finds it from those that are nearly flat.
  constexpr double kFlat = 0.02;
  constexpr int kDeep = 40;
  std::vector<int> left;
  for (int i = 0; i < roots_; ++i) left.push_back(i);
  while (!left.empty()) {
    const int index = left.back();
    left.pop_back();
    const Cell& cell = cells_[index];
    if (!cell.box.inflated(tolerance).contains(point)) continue;
    const bool flat = cell.bulge <= kFlat * glm::length(cell.box.hi - cell.box.lo);
    if (flat && is_foot_near(cell, point, tolerance)) return true;
    if (cell.depth >= kDeep || (flat && cell.depth >= 2 * kBoundedLevels)) continue;
    const int first = children(index);
    left.push_back(first), left.push_back(first + 1);
  }
  return false;
}

bool SurfaceCells::is_foot_near(const Cell& cell, const Vec3& point, double tolerance) const {
  constexpr int kSteps = 8;
  double u = cell.domain.u.middle(), v = cell.domain.v.middle();
  for (int step = 0; step < kSteps; ++step) {
    const SurfaceJet s = surface_.evaluate(u, v, 1);
    const Vec3 off = point - s.point();
    if (glm::length(off) <= tolerance) return true;
    const double e = glm::dot(s.du(), s.du()), f = glm::dot(s.du(), s.dv()), g = glm::dot(s.dv(), s.dv());
    const double x = glm::dot(off, s.du()), y = glm::dot(off, s.dv()), area = e * g - f * f;
    if (!(area > 0)) return false;
    u = cell.domain.u.clamp(u + (g * x - f * y) / area);
    v = cell.domain.v.clamp(v + (e * y - f * x) / area);
  }
  return false;
}

namespace {

class Passages {
 public:
  Passages(CurveCells& curve, SurfaceCells& surface, double touch, int max_touches, int max_pairs,
           std::vector<double>& places)
      : curve_(curve),
        surface_(surface),
        touch_(touch),
        max_touches_(max_touches),
        max_pairs_(max_pairs),
        places_(places) {}

  bool run() {
    const size_t before = places_.size();
    for (int i = 0; i < curve_.roots(); ++i)
      for (int j = 0; j < surface_.roots(); ++j)
        if (!meet(i, j)) {
          places_.resize(before);
          return false;
        }
    // Stretches that go on in one another are one.
    std::sort(touching_.begin(), touching_.end(), [](const Interval& a, const Interval& b) { return a.lo < b.lo; });
    for (size_t first = 0, last = 0; first < touching_.size(); first = last) {
      double end = touching_[first].hi;
      for (last = first + 1; last < touching_.size() && touching_[last].lo <= end; ++last)
        end = std::max(end, touching_[last].hi);
      places_.push_back(touching_[first].lo), places_.push_back(end);
    }
    return true;
  }

 private:
  static bool is_apart(const CurveCells::Cell& c, const SurfaceCells::Cell& s) {
    for (int k = 0; k < 3; ++k)
      if (c.box.lo[k] > s.box.hi[k] || s.box.lo[k] > c.box.hi[k]) return true;
    if (!std::isfinite(c.bulge + s.bulge)) return false;
    const double ht = c.t.width(), hu = s.domain.u.width(), hv = s.domain.v.width(), rounding = c.rounding + s.rounding;
    const Vec3 along_u = s.corners[1] - s.corners[0] + s.corners[3] - s.corners[2],
               along_v = s.corners[2] - s.corners[0] + s.corners[3] - s.corners[1];
    const Vec3 normal = glm::cross(along_u, along_v), chord = c.end - c.begin;
    const Vec3 corners[] = {s.corners[0] - c.begin, s.corners[1] - c.begin, s.corners[2] - c.begin,
                            s.corners[3] - c.begin};
    const auto parts = [&](const Vec3& axis) {
      double lo = kInfinity, hi = -kInfinity;
      for (const Vec3& corner : corners) {
        const double x = glm::dot(axis, corner);
        lo = std::min(lo, x), hi = std::max(hi, x);
      }
      const double end = glm::dot(axis, chord), slack = glm::length(axis) * rounding;
      const Vec3 sizes = glm::abs(axis);
      const Interval by_t = off_chord(axis, sizes, c.second, ht), by_u = off_chord(axis, sizes, s.second_uu, hu),
                     by_v = off_chord(axis, sizes, s.second_vv, hv);
      return lo + by_u.lo + by_v.lo > std::max(0.0, end) + by_t.hi + slack ||
             hi + by_u.hi + by_v.hi < std::min(0.0, end) + by_t.lo - slack;
    };
    return parts(normal) || parts(chord) || parts(glm::cross(normal, along_u)) || parts(glm::cross(normal, along_v));
  }

  // Whether all of the curve's cell is so near to the surface's, which are not apart, or both are as small.
  bool touches(const CurveCells::Cell& c, const SurfaceCells::Cell& s) const {
    if (!(c.bulge + s.bulge <= 0.5 * touch_)) return false;
    if (glm::length(c.end - c.begin) <= touch_) return glm::length(s.box.hi - s.box.lo) <= touch_;
    const Vec3 normal = glm::cross(s.corners[1] - s.corners[0] + s.corners[3] - s.corners[2],
                                   s.corners[2] - s.corners[0] + s.corners[3] - s.corners[1]);
    const double most = 0.5 * touch_ * glm::length(normal);
    for (const Vec3& end : {c.begin, c.end})
      for (const Vec3& corner : s.corners)
        if (!(std::abs(glm::dot(normal, end - corner)) <= most)) return false;
    return true;
  }

  // Whether r(t) = s(u, v) has at most one solution in the cells.
  static bool meets_once(const CurveCells::Cell& c, const SurfaceCells::Cell& s) {
    const double ht = c.t.width(), hu = s.domain.u.width(), hv = s.domain.v.width();
    const Vec3 r = (c.end - c.begin) / ht;
    const Vec3 su = (s.corners[1] - s.corners[0] + s.corners[3] - s.corners[2]) / (2 * hu),
               sv = (s.corners[2] - s.corners[0] + s.corners[3] - s.corners[1]) / (2 * hv);
    const double of_r = kComponents * ht * c.second.largest,
                 of_u = kComponents * (hu * s.second_uu.largest + hv * s.second_uv.largest),
                 of_v = kComponents * (hu * s.second_uv.largest + hv * s.second_vv.largest);
    const double a = glm::length(r), b = glm::length(su), d = glm::length(sv);
    return std::abs(det(r, su, sv)) > (a + of_r) * (b + of_u) * (d + of_v) - a * b * d;
  }

  // Newton's iteration from the middle of the cells.
  bool solve(const CurveCells::Cell& c, const SurfaceCells::Cell& s, double& t) const {
    t = c.t.middle();
    double u = s.domain.u.middle(), v = s.domain.v.middle();
    constexpr int kSteps = 12;
    for (int step = 0; step < kSteps; ++step) {
      const CurveJet r = curve_.curve().evaluate(t, 1);
      const SurfaceJet at = surface_.surface().evaluate(u, v, 1);
      const Vec3 off = at.point() - r.d[0];
      const double volume = det(r.d[1], at.du(), at.dv());
      if (volume == 0 || !std::isfinite(volume)) return false;
      // r' dt - s_u du - s_v dv = s - r.
      const double dt = det(off, at.du(), at.dv()) / volume, du = -det(r.d[1], off, at.dv()) / volume,
                   dv = -det(r.d[1], at.du(), off) / volume;
      t += dt, u += du, v += dv;
      const auto near = [](const Interval& range, double x, double by) {
        return x >= range.lo - by * range.width() && x <= range.hi + by * range.width();
      };
      if (!near(c.t, t, 1) || !near(s.domain.u, u, 1) || !near(s.domain.v, v, 1)) return false;
      if (std::abs(dt) <= 1e-12 * c.t.width() || step + 1 == kSteps)
        return near(c.t, t, kOutside) && near(s.domain.u, u, kOutside) && near(s.domain.v, v, kOutside) &&
               std::abs(dt) <= 1e-6 * c.t.width();
    }
    return false;
  }

  bool meet(int i, int j) {
    if (++pairs_ > max_pairs_) return false;
    const CurveCells::Cell& c = curve_.cell(i);
    const SurfaceCells::Cell& s = surface_.cell(j);
    if (is_apart(c, s)) return true;
    if (const CurveCells::End* end = curve_.end_at(c); end && leaves_border(c, *end, s, surface_.surface()))
      return true;
    if (meets_once(c, s)) {
      if (double t = 0; solve(c, s, t)) {
        places_.push_back(c.t.clamp(t));
        return true;
      }
    }
    if (touches(c, s)) {
      touching_.push_back(c.t);
      return static_cast<int>(touching_.size()) <= max_touches_;
    }
    const double of_curve = glm::length(c.end - c.begin) + 2 * c.bulge, of_surface = glm::length(s.box.hi - s.box.lo);
    if (of_curve > of_surface || of_surface <= touch_) {
      const int first = curve_.children(i);
      return meet(first, j) && meet(first + 1, j);
    }
    const int first = surface_.children(j);
    return meet(i, first) && meet(i, first + 1);
  }

  CurveCells& curve_;
  SurfaceCells& surface_;
  double touch_;
  int max_touches_, max_pairs_, pairs_ = 0;
  std::vector<Interval> touching_;
  std::vector<double>& places_;
};

}  // namespace

bool add_crossing_candidates(CurveCells& curve, SurfaceCells& surface, double touch, int max_touches, int max_pairs,
                             std::vector<double>& places) {
  return Passages(curve, surface, touch, max_touches, max_pairs, places).run();
}

}  // namespace lekalo::geometry
