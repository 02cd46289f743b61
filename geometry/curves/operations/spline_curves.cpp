// Curves as NURBS curves, and the same NURBS curve described otherwise: with a higher degree, with more knots, with a
// lower degree or fewer knots where that changes it little (Golovanov 2016, 2.6, 2.11, 2.13, 2.14).
#include "geometry/curves/operations/spline_curves.h"

#include <fmt/format.h>

#include <functional>
#include <stdexcept>

#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/operations/nurbs_of.h"
#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/curves/splines/nurbs_operations.h"
#include "geometry/curves/splines/periodic_curve.h"
#include "geometry/curves/splines/spline_reduction.h"
#include "geometry/describe.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Fits, and curves that lose degree or knots, are that near if nothing else is asked for; of the curve's size.
constexpr double kNear = 1e-9;

double tolerance_of(const Fields& f, const Curve& curve) {
  return f.has("tolerance") ? f.number("tolerance") : kNear * bounds(curve).diameter();
}

// The clamped exact form over the domain.
NurbsCurveForm exact_form(const CurvePtr& curve) {
  if (!curve->as_nurbs())
    throw FieldError("of", "this curve has no exact NURBS form",
                     "{ type: nurbs_of, of: .. } makes one that is as near as you like");
  try {
    return nurbs_of(*curve, curve->domain(), 0).form;
  } catch (const std::invalid_argument& error) {
    throw FieldError("of", error.what());
  }
}

// What an exact operation makes of a curve: a periodic spline stays one.
NurbsCurve changed(const CurvePtr& curve,
                   const std::function<NurbsCurveForm(const NurbsCurveForm&, int turns)>& operation) {
  const auto* spline = dynamic_cast<const NurbsCurve*>(curve.get());
  if (spline && is_whole_period(*spline))
    return in_every_period(*spline, [&](const NurbsCurveForm& three) { return operation(three, 1); });
  return NurbsCurve(operation(exact_form(curve), 0));
}

NurbsCurve refined(const Fields& f) {
  const CurvePtr& curve = f.curve("of");
  const bool bezier = f.boolean("bezier");
  if (bezier == f.has("at"))
    throw FieldError(bezier ? "at" : "", "a refined curve has either new knots 'at' or 'bezier'",
                     "at: [2.5]; bezier: true cuts it into Bezier pieces");
  if (bezier) return NurbsCurve(in_bezier_form(exact_form(curve)));
  return with_inserted_knots(curve, f.numbers("at"), f.integer("times"));
}

NurbsCurve elevated(const Fields& f) {
  return with_degree(f.curve("of"), f.has("degree") ? std::optional(f.integer("degree")) : std::nullopt);
}

std::vector<double> inner_knots_of(const NurbsCurveForm& form) {
  return {form.knots.begin() + form.degree + 1, form.knots.end() - form.degree - 1};
}

NurbsCurve reduced(const Fields& f) {
  const CurvePtr& curve = f.curve("of");
  const NurbsCurveForm form = exact_form(curve);
  const double tolerance = tolerance_of(f, *curve);
  if (f.has("degree") && f.has("remove"))
    throw FieldError("remove", "a reduced curve loses degree or knots, not both at once", "one after the other");
  ReducedCurve result;
  if (f.has("degree")) {
    const int degree = f.integer("degree");
    if (degree > form.degree)
      throw FieldError("degree", fmt::format("the curve has the degree {}", form.degree),
                       "elevated_curve makes it higher");
    result = reduced_degree(form, degree);
  } else if (f.has("remove")) {
    try {
      result = without_knots(form, f.numbers("remove"));
    } catch (const std::invalid_argument& error) {
      throw FieldError("remove", error.what(),
                       inner_knots_of(form).empty()
                           ? "the curve has none"
                           : fmt::format("the knots inside are {}", fmt::join(inner_knots_of(form), ", ")));
    }
  } else {
    result = with_fewest_knots(form, tolerance);
  }
  if (!(result.bound < kInfinity))
    throw FieldError("of", "how far it is from a curve with weights that are not positive cannot be told",
                     "positive weights");
  if (!(result.bound <= tolerance))
    throw FieldError(f.has("degree") ? "degree" : "remove",
                     fmt::format("the reduced curve may be {:.2g} away from the curve, the tolerance is {:.2g}",
                                 result.bound, tolerance),
                     fmt::format("tolerance: {:.2g} allows it", 1.05 * result.bound));
  return NurbsCurve(result.form);
}

