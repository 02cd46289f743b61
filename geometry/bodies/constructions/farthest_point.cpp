#include "geometry/bodies/constructions/farthest_point.h"

#include <algorithm>

namespace lekalo::geometry {

Vec3 farthest_point(const Curve& curve, const Vec3& along) {
  constexpr int kSamples = 16, kSteps = 40;
  const auto reach = [&](double t) { return glm::dot(curve.point(t), along); };
  double farthest = curve.domain().lo;
  for (const CurvePiece& piece : curve.pieces()) {
    const Interval& range = piece.domain;
    const auto sample = [&](int k) { return range.clamp(range.lo + range.width() * k / kSamples); };
    int best = 0;
    for (int k = 1; k <= kSamples; ++k)
      if (reach(sample(k)) > reach(sample(best))) best = k;
    Interval near{sample(std::max(best - 1, 0)), sample(std::min(best + 1, kSamples))};
    for (int step = 0; step < kSteps; ++step) {
      const double third = near.width() / 3;
      if (reach(near.lo + third) < reach(near.hi - third))
        near.lo += third;
      else
        near.hi -= third;
    }
    for (const double t : {near.middle(), sample(best)})
      if (reach(t) > reach(farthest)) farthest = t;
  }
  return curve.point(farthest);
}

}  // namespace lekalo::geometry
