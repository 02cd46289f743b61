#include "geometry/curves/derived/corners.h"

#include <cmath>

namespace lekalo::geometry {

namespace {

constexpr double kBeside = 1e-9;  // of the domain: where directions are taken
constexpr double kCorner = 1e-6;  // radians

bool differ(const Vec3& a, const Vec3& b) {
  const double size = glm::length(a) * glm::length(b);
  return size > 0 && (glm::length(glm::cross(a, b)) > kCorner * size || glm::dot(a, b) < 0);
}

}  // namespace

std::optional<double> first_corner(const Curve& curve) {
  const Interval domain = curve.domain();
  const double beside = kBeside * domain.width();
  const auto direction = [&](double t) { return curve.evaluate(domain.clamp(t), 1).d[1]; };
  for (const CurvePiece& piece : curve.pieces()) {
    const double t = piece.domain.hi;
    const bool is_end = t >= domain.hi;
    if (is_end && !curve.is_closed()) continue;
    if (differ(direction(t - beside), direction(is_end ? domain.lo + beside : t + beside))) return t;
  }
  return std::nullopt;
}

}  // namespace lekalo::geometry
