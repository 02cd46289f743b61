#include "geometry/shapes/csg/body_shape.h"

#include <stdexcept>

#include "geometry/queries/differential/curvature.h"

namespace lekalo::geometry {

BodyShape::BodyShape(BodyPtr body) : body_(std::move(body)), intersector_(*body_), box_(geometry::bounds(*body_)) {
  if (!body_->is_closed()) throw std::invalid_argument("the body is not closed: it has no inside");
}

void BodyShape::all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const {
  intersector_.add_all_hits(line, t, hits);
}

ShapePoint BodyShape::point(const SurfaceHit& hit, const Vec3& near) const {
  const Face& face = body_->faces[hit.face];
  return point_on(*face.surface, face.forward ? 1 : -1, hit.u, hit.v, near);
}

std::optional<Mat3> BodyShape::shape_operator(const SurfaceHit& hit, const Vec3&) const {
  const Face& face = body_->faces[hit.face];
  return geometry::shape_operator(*face.surface, face.forward ? 1 : -1, hit.u, hit.v);
}

}  // namespace lekalo::geometry
