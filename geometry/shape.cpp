#include "geometry/shape.h"

#include <cmath>
#include <stdexcept>

namespace lekalo::geometry {

ShapePoint point_on(const Surface& surface, double sign, double u, double v, const Vec3& near) {
  return point_on(surface, sign, u, v, surface.evaluate_near(near, u, v, 1));
}

ShapePoint point_on(const Surface& surface, double sign, double u, double v, const SurfaceJet& jet) {
  return {jet.point(), sign * surface.normal(u, v, jet), jet.du(), jet.dv(), u, v};
}

std::vector<SurfacePart> TransformedShape::surface_parts() const {
  std::vector<SurfacePart> parts = original_->surface_parts();
  for (SurfacePart& part : parts) part.solid = image(part.solid);
  return parts;
}

ShapePoint TransformedShape::point(const SurfaceHit& hit, const Vec3& near) const {
  ShapePoint at = original_->point(hit, inverse_.point(near));
  at.position = map_.point(at.position);
  at.normal = glm::normalize(glm::transpose(inverse_.linear) * at.normal);
  at.du = map_.direction(at.du);
  at.dv = map_.direction(at.dv);
  at.error *= operator_norm_bound(map_);
  return at;
}

// The second form b(x, y) = x . S y of tangent vectors is that of second derivatives along the normal, r_ij . m. Those
// map with A, the normal with A^-T / |A^-T m|: b'(A x, A y) = b(x, y) / |A^-T m|.
Mat3 moved(const Mat3& shape_operator, const Vec3& normal, const Affine& map) {
  const Mat3 back = glm::inverse(map.linear);
  const Vec3 turned = glm::transpose(back) * normal;
  const double length = glm::length(turned);
  const Vec3 m = turned / length;
  const Mat3 along = Mat3(1) - glm::outerProduct(m, m);
  return (1 / length) * (along * (glm::transpose(back) * shape_operator * back) * along);
}

std::optional<Mat3> TransformedShape::shape_operator(const SurfaceHit& hit, const Vec3& near) const {
  const Vec3 there = inverse_.point(near);
  const std::optional<Mat3> own = original_->shape_operator(hit, there);
  if (!own) return std::nullopt;
  return moved(*own, original_->point(hit, there).normal, map_);
}

double operator_norm_bound(const Affine& map) {
  double square = 0;
  for (int k = 0; k < 3; ++k) square += glm::dot(map.linear[k], map.linear[k]);
  return std::sqrt(square);
}

bool Shape::first_hit(const Line& line, const Interval& t, SurfaceHit& hit) const {
  // The room is kept from call to call, but for calls within calls.
  static thread_local std::vector<SurfaceHit> room;
  std::vector<SurfaceHit> hits = std::move(room);
  hits.clear();
  all_hits(line, t, hits);
  const bool found = !hits.empty();
  if (found) hit = hits.front();
  room = std::move(hits);
  return found;
}

ShapePtr transformed(const ShapePtr& shape, const Affine& map) {
  if (map.is_identity()) return shape;
  if (!(std::abs(glm::determinant(map.linear)) > 0)) throw std::invalid_argument("the map is singular");
  if (const auto* moved = dynamic_cast<const TransformedShape*>(shape.get()))
    return transformed(moved->original(), map * moved->map());
  return std::make_shared<TransformedShape>(shape, map);
}

}  // namespace lekalo::geometry
