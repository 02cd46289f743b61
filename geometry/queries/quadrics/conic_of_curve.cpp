#include "geometry/queries/quadrics/conic_of_curve.h"

#include <cmath>

#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/analytic/hyperbola.h"

namespace lekalo::geometry {

namespace {

constexpr double kSameConic = 1e-9, kSameDirection = 1e-12;

// The distance of a point from the conic, to the first order.
double distance(const ConicEquation& conic, const Vec3& point) {
  const Vec3 local = conic.plane.to_local_point(point), p(local.x, local.y, 1), gradient = 2.0 * (conic.q * p);
  return std::hypot(glm::dot(p, conic.q * p) / std::hypot(gradient.x, gradient.y), local.z);
}

// Both ends of an axis are alike: x is that on the side of the global x, or y, or z.
Frame turned(const Frame& frame) {
  for (int k = 0; k < 3; ++k)
    if (std::abs(frame.x[k]) > kSameDirection)
      return frame.x[k] > 0 ? frame : Frame{frame.origin, -frame.x, -frame.y, frame.z};
  return frame;
}

// Of curves that are conics by their type: an equation does not tell very long ones from a parabola.
std::optional<CanonicalConic> known_conic(const Curve& curve) {
  using Kind = CanonicalConic::Kind;
  if (const auto* hyperbola = dynamic_cast<const Hyperbola*>(&curve))
    return CanonicalConic{Kind::hyperbola, turned(hyperbola->frame()), hyperbola->semi_axis_x(),
                          hyperbola->semi_axis_y()};
  const auto* ellipse = dynamic_cast<const Ellipse*>(&curve);
  if (!ellipse || ellipse->semi_axis_x() == ellipse->semi_axis_y()) return std::nullopt;
  const Frame& frame = ellipse->frame();
  const double a = ellipse->semi_axis_x(), b = ellipse->semi_axis_y();
  if (a > b) return CanonicalConic{Kind::ellipse, turned(frame), a, b};
  return CanonicalConic{Kind::ellipse, turned({frame.origin, frame.y, -frame.x, frame.z}), b, a};
}

}  // namespace

std::optional<CanonicalConic> conic_of(const Curve& curve) {
  if (const auto known = known_conic(curve)) return known;
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