NurbsCurve as_nurbs(const Fields& f) {
  const CurvePtr& curve = f.curve("of");
  const Interval whole = curve->domain(), part = f.has("domain") ? f.range("domain") : whole;
  if (part.lo < whole.lo || part.hi > whole.hi)
    throw FieldError("domain", "it is not inside the curve's domain",
                     fmt::format("t goes from {} to {}", whole.lo, whole.hi));
  const auto* spline = dynamic_cast<const NurbsCurve*>(curve.get());
  if (f.boolean("closed") && part == whole && spline && is_whole_period(*spline)) return *spline;
  try {
    const NurbsOfCurve found = nurbs_of(*curve, part, tolerance_of(f, CurvePart(curve, part)));
    if (!f.boolean("closed")) return NurbsCurve(found.form);
    try {
      return periodic_curve(found.form);
    } catch (const std::invalid_argument& error) {
      throw FieldError("closed", error.what(), "leave 'closed' out");
    }
  } catch (const std::invalid_argument& error) {
    if (dynamic_cast<const FieldError*>(&error)) throw;
    throw FieldError("of", error.what(), "another 'domain', or a larger 'tolerance'");
  }
}

TypeDeclaration operation(const char* name, const char* description) {
  return declare(Category::curve, name, description)
      .example("of: { type: bezier_curve, points: [[0, 0], [1, 2], [3, 2], [4, 0]] }")
      .field("of", reference({Category::curve}),
             "a curve with an exact NURBS form; of circles and other conics the parameter "
             "becomes the rational one");
}

}  // namespace

NurbsCurve with_inserted_knots(const CurvePtr& curve, std::span<const double> at, int times) {
  const Interval domain = curve->domain();
  for (const double t : at)
    if (!(t > domain.lo && t < domain.hi))
      throw FieldError("at", fmt::format("t = {} is not inside the curve's domain", t),
                       fmt::format("t goes from {} to {}", domain.lo, domain.hi));
  return changed(curve, [&](NurbsCurveForm form, int turns) {
    for (int turn = -turns; turn <= turns; ++turn)
      for (const double t : at) try {
          form = insert_knot(form, t + turn * curve->period(), times);
        } catch (const std::invalid_argument& error) {
          throw FieldError("at", fmt::format("t = {}: {}", t, error.what()),
                           fmt::format("a knot of degree {} stands at most {} times", form.degree, form.degree));
        }
    return form;
  });
}

NurbsCurve with_degree(const CurvePtr& curve, std::optional<int> wanted) {
  return changed(curve, [&](const NurbsCurveForm& form, int) {
    const int degree = wanted.value_or(form.degree + 1);
    if (degree < form.degree)
      throw FieldError("degree", fmt::format("the curve has the degree {}", form.degree),
                       "reduced_curve makes it lower");
    if (degree > kMaxDegree) throw FieldError("degree", fmt::format("the degree would exceed {}", kMaxDegree));
    return elevate_degree(form, degree - form.degree);
  });
}

TypeDeclaration nurbs_of_type() {
  return declare(
             Category::curve, "nurbs_of",
             "A curve as a NURBS curve: exactly where it has such a form, else fitted. The parameter is the curve's "
             "own, but of circles, ellipses and hyperbolas, whose points are those of a rational parameter.")
      .example("of: { type: circle, radius: 1 }")
      .field("of", reference({Category::curve}), "any curve that is bounded")
      .optional("domain", range(), "a part of it, in its own parameter")
      .optional("tolerance", length().positive(),
                "a fit is nowhere seen farther from the curve; a billionth of its size when left out")
      .field("closed", boolean(), "of a closed curve the form without ends: a circle of 8 points", "false")
      .shows({"control_polygon", "knots", "de_boor"})
      .built_by(as_nurbs);
}

TypeDeclaration elevated_curve_type() {
  TypeDeclaration type = operation("elevated_curve", "The same NURBS curve with a higher degree.");
  return type.optional("degree", integer().between(1, kMaxDegree), "the new degree; one more when left out")
      .shows({"control_polygon", "knots", "de_boor"})
      .built_by(elevated);
}

TypeDeclaration refined_curve_type() {
  TypeDeclaration type = operation("refined_curve", "The same NURBS curve with more knots and control points.");
  return type.example("of: { type: bezier_curve, points: [[0, 0], [1, 2], [3, 2], [4, 0]] }, at: [0.5]")
      .optional("at", numbers().count(1), "parameters of the new knots; one that stands twice is put in twice")
      .field("times", integer().between(1, kMaxDegree), "how often each of them is put in", "1")
      .field("bezier", boolean(), "cut it into Bezier pieces: every knot stands degree times", "false")
      .shows({"control_polygon", "knots", "de_boor"})
      .built_by(refined);
}

TypeDeclaration reduced_curve_type() {
  TypeDeclaration type =
      operation("reduced_curve", "A NURBS curve of lower degree or with fewer knots that is near to a curve; open.");
  return type.optional("degree", integer().between(1, kMaxDegree), "the new degree")
      .optional("remove", numbers().count(1), "inner knots to take out; without it and 'degree' all that can be")
      .optional("tolerance", length().positive(),
                "no point is farther from the curve's at the same parameter, for certain; a billionth of its size when "
                "left out")
      .shows({"control_polygon", "knots", "de_boor"})
      .built_by(reduced);
}

}  // namespace lekalo::geometry
