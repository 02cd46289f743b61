#include "geometry/queries/quadrics/conic_of_curve.h"

#include <cmath>

namespace lekalo::geometry {

namespace {

constexpr double kSameConic = 1e-9;

// The distance of a point from the conic, to the first order.
double distance(const ConicEquation& conic, const Vec3& point) {
  const Vec3 local = conic.plane.to_local_point(point), p(local.x, local.y, 1), gradient = 2.0 * (conic.q * p);
  return std::hypot(glm::dot(p, conic.q * p) / std::hypot(gradient.x, gradient.y), local.z);
}

}  // namespace

std::optional<CanonicalConic> conic_of(const Curve& curve) {
  const auto form = curve.as_nurbs();
  if (!form || form->degree != 2) return std::nullopt;
  const std::vector<CurvePiece> pieces = bezier_pieces(*form, form->domain());
  const auto equation = equation_of(pieces.front().points);
  if (!equation) return std::nullopt;
  const double size = bounds(curve).diameter();
  for (const CurvePiece& piece : pieces)
    for (const double share : {0.0, 0.3, 0.7, 1.0}) {
      const double t = piece.domain.lo + share * piece.domain.width();
      if (!(distance(*equation, curve.point(t)) <= kSameConic * size)) return std::nullopt;
    }
  return canonical(*equation);
}

}  // namespace lekalo::geometry
