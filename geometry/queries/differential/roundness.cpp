// The circle through p, q, r, with a = q - p, b = r - p, n = a x b, has the center
// p + (|b|^2 n x a + |a|^2 b x n) / (2 |n|^2).
#include "geometry/queries/differential/roundness.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace lekalo::geometry {

namespace {

constexpr int kSteps = 33;           // divisible by three: the circle is laid through points a third apart
constexpr double kTolerance = 1e-6;  // of the radius; weights of splines are often written with as many digits

// Whether point(0..1) runs on a circle.
bool runs_on_a_circle(const std::function<Vec3(double)>& point) {
  const Vec3 p = point(0), a = point(1.0 / 3) - p, b = point(2.0 / 3) - p, n = glm::cross(a, b);
  const double area = glm::dot(n, n);
  if (!(area > 1e-20 * glm::dot(a, a) * glm::dot(b, b))) return false;  // on a line, or all in one point
  const Vec3 center = p + (glm::dot(b, b) * glm::cross(n, a) + glm::dot(a, a) * glm::cross(b, n)) / (2 * area);
  const double radius = glm::length(p - center);
  for (int k = 0; k <= kSteps; ++k) {
    const Vec3 to = point(static_cast<double>(k) / kSteps) - center;
    if (!(std::fabs(glm::length(to) - radius) <= kTolerance * radius)) return false;
    if (!(std::fabs(glm::dot(to, n)) <= kTolerance * radius * std::sqrt(area))) return false;
  }
  return true;
}

// A place in an interval, at 0 its beginning and at 1 its end.
double place_in(const Interval& range, double share) {
  const double lo = std::isfinite(range.lo) ? range.lo : std::min(-1.0, range.hi - 1);
  const double hi = std::isfinite(range.hi) ? range.hi : std::max(1.0, lo + 1);
  return lo + share * (hi - lo);
}

}  // namespace

bool is_round(const Curve& curve) {
  const Interval t = curve.domain();
  return runs_on_a_circle([&](double share) { return curve.point(place_in(t, share)); });
}

bool is_round(const Surface& surface) {
  const Rectangle domain = surface.domain();
  const auto round_lines = [&](bool along_u) {
    for (const double across : {0.25, 0.5, 0.75})
      if (!runs_on_a_circle([&](double share) {
            return surface.point(place_in(domain.u, along_u ? share : across),
                                 place_in(domain.v, along_u ? across : share));
          }))
        return false;
    return true;
  };
  return round_lines(true) || round_lines(false);
}

}  // namespace lekalo::geometry
