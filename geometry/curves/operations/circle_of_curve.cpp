#include "geometry/curves/operations/circle_of_curve.h"

#include <cmath>

namespace lekalo::geometry {

std::shared_ptr<const Circle> circle_of(const Curve& curve) {
  constexpr int kSamples = 12;
  constexpr double kSame = 1e-12;
  const Interval domain = curve.domain();
  Vec3 center(0), normal(0);
  double radius = 0;
  const double size = bounds(curve).diameter();
  for (int k = 0; k <= kSamples; ++k) {
    const double t = domain.lo + domain.width() * k / kSamples;
    const CurveJet jet = curve.evaluate(t, 2);
    const double speed = glm::length(jet.d[1]);
    const Vec3 tangent = jet.d[1] / speed, bend = (jet.d[2] - glm::dot(jet.d[2], tangent) * tangent) / (speed * speed);
    const double curvature = glm::length(bend);
    if (!(curvature * size > 1e-6)) return nullptr;
    const Vec3 found = jet.d[0] + bend / (curvature * curvature);
    const Vec3 turning = glm::cross(tangent, bend / curvature);
    if (k == 0) center = found, normal = turning, radius = 1 / curvature;
    const double same = kSame * (radius + glm::length(center));
    if (glm::length(found - center) > same || std::abs(1 / curvature - radius) > same ||
        glm::length(turning - normal) > kSame)
      return nullptr;
  }
  const Vec3 begin = curve.point(domain.lo) - center, end = curve.point(domain.hi) - center;
  const Frame frame = frame_from(center, normal, begin);
  double angle = std::atan2(glm::dot(end, frame.y), glm::dot(end, frame.x));
  if (angle <= 1e-9) angle += kTwoPi;
  if (curve.is_closed()) angle = kTwoPi;
  return std::make_shared<Circle>(frame, glm::length(begin), Interval(0, angle));
}

}  // namespace lekalo::geometry
