#include "geometry/shapes/body_shape.h"

#include <stdexcept>

namespace lekalo::geometry {

BodyShape::BodyShape(BodyPtr body) : body_(std::move(body)), intersector_(*body_), box_(geometry::bounds(*body_)) {
  if (!body_->is_closed()) throw std::invalid_argument("the body is not closed: it has no inside");
}

void BodyShape::all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const {
  intersector_.add_all_hits(line, t, hits);
}

ShapePoint BodyShape::point(const SurfaceHit& hit, const Vec3& near) const {
  return point_of_face(body_->faces[hit.face], hit, near);
}

ShapePoint point_of_face(const Face& face, const SurfaceHit& hit, const Vec3& near) {
  const Surface& surface = *face.surface;
  const SurfaceJet jet = surface.evaluate_near(near, hit.u, hit.v, 1);
  const double sign = face.forward ? 1 : -1;
  return {jet.point(), sign * surface.normal(hit.u, hit.v, jet), jet.du(), jet.dv(), hit.u, hit.v};
}

}  // namespace lekalo::geometry
