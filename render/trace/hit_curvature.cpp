#include "render/trace/hit_curvature.h"

#include <cmath>

namespace lekalo::render {

using namespace geometry;

SurfaceCurvature curvature_at(const World& world, const Hit& hit, const SurfacePoint& point) {
  const HitTarget target = world.target(hit);
  const Affine& map = target.to_world;
  std::optional<Mat3> found;
  Vec3 normal = point.normal;  // in the target's space
  if (target.surface) {
    normal = target.surface->normal(point.u, point.v);
    found = shape_operator(*target.surface, 1, point.u, point.v);
    if (!found && target.surface->max_order() >= 2)  // at a pole
      if (const SurfaceCurvature limit = curvature(*target.surface, point.u, point.v); limit.regular)
        found = shape_operator(limit);
  } else if (target.shape) {
    const Vec3 near = map.inverse().point(point.position);
    const SurfaceHit of_shape{hit.t, hit.u, hit.v, hit.face, hit.piece};
    normal = target.shape->point(of_shape, near).normal;
    found = target.shape->shape_operator(of_shape, near);
  }
  if (!found) return {};
  Mat3 in_world = *found;
  Vec3 normal_in_world = normal;
  if (!map.is_identity()) {
    in_world = moved(*found, normal, map);
    normal_in_world = glm::transpose(map.inverse().linear) * normal;
  }
  if (glm::dot(normal_in_world, point.normal) < 0) in_world = -in_world;
  const SurfaceCurvature result = curvature(in_world, point.normal);
  return std::isfinite(result.principal[0]) && std::isfinite(result.principal[1]) ? result : SurfaceCurvature();
}

}  // namespace lekalo::render
