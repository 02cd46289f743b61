#include "geometry/queries/quadrics/torus_sections.h"

#include <cmath>

namespace lekalo::geometry {

namespace {

constexpr double kRounding = 32 * std::numeric_limits<double>::epsilon();
constexpr double kUnclear = 10;

Conic circle(const Vec3& center, const Vec3& x, const Vec3& y) { return {Conic::Kind::ellipse, center, x, y}; }

// The parallel through (rho, z) of a meridian.
Conic parallel(const TorusForm& torus, const Vec2& at) {
  const Frame frame = frame_about(torus.center, torus.axis);
  return circle(torus.center + at.y * torus.axis, at.x * frame.x, at.x * frame.y);
}

// Two points at off^2 = `square` to both sides of a foot point, one where they touch, or none.
std::optional<PlaneIntersection> parallels(const TorusForm& torus, const Vec2& foot_point, const Vec2& along,
                                           double square, const SectionScale& scale) {
  const double rounding = kRounding * scale.size * (torus.minor + scale.size);
  PlaneIntersection result;
  std::vector<Vec2> places;
  if (std::abs(square) <= rounding) {
    result.touching = true;
    places = {foot_point};
  } else if (square > 0) {
    places = {foot_point - std::sqrt(square) * along, foot_point + std::sqrt(square) * along};
  } else if (!(-square > 2 * kUnclear * scale.tolerance * torus.minor)) {
    return std::nullopt;
  }
  for (const Vec2& place : places) {
    if (std::abs(place.x) <= 1e-6 * scale.size) return std::nullopt;  // at a tip
    if (place.x > 0) result.conics.push_back(parallel(torus, place));
  }
  return result;
}

}  // namespace

std::optional<PlaneIntersection> coaxial_section(const TorusForm& torus, const CoaxialMeridian& meridian,
                                                 const SectionScale& scale) {
  const Vec2 center(torus.major, 0);
  if (meridian.is_line) {
    const Vec2 n = meridian.center_or_normal;
    const double height = meridian.radius_or_height - glm::dot(n, center);
    return parallels(torus, center + height * n, {-n.y, n.x}, (torus.minor - height) * (torus.minor + height), scale);
  }
  // Two circles: the foot point of their common chord on the line of centers.
  const Vec2 apart = meridian.center_or_normal - center;
  const double d = glm::length(apart), r = meridian.radius_or_height;
  if (d <= 1e-3 * std::min(torus.minor, r)) {
    // Nearly one center: apart by the difference of the radii, if that is clear.
    if (std::abs(torus.minor - r) > d + kUnclear * scale.tolerance) return PlaneIntersection{};
    return std::nullopt;
  }
  const double height = 0.5 * (d + (torus.minor - r) * (torus.minor + r) / d);
  const Vec2 n = apart / d;
  return parallels(torus, center + height * n, {-n.y, n.x}, (torus.minor - height) * (torus.minor + height), scale);
}

std::optional<PlaneIntersection> plane_section(const TorusForm& torus, const PlaneEquation& plane,
                                               const SectionScale& scale) {
  const double cosine = glm::dot(plane.normal, torus.axis),
               height = plane.height - glm::dot(plane.normal, torus.center);
  const Vec3 across = glm::cross(torus.axis, plane.normal);
  const double sine = glm::length(across);
  if (sine <= kRounding) return coaxial_section(torus, {true, {0, 1}, cosine > 0 ? height : -height}, scale);
  // The others go through the center of a ring.
  if (std::abs(height) > kRounding * scale.size || !(torus.major > torus.minor)) return std::nullopt;
  const Vec3 node = across / sine, steepest = glm::cross(plane.normal, node);
  PlaneIntersection result;
  if (std::abs(cosine) <= kRounding) {
    for (const double side : {1.0, -1.0})
      result.conics.push_back(
          circle(torus.center + side * torus.major * node, torus.minor * side * node, torus.minor * torus.axis));
    return result;
  }
  // Villarceau: sine = r/R.
  if (std::abs(sine - torus.minor / torus.major) > kRounding) return std::nullopt;
  for (const double side : {1.0, -1.0}) {
    result.conics.push_back(
        circle(torus.center + side * torus.minor * node, torus.major * node, torus.major * steepest));
    const double reach = std::sqrt((torus.major - torus.minor) * (torus.major + torus.minor));
    result.crossings.push_back(torus.center + side * reach * steepest);
  }
  return result;
}

std::optional<PlaneIntersection> sphere_section(const TorusForm& torus, const Vec3& center, double radius,
                                                const SectionScale& scale) {
  const Vec3 off = center - torus.center;
  const double height = glm::dot(off, torus.axis);
  const Vec3 out = off - height * torus.axis;
  const double rho = glm::length(out), near = kRounding * scale.size;
  if (rho <= near) return coaxial_section(torus, {false, {0, height}, radius}, scale);
  if (std::abs(height) > near || std::abs(rho - torus.major) > near || std::abs(radius - torus.minor) > near ||
      !(torus.major > torus.minor))
    return std::nullopt;
  PlaneIntersection result;
  result.touching = true;
  result.conics = {circle(center, torus.minor / rho * out, torus.minor * torus.axis)};
  return result;
}

}  // namespace lekalo::geometry
