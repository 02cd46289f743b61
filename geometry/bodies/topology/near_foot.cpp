#include "geometry/bodies/topology/near_foot.h"

#include <algorithm>
#include <cmath>

namespace lekalo::geometry {

NearFoot near_foot(const Surface& surface, const Vec3& p, const Vec2& near) {
  Vec2 at = near;
  constexpr int kMaxIterations = 40;
  constexpr double kRounding = 1e-17, kNearly = 1e-11;
  double last = kInfinity;
  for (int i = 0; i < kMaxIterations; ++i) {
    const SurfaceJet s = surface.evaluate(at.x, at.y, 1);
    const Vec3 off = p - s.point();
    const double e = glm::dot(s.du(), s.du()), f = glm::dot(s.du(), s.dv()), g = glm::dot(s.dv(), s.dv()),
                 a = glm::dot(off, s.du()), b = glm::dot(off, s.dv()), d = e * g - f * f;
    if (!(d > 0)) return {at, false};
    const Vec2 step((a * g - b * f) / d, (b * e - a * f) / d);
    const double length = glm::length(step.x * s.du() + step.y * s.dv());
    at += step;
    if (!(std::abs(at.x) + std::abs(at.y) < kInfinity)) return {at, false};
    const double scale = glm::length(p) + std::sqrt(std::max(e, g));
    if (length <= kRounding * scale || (length >= last && length < kNearly * scale)) return {at, true};
    last = length;
  }
  return {at, false};
}

}  // namespace lekalo::geometry
