// Plane curve F(x, y) = level inside a rectangle (Grezdov, Filippenko 2010): all its branches, by the certified search
// of queries/implicit_curves, as piecewise polynomials whose nodes lie on it. At a point where branches cross (grad F =
// 0) they end and others begin.
#include <fmt/format.h>

#include "geometry/curves/on_surfaces/branch_choice.h"
#include "geometry/point_formulas.h"
#include "geometry/queries/implicit_curves/implicit_arcs.h"

namespace lekalo::geometry {

namespace {

// F(x, y) + z^2: on the plane z = 0 the same, with second derivatives in space that can be inverted, by which the
// search finds the singular points.
ImplicitFormula in_space(const Expression& formula, double level) {
  const std::vector<std::string> xyz{"x", "y", "z"};
  const std::vector<Expression> plane{formula_of("x", xyz), formula_of("y", xyz)};
  const std::vector<Expression> parts{formula.of(plane), formula_of("z", xyz)};
  return {formula_of("f + h^2", {"f", "h"}).of(parts), level};
}

std::vector<Contour> branches_of(const Fields& f) {
  const Fields& box = f.group("box");
  const Vec3 lo = box.vec3("min"), hi = box.vec3("max");
  if (!(lo.x < hi.x && lo.y < hi.y))
    throw FieldError("box", "the box is empty", "the coordinates of max are larger than those of min");
  const double thickness = 1e-3 * glm::length(hi - lo);
  const ImplicitFormula formula = in_space(f.get<Expression>("formula"), f.number("level"));
  const ImplicitRegion region{{{lo.x, lo.y, -thickness}, {hi.x, hi.y, thickness}}, false};
  const ImplicitArcs found = implicit_arcs(formula, region, Frame(), {lo.x, hi.x}, {lo.y, hi.y});
  if (!found.complete)
    throw FieldError("formula", "not all is known of this curve: it nearly touches itself, or has no smooth formula",
                     "take a smaller box, or one that is a little larger than the curve");
  if (found.arcs.empty())
    throw FieldError("formula", "the curve has no points in the box but single ones, if any",
                     "take a larger box, or another level");
  std::vector<Contour> branches;
  for (const ImplicitArc& arc : found.arcs) {
    Contour& branch = branches.emplace_back();
    branch.curve = arc.curve;
    branch.closed = arc.closed;
  }
  return branches;
}

}  // namespace

TypeDeclaration implicit_curve_type() {
  TypeDeclaration type =
      declare(Category::curve, "implicit_curve",
              "Plane curve F(x, y) = level inside a box; where it crosses itself one branch ends and "
              "others begin. Its parameter is about the length.");
  type.field("formula", formula({"x", "y"}), "F, a formula of x and y")
      .field("level", number(), "value of F on the curve", "0")
      .field("box",
             group({{"min", point(), "lower left corner", true, {}}, {"max", point(), "upper right corner", true, {}}}),
             "what lies outside is cut off")
      .example("formula: x^4 + y^4 - 1, box: { min: [-2, -2], max: [2, 2] }");
  return choose_branch(type).built_by(
      [](const Fields& f) { return std::any(chosen_branch(branches_of(f), f, "formula")); });
}

}  // namespace lekalo::geometry
