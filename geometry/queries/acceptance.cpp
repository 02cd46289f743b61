#include "geometry/queries/acceptance.h"

#include <algorithm>
#include <cmath>

#include "geometry/tolerances.h"

namespace lekalo::geometry {

Acceptance::Acceptance(std::shared_ptr<const TrimRegion> trim) : trim_(std::move(trim)) {
  if (trim_) slack_ = kTrimSlack * std::max(trim_->u_range().width(), trim_->v_range().width());
}

bool Acceptance::is_inside(const LineHit& hit, const Line& line, const Surface& surface) const {
  if (trim_->contains(hit.u, hit.v, slack_)) return true;
  // The rounding of a line moves its hit with a surface that it hardly crosses much further than the slack, and the
  // neighbour across the edge, which it may cross steeply, has accepted it.
  const Interval &u = trim_->u_range(), &v = trim_->v_range();
  const double beyond = std::max({u.lo - hit.u, hit.u - u.hi, v.lo - hit.v, hit.v - v.hi});
  if (beyond > kShallowReach * std::max(u.width(), v.width())) return false;
  const SurfaceJet jet = surface.evaluate(hit.u, hit.v, 1);
  const Vec3 normal = glm::cross(jet.du(), jet.dv());
  const double area = glm::length(normal), length = glm::length(line.direction);
  if (!(area > 0)) return false;
  const double rounding = kShallowSlack * (glm::length(line.origin) + std::abs(hit.t) * length);
  const double sine = std::abs(glm::dot(normal, line.direction)) / (area * length);
  // The least length of a unit of parameters.
  const double stretch = area / std::max(glm::length(jet.du()), glm::length(jet.dv()));
  const double moved = rounding / (sine * stretch);
  return moved > slack_ &&
         trim_->contains(hit.u, hit.v, std::min(moved, kShallowReach * std::max(u.width(), v.width())));
}

}  // namespace lekalo::geometry
