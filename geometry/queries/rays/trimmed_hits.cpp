#include "geometry/queries/rays/trimmed_hits.h"

#include <algorithm>
#include <cmath>

#include "geometry/surfaces/analytic/local_line.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

HitFilter::HitFilter(std::shared_ptr<const TrimRegion> trim) : trim_(std::move(trim)) {
  if (trim_) slack_ = kTrimSlack * std::max(trim_->u_range().width(), trim_->v_range().width());
}

bool HitFilter::is_inside(const LineHit& hit, const Line& line, const Surface& surface) const {
  if (trim_->contains(hit.u, hit.v, slack_)) return true;
  // The rounding of a line moves its hit with a surface that it hardly crosses much further than the slack, along the
  // line, and the neighbour across the edge, which it may cross steeply, has accepted it.
  const Interval &u = trim_->u_range(), &v = trim_->v_range();
  const double beyond = std::max({u.lo - hit.u, hit.u - u.hi, v.lo - hit.v, hit.v - v.hi});
  const double farthest = kShallowReach * std::max(u.width(), v.width());
  if (beyond > farthest || !trim_->contains(hit.u, hit.v, farthest)) return false;
  const SurfaceJet jet = surface.evaluate(hit.u, hit.v, 1);
  const HitShift shift = shift_of_hit(jet, line.direction);
  const double rounding = kShallowSlack * (glm::length(jet.point()) + glm::length(jet.du()) * u.width() +
                                           glm::length(jet.dv()) * v.width());
  const double slack = std::min(std::max(slack_, rounding * std::max(shift.across.x, shift.across.y)), farthest);
  const double lean = glm::length(shift.along);
  if (!(lean < kInfinity)) return false;
  const Vec2 moved = std::min(rounding, (farthest - slack) / lean) * shift.along;
  return trim_->contains(hit.u, hit.v, slack) || trim_->contains(hit.u + moved.x, hit.v + moved.y, slack) ||
         trim_->contains(hit.u - moved.x, hit.v - moved.y, slack);
}

}  // namespace lekalo::geometry
