// The closed outline about an open plane curve at half a thickness to both sides, for sections of open curves
// (coursework 2024, 2): the offset to the right, the end, the offset to the left backward, the beginning;
// counterclockwise as seen against the normal. Where the radius of curvature is more than half the thickness its area
// is thickness times length, with round ends pi d^2/4 more.
#include <fmt/format.h>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/derived/composite_curve.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/describe.h"
#include "geometry/expression/expression.h"
#include "geometry/point_formulas.h"

namespace lekalo::geometry {

TypeDeclaration offset_curve_type();

namespace {

CurvePtr offset(const Fields& f, double distance) {
  static const TypeDeclaration type = offset_curve_type();
  const std::vector<Expression::Constant> constants{{"d", distance}};
  Fields fields;
  fields.set("of", f.curve("of"));
  fields.set("distance", formula_of("d", {"t"}, constants));
  fields.set("normal", f.vec3("normal"));
  fields.set("loops", f.text("loops"));
  return std::any_cast<CurvePtr>(type.build(fields));
}

// From one point to the other, straight or by a half circle whose middle lies along the direction.
CurvePtr cap(const Vec3& from, const Vec3& to, const Vec3& direction, bool round) {
  if (!round) return std::make_shared<Segment>(from, to);
  const Vec3 middle = 0.5 * (from + to);
  const double radius = 0.5 * glm::length(to - from);
  return std::make_shared<Circle>(arc_through(from, middle + radius * glm::normalize(direction), to));
}

std::any thickened_curve(const Fields& f) {
  const CurvePtr curve = f.curve("of");
  if (curve->is_closed())
    throw FieldError("of", "the curve is closed: its outlines are two", "offset_curve makes each");
  const double half = 0.5 * f.number("thickness");
  const CurvePtr right = offset(f, -half), left = reversed_curve(offset(f, half));
  const bool round = f.text("ends") == "round";
  const Interval domain = curve->domain();
  const auto end_of = [](const CurvePtr& one) { return one->point(one->domain().hi); };
  const auto begin_of = [](const CurvePtr& one) { return one->point(one->domain().lo); };
  const Vec3 ahead = curve->evaluate(domain.hi, 1).d[1], back = -curve->evaluate(domain.lo, 1).d[1];
  try {
    return std::any(CurvePtr(
        std::make_shared<CompositeCurve>(std::vector<CurvePtr>{right, cap(end_of(right), begin_of(left), ahead, round),
                                                               left, cap(end_of(left), begin_of(right), back, round)},
                                         true, 1e-9)));
  } catch (const FieldError&) {
    throw FieldError("of", "the offsets of the curve fall apart at a corner", "round its corners");
  }
}

}  // namespace

TypeDeclaration thickened_curve_type() {
  return declare(Category::curve, "thickened_curve",
                 "Closed outline about an open plane curve, half the thickness to each side: a section of sheet.")
      .example("of: { type: bezier_curve, points: [[0, 0], [1, 2], [3, 1], [4, 2]] }, thickness: 0.2")
      .field("of", reference({Category::curve}), "the curve; open, smooth, in a plane")
      .field("thickness", length().positive(), "from side to side")
      .field("ends", choice({"flat", "round"}), "straight across, or half circles", "flat")
      .field("normal", direction(), "of the plane, towards the viewer", "z")
      .field("loops", choice({"keep", "cut"}),
             "of the sides, where the radius of curvature is less than their distance", "keep")
      .built_by(thickened_curve);
}

}  // namespace lekalo::geometry
