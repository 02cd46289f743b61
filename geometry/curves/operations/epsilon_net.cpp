// Epsilon nets of curves (Zavyalov, Leus, Skorospelov 1985, II.2, III.2): points such that each point of the curve has
// one within epsilon. A net is localised if its own points are as near to the curve; this one's lie on it. Hausdorff's
// distance of curve and net is then at most epsilon.
//
// Points at most 2 epsilon apart along the curve are such a net: a point between two of them is within epsilon of one
// along the curve, and straight on.
#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/operations/arc_fraction.h"

namespace lekalo::geometry {

namespace {

constexpr int kMaxPoints = 1000000;
constexpr double kRounding = 1e-12;

NurbsCurve net_of(const Curve& curve, double epsilon) {
  const bool closed = curve.is_closed();
  const ArcFraction lengths(curve);
  // A length that is a multiple of 2 epsilon but for rounding is one.
  const double parts = std::max(closed ? 3.0 : 1.0, std::ceil(lengths.length() / (2 * epsilon) * (1 - kRounding)));
  if (parts > kMaxPoints)
    throw FieldError("epsilon", fmt::format("a curve of length {:.6g} needs {:.3g} points", lengths.length(), parts),
                     fmt::format("at most {} are made", kMaxPoints));
  std::vector<Vec3> points;
  for (const double t : parameters_at_even_lengths(lengths, curve.domain(), static_cast<int>(parts)))
    points.push_back(curve.point(t));
  if (closed) points.pop_back();
  return polyline(points, closed);
}

}  // namespace

TypeDeclaration epsilon_net_type() {
  return declare(Category::curve, "epsilon_net",
                 "Polyline whose corners are points of a curve, so many that each point of the curve is within epsilon "
                 "of one; evenly spaced in length. t counts them.")
      .example("of: { type: circle, radius: 1 }, epsilon: 0.2")
      .field("of", reference({Category::curve}), "the curve")
      .field("epsilon", length().positive(), "largest distance of a point of the curve from the net")
      .shows({"control_polygon"})
      .built_by([](const Fields& f) {
        const CurvePtr curve = f.curve("of");
        if (!(curve->domain().width() < kInfinity)) throw FieldError("of", "the curve is unbounded", "give it a range");
        return net_of(*curve, f.number("epsilon"));
      });
}

}  // namespace lekalo::geometry
