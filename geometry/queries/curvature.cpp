#include "geometry/queries/curvature.h"

#include <cmath>

namespace lekalo::geometry {

CurveCurvature curvature(const CurveJet& jet) {
  CurveCurvature c;
  const Vec3 &r1 = jet.d[1], &r2 = jet.d[2], &r3 = jet.d[3];
  const double speed = glm::length(r1);
  if (!(speed > 0)) return c;
  c.has_tangent = true;
  c.tangent = r1 / speed;
  const Vec3 b = glm::cross(r1, r2);
  const double area = glm::length(b);
  c.curvature = area / (speed * speed * speed);
  // Parallel within rounding: a straightening point.
  if (!(area > 1e-14 * speed * glm::length(r2))) return c;
  c.has_normal = true;
  c.binormal = b / area;
  c.normal = glm::cross(c.binormal, c.tangent);
  c.torsion = glm::dot(b, r3) / (area * area);
  return c;
}

SurfaceCurvature curvature(const SurfaceJet& jet, const Vec3& m) {
  SurfaceCurvature c;
  const Vec3 &a = jet.du(), &b = jet.dv();
  const double area = glm::length(glm::cross(a, b));
  if (!(area > 1e-14 * glm::length(a) * glm::length(b)) || !(area > 0)) return c;
  c.regular = true;
  // Shape operator in an orthonormal frame of the tangent plane: symmetric, one Jacobi rotation, no cancellation of
  // H +- sqrt(H^2 - K).
  const Vec3 e1 = glm::normalize(a), e2 = glm::cross(m, e1);
  const double j11 = glm::dot(a, e1), j12 = glm::dot(b, e1), j22 = glm::dot(b, e2);
  const double b11 = glm::dot(jet.duu(), m), b12 = glm::dot(jet.duv(), m), b22 = glm::dot(jet.dvv(), m);
  // S = J^-T B J^-1 with J upper triangular.
  const double s11 = b11 / (j11 * j11);
  const double s12 = (b12 - j12 * b11 / j11) / (j11 * j22);
  const double s22 = (b22 - 2 * b12 * j12 / j11 + b11 * (j12 / j11) * (j12 / j11)) / (j22 * j22);
  c.mean = 0.5 * (s11 + s22);
  c.gaussian = s11 * s22 - s12 * s12;
  const double angle = 0.5 * std::atan2(2 * s12, s11 - s22);
  const double half = std::hypot(0.5 * (s11 - s22), s12);
  c.principal[0] = c.mean + half;
  c.principal[1] = c.mean - half;
  c.directions[0] = std::cos(angle) * e1 + std::sin(angle) * e2;
  c.directions[1] = -std::sin(angle) * e1 + std::cos(angle) * e2;
  return c;
}

}  // namespace lekalo::geometry
