#include "geometry/queries/differential/osculation.h"

#include <cmath>

namespace lekalo::geometry {

namespace {

// A torsion below this part of the curvature is that of a plane curve whose derivatives are rounded.
constexpr double kPlane = 1e-8;

// dk/ds = k'/|r'| of k = |c|/|r'|^3, c = r' x r'', c' = r' x r'''.
double growth_of_curvature(const CurveJet& jet) {
  const Vec3 &r1 = jet.d[1], &r2 = jet.d[2], &r3 = jet.d[3];
  const double speed = glm::length(r1);
  const Vec3 c = glm::cross(r1, r2);
  const double area = glm::length(c), cube = speed * speed * speed;
  const double growth = glm::dot(c, glm::cross(r1, r3)) / area;
  return (growth / cube - 3 * area * glm::dot(r1, r2) / (cube * speed * speed)) / speed;
}

}  // namespace

Osculation osculation(const CurveJet& jet, const CurveCurvature& frame) {
  Osculation result;
  if (frame.is_straight) result.darboux = Vec3(0);
  if (!frame.has_normal || !(frame.curvature > 0)) return result;
  result.darboux = frame.curvature * frame.binormal + frame.torsion * frame.tangent;
  const double radius = 1 / frame.curvature;
  if (!std::isfinite(radius)) return result;
  result.circle = Osculation::Round{jet.point() + radius * frame.normal, radius};
  const double growth = growth_of_curvature(jet);
  if (!(std::abs(frame.torsion) > kPlane * frame.curvature) || !std::isfinite(growth)) return result;
  const double along_binormal = -growth * radius * radius / frame.torsion;
  result.sphere =
      Osculation::Round{result.circle->center + along_binormal * frame.binormal, std::hypot(radius, along_binormal)};
  return result;
}

}  // namespace lekalo::geometry
