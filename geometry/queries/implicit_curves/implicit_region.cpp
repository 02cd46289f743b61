#include "geometry/queries/implicit_curves/implicit_region.h"

namespace lekalo::geometry {

bool ImplicitRegion::misses(const Box3& other) const {
  if (!is_ball) return glm::any(glm::lessThan(other.hi, box.lo)) || glm::any(glm::greaterThan(other.lo, box.hi));
  const Vec3 off = glm::max(glm::max(other.lo - box.center(), box.center() - other.hi), Vec3(0));
  return glm::dot(off, off) > radius() * radius() * (1 + 1e-12);
}

}  // namespace lekalo::geometry
