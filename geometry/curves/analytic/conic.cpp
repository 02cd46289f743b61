// Conics by points: through five, or members of a pencil (Golovanov 2016, 2.5.2, 2.5.3), brought to their axes.
#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/analytic/conic_equation.h"
#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/analytic/hyperbola.h"
#include "geometry/curves/analytic/parabola.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

std::array<Vec3, 4> first_four(const std::vector<Vec3>& p) { return {p[0], p[1], p[2], p[3]}; }

ConicEquation equation(const Fields& f) {
  const std::vector<Vec3>& p = f.points("points");
  const Frame plane = plane_of(p, "points");
  if (f.has("lambda") == (p.size() == 5))
    throw FieldError(p.size() == 5 ? "lambda" : "points",
                     p.size() == 5 ? "five points leave no choice" : "which conic of the pencil is not said",
                     p.size() == 5 ? "leave lambda out, or a point" : "give lambda, or five points");
  if (p.size() == 3) return touching_pencil_member(plane, {p[0], p[1], p[2]}, f.number("lambda"));
  const double lambda = p.size() == 4 ? f.number("lambda") : pencil_number(plane, first_four(p), p[4]);
  return pencil_member(plane, first_four(p), lambda);
}

Interval range_of(const Fields& f, const CanonicalConic& conic) {
  if (f.has("range")) return f.range("range");
  if (conic.kind == CanonicalConic::Kind::ellipse) return {0, kTwoPi};
  throw FieldError("points", fmt::format("the conic is a {}, which has no end", name(conic.kind)),
                   "give a range of its parameter, for instance range: [-1, 1]");
}

CurvePtr conic(const Fields& f) {
  const auto found = canonical(equation(f));
  if (!found)
    throw FieldError("points", "the conic falls apart into lines or has no points",
                     "move a point off the line of two others, or change lambda");
  const Interval range = range_of(f, *found);
  Frame frame = found->frame;
  if (found->kind == CanonicalConic::Kind::parabola) return std::make_shared<Parabola>(frame, found->a, range);
  if (found->kind == CanonicalConic::Kind::ellipse) {
    if (range.width() > kTwoPi * (1 + 1e-12)) throw FieldError("range", "the arc is longer than one turn");
    return std::make_shared<Ellipse>(frame, found->a, found->b, range);
  }
  if (f.integer("branch") == 2) frame.x = -frame.x, frame.y = -frame.y;
  return std::make_shared<Hyperbola>(frame, found->a, found->b, range);
}

}  // namespace

TypeDeclaration conic_type() {
  return declare(Category::curve, "conic",
                 "Conic through five points, or one of a pencil; lekalo measure says which, with its center and axes.")
      .field(
          "points", points().count(3, 5),
          "five points of a plane; or four, A B C D, for one of the pencil through them; or three, A E C, for one of "
          "those that touch EA at A and EC at C")
      .optional("lambda", number(),
                "which of a pencil: (1 - lambda) l1 l2 + lambda l3 l4 = 0, with the lines AB, CD, AC, BD in their "
                "normal forms; of three points (1 - lambda) u v + lambda (u + v - 1)^2 = 0, u along EA and v along EC")
      .optional("range", range(),
                "of the parameter: (a cos t, b sin t), (a cosh t, b sinh t) or (f t^2, 2 f t) along its axes; a whole "
                "ellipse when left out")
      .field("branch", integer().between(1, 2), "of a hyperbola", "1")
      .example("points: [[1, 0], [0, 1], [-1, 0], [0, -1], [0.8, 0.6]]")
      .built_by([](const Fields& f) { return std::any(conic(f)); });
}

}  // namespace lekalo::geometry
