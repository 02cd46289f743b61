// Jets map by the linear part, enclosures by the same in interval arithmetic, homogeneous control points (w p, w) to
// (w M p, w), normals by the inverse transpose times the determinant's sign (Golovanov 2016, 1.4). A line goes to the
// original's own space, whose formula finds the hits.
#include "geometry/transformed.h"

#include <stdexcept>

#include "geometry/numerics/instruction_sets.h"
#include "geometry/surfaces/analytic/local_line.h"

namespace lekalo::geometry {

namespace {

// The image of a box, rounded outward.
Box3 image_of(const Box3& box, const Mat3& linear, const Vec3& offset) {
  if (box.empty()) return box;
  Box3 result;
  for (int row = 0; row < 3; ++row) {
    Interval sum = offset[row];
    for (int k = 0; k < 3; ++k) sum += Interval(linear[k][row]) * Interval(box.lo[k], box.hi[k]);
    result.lo[row] = sum.lo;
    result.hi[row] = sum.hi;
  }
  return result;
}

void map_points(std::vector<Vec4>& points, const Affine& map) {
  for (Vec4& p : points) p = Vec4(map.linear * Vec3(p) + p.w * map.offset, p.w);
}

}  // namespace

CurveJet TransformedCurve::evaluate(double t, int order) const {
  CurveJet jet = original_->evaluate(t, order);
  jet.d[0] = map_.point(jet.d[0]);
  for (int k = 1; k <= order; ++k) jet.d[k] = map_.direction(jet.d[k]);
  return jet;
}

CurveEnclosure TransformedCurve::enclose(const Interval& t, int order) const {
  CurveEnclosure result = original_->enclose(t, order);
  for (int k = 0; k <= order; ++k) result.d[k] = image_of(result.d[k], map_.linear, k == 0 ? map_.offset : Vec3(0));
  return result;
}

std::vector<CurvePiece> TransformedCurve::pieces() const {
  std::vector<CurvePiece> result = original_->pieces();
  for (CurvePiece& piece : result) map_points(piece.points, map_);
  return result;
}

std::optional<NurbsCurveForm> TransformedCurve::as_nurbs() const {
  std::optional<NurbsCurveForm> form = original_->as_nurbs();
  if (form) map_points(form->points, map_);
  return form;
}

TransformedSurface::TransformedSurface(SurfacePtr original, const Affine& map)
    : original_(std::move(original)), map_(map) {
  const double determinant = map.determinant();
  const Mat3& a = map.linear;
  if (!std::isfinite(determinant))
    throw std::invalid_argument("the transform is too large: its determinant is beyond what numbers can hold");
  if (!(std::abs(determinant) > 1e-14 * glm::length(a[0]) * glm::length(a[1]) * glm::length(a[2])))
    throw std::invalid_argument("the transform flattens space: its determinant is 0");
  inverse_ = map.inverse();
  orientation_ = determinant > 0 ? 1 : -1;
  set_reversed(original_->reversed());
  const Box3 box = bounds(*original_);
  center_ = map.point(box.bounded() ? box.center() : Vec3(0));
}

SurfaceJet TransformedSurface::evaluate(double u, double v, int order) const {
  SurfaceJet jet = original_->evaluate(u, v, order);
  jet.values[0] = map_.point(jet.values[0]);
  for (int k = 1; k < (order + 1) * (order + 2) / 2; ++k) jet.values[k] = map_.direction(jet.values[k]);
  return jet;
}

SurfaceEnclosure TransformedSurface::enclose(const Rectangle& box, int order) const {
  SurfaceEnclosure result = original_->enclose(box, order);
  for (int k = 0; k < (order + 1) * (order + 2) / 2; ++k)
    result.values[k] = image_of(result.values[k], map_.linear, k == 0 ? map_.offset : Vec3(0));
  return result;
}

std::vector<SurfacePiece> TransformedSurface::pieces() const {
  std::vector<SurfacePiece> result = original_->pieces();
  for (SurfacePiece& piece : result) map_points(piece.points, map_);
  return result;
}

std::optional<NurbsSurfaceForm> TransformedSurface::as_nurbs() const {
  std::optional<NurbsSurfaceForm> form = original_->as_nurbs();
  if (form) map_points(form->points, map_);
  return form;
}

// An affine map keeps the parameter along a line. The line starts anew near the surface before it is mapped: the map of
// a distant origin would lose as many digits as it is farther away than the surface is large.
LEKALO_FUSED void TransformedSurface::meet_line(const Line& line, const Interval& t, LineHits& hits) const {
  const MovedLine moved = moved_near(line, center_);
  LineHits found;
  original_->line_hits({inverse_.point(moved.origin), inverse_.direction(moved.direction)}, Interval::entire(), found);
  for (int i = 0; i < found.size(); ++i) {
    const double at = moved.start + found[i].t;
    if (t.contains(at)) hits.add({at, found[i].u, found[i].v});
  }
}

Vec3 TransformedSurface::normal(double u, double v) const {
  const Vec3 n = original_->normal_sign() * original_->normal(u, v);
  return normal_sign() * orientation_ * glm::normalize(glm::transpose(inverse_.linear) * n);
}

CurvePtr transformed(const CurvePtr& curve, const Affine& map) {
  if (map.is_identity()) return curve;
  if (const auto* inner = dynamic_cast<const TransformedCurve*>(curve.get()))
    return std::make_shared<TransformedCurve>(inner->original(), map * inner->map());
  return std::make_shared<TransformedCurve>(curve, map);
}

SurfacePtr transformed(const SurfacePtr& surface, const Affine& map) {
  if (map.is_identity()) return surface;
  const auto* inner = dynamic_cast<const TransformedSurface*>(surface.get());
  auto result = inner ? std::make_shared<TransformedSurface>(inner->original(), map * inner->map())
                      : std::make_shared<TransformedSurface>(surface, map);
  result->set_reversed(surface->reversed());
  return result;
}

bool is_same(const SurfacePtr& a, const SurfacePtr& b) {
  const auto* moved_a = dynamic_cast<const TransformedSurface*>(a.get());
  const auto* moved_b = dynamic_cast<const TransformedSurface*>(b.get());
  return a == b || (moved_a && moved_b && moved_a->original() == moved_b->original() &&
                    moved_a->map().linear == moved_b->map().linear && moved_a->map().offset == moved_b->map().offset);
}

}  // namespace lekalo::geometry
