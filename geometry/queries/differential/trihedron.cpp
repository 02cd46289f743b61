#include "geometry/queries/differential/trihedron.h"

#include <stdexcept>

namespace lekalo::geometry {

namespace {

// Normals that cancel to less than this have no direction left.
constexpr double kVanishes = 1e-9;

}  // namespace

SurfaceTrihedron::SurfaceTrihedron(const std::vector<SurfacePtr>& surfaces, double share) {
  if (surfaces.empty() || surfaces.size() > 2) throw std::invalid_argument("a trihedron is of one surface or two");
  for (const SurfacePtr& surface : surfaces)
    sides_.push_back({surface, SurfaceProjector(surface),
                      surfaces.size() == 1 ? 1
                      : sides_.empty()     ? share
                                           : 1 - share});
}

Frame SurfaceTrihedron::at(const CurveJet& jet) const {
  if (!(glm::length(jet.d[1]) > 0)) throw std::invalid_argument("the curve has no tangent there");
  const Vec3 tangent = glm::normalize(jet.d[1]);
  Vec3 normal(0);
  for (const Side& side : sides_) {
    const SurfaceFootPoint foot = side.projector.foot_points(jet.point()).foot_points.front();
    normal += side.weight * side.surface->normal(foot.u, foot.v);
  }
  normal -= glm::dot(normal, tangent) * tangent;
  if (!(glm::length(normal) > kVanishes))
    throw std::invalid_argument("the normals of the surfaces are opposite there: their mean has no direction");
  normal = glm::normalize(normal);
  return {jet.point(), normal, glm::cross(tangent, normal), tangent};
}

}  // namespace lekalo::geometry
