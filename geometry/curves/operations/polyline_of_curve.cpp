// Polylines within a tolerance of a curve (Zavyalov et al. 1985, I.4).
//
// A chord of step h is off by at most h^2 / 8 max |r''| across it. Vertices moved off the curve by
//   -h^2 / 16 r'',  h the longer of the steps beside them                                                      (31)
// share that error between both sides: half of it is left, and steps are longer by sqrt 2 for the same tolerance.
#include "geometry/curves/operations/polyline_of_curve.h"

#include <algorithm>

#include "geometry/curves/operations/hermite_span.h"

namespace lekalo::geometry {

namespace {

// Of steps that are too long at first, each.
constexpr int kMaxHalvings = 30;

NurbsCurve polyline_at(std::vector<double> knots, std::span<const Vec3> vertices) {
  knots.insert(knots.begin(), knots.front());
  knots.push_back(knots.back());
  return NurbsCurve(SplineAxis(1, std::move(knots), Extension::tangent), vertices);
}

using Steps = std::vector<double> (*)(const Interval&, const std::function<bool(const Interval&)>&);

std::vector<double> knots_within(const Curve& curve, double tolerance, Steps steps) {
  std::vector<double> knots;
  const std::vector<double> at = corners(curve);
  for (size_t k = 1; k < at.size(); ++k) {
    if (k > 1) knots.pop_back();
    const auto part =
        steps({at[k - 1], at[k]}, [&](const Interval& t) { return chord_is_within(curve, t, tolerance); });
    knots.insert(knots.end(), part.begin(), part.end());
  }
  return knots;
}

std::vector<Vec3> balanced_vertices(const Curve& curve, const std::vector<double>& knots) {
  std::vector<Vec3> vertices;
  const size_t last = knots.size() - 1;
  for (size_t i = 0; i <= last; ++i) {
    const double before = i > 0 ? knots[i] - knots[i - 1] : 0, after = i < last ? knots[i + 1] - knots[i] : 0;
    const double h = std::max(before, after);
    const CurveJet at = curve.evaluate(knots[i], 2);
    vertices.push_back(at.d[0] - h * h / 16 * at.d[2]);
  }
  return vertices;
}

// The spans whose straight line is not within the tolerance.
std::vector<size_t> too_far(const Curve& curve, const std::vector<double>& knots, const std::vector<Vec3>& vertices,
                            double tolerance) {
  std::vector<size_t> spans;
  for (size_t i = 0; i + 1 < knots.size(); ++i)
    if (!is_within(curve, straight_span({knots[i], knots[i + 1]}, vertices[i], vertices[i + 1]), tolerance))
      spans.push_back(i);
  return spans;
}

// Chords of twice the tolerance, less where the second derivative changes within a step. Where it changes by much, some
// steps are halved instead of making all shorter.
NurbsCurve balanced_polyline(const Curve& curve, double tolerance, Steps steps) {
  std::vector<double> knots;
  std::vector<Vec3> vertices;
  const auto far_spans = [&] {
    vertices = balanced_vertices(curve, knots);
    return too_far(curve, knots, vertices, tolerance);
  };
  for (double share = 2; share > 1; share *= 0.9) {
    knots = knots_within(curve, share * tolerance, steps);
    if (far_spans().empty()) return polyline_at(knots, vertices);
  }
  for (int halvings = 0; halvings < kMaxHalvings; ++halvings) {
    const std::vector<size_t> far = far_spans();
    if (far.empty()) return polyline_at(knots, vertices);
    for (const size_t i : far) knots.push_back(0.5 * (knots[i] + knots[i + 1]));
    std::sort(knots.begin(), knots.end());
  }
  throw FieldError("tolerance", "no balanced polyline was found within it", "balanced: false");
}

}  // namespace

NurbsCurve polyline_of_curve(const Curve& curve, double tolerance, const PolylineOptions& options) {
  const Steps steps = options.even ? equal_steps : longest_steps;
  if (!options.balanced) {
    const std::vector<double> knots = knots_within(curve, tolerance, steps);
    std::vector<Vec3> vertices;
    for (const double t : knots) vertices.push_back(curve.point(t));
    return polyline_at(knots, vertices);
  }
  return balanced_polyline(curve, tolerance, steps);
}

TypeDeclaration polyline_of_curve_type() {
  return declare(Category::curve, "polyline_of_curve",
                 "Polyline that is nowhere farther from a curve than a tolerance, with the curve's parameter.")
      .example("of: { type: circle, radius: 1 }, tolerance: 0.05")
      .field("of", reference({Category::curve}), "the curve")
      .field("tolerance", length().positive(), "largest distance between the two")
      .field("balanced", boolean(),
             "vertices beside the curve, so that it lies on both sides of the polyline: half the error for the same "
             "number of sides, at the same parameters",
             "false")
      .field("steps", choice({"longest", "equal"}),
             "as long as the tolerance allows one after the other, or equal in the curve's parameter between corners",
             "longest")
      .shows({"control_polygon", "knots"})
      .built_by([](const Fields& f) {
        return polyline_of_curve(*f.curve("of"), f.number("tolerance"),
                                 {f.boolean("balanced"), f.text("steps") == "equal"});
      });
}

}  // namespace lekalo::geometry
