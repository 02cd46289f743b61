// Helix about an axis (Golovanov 2016, 2.2.3), over its angle t in radians, 0 <= t <= 2 pi turns:
//
//   r(t) = o + R(s) (x cos(t0 + t) + y sin(t0 + t)) + z h(t),   h' = p(s) / (2 pi),   s = t / (2 pi turns)
//
// Left-handed with t0 - t for t0 + t. With a constant radius R and c = p / (2 pi) the curvature is R / (R^2 + c^2) and
// the torsion c / (R^2 + c^2). A radius that is a linear law of s winds on a cone. The rise by a pitch that changes,
// h = turns s int_0^1 p(s w) dw, is integrated by Gauss's rule, exact up to degree 2 n - 1 for n nodes.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/numerics/quadrature.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

constexpr int kGaussPoints = 24;
const GaussRule& rule() {
  static const GaussRule all = gauss_legendre(kGaussPoints);
  return all;
}
double node(int k) { return 0.5 * (1 + rule().nodes[k]); }
double weight(int k) { return 0.5 * rule().weights[k]; }

struct Rise {
  double turns = 1;
  Expression pitch;  // of s
  bool is_even = true;
};

bool is_constant(const Expression& law) { return law(Jet<Interval, 1>::variable(Interval(0, 1))).c[1] == Interval(0); }
double mean(const Expression& law) {
  double sum = 0;
  for (int k = 0; k < kGaussPoints; ++k) sum += weight(k) * law(node(k));
  return is_constant(law) ? law(0.5) : sum;
}

// Two of pitch, turns and height give the third.
Rise rise_of(const Fields& f) {
  const bool pitch = f.has("pitch"), turns = f.has("turns"), height = f.has("height");
  if (pitch + turns + height != 2)
    throw FieldError(height ? "height" : "pitch", "a helix is given by two of pitch, turns and height",
                     "write for instance pitch: 1, turns: 3");
  if (!pitch) {
    const double even = f.number("height") / f.number("turns");
    return {f.number("turns"), formula_of("even", {"s"}, std::array{Expression::Constant{"even", even}})};
  }
  const Expression& law = f.get<Expression>("pitch");
  if (!height) return {f.number("turns"), law, is_constant(law)};
  const double count = f.number("height") / mean(law);
  if (!(count > 0 && count < kInfinity))
    throw FieldError("height", "pitch and height are zero or have different signs",
                     "a left-handed helix that rises is written hand: left");
  return {count, law, is_constant(law)};
}

// The rise as a formula of t: c t with an even pitch, else c t sum w_k p(s x_k).
Expression rise_along(const Rise& rise, double last) {
  const auto of_t = [](const std::string& text, double number) {
    return formula_of(text, {"t"}, std::array{Expression::Constant{"c", number}});
  };
  if (rise.is_even) return of_t("c*t", rise.pitch(0.5) / kTwoPi);
  std::vector<std::string> names{"t"};
  std::vector<Expression> meanings{of_t("t", 0)};
  std::vector<Expression::Constant> constants{{"c", 1 / kTwoPi}};
  std::string sum;
  for (int k = 0; k < kGaussPoints; ++k) {
    names.push_back(fmt::format("p_{}", k));
    constants.push_back({fmt::format("w_{}", k), weight(k)});
    sum += fmt::format("{}w_{}*p_{}", k == 0 ? "" : " + ", k, k);
    const std::vector<Expression> s{of_t("t*c", node(k) / last)};
    meanings.push_back(rise.pitch.of(s));
  }
  return formula_of("c*t*(" + sum + ")", names, constants).of(meanings);
}

Affine placed_at(const Axis& axis) {
  const Frame frame = frame_about(axis.through, axis.along);
  return {Mat3(frame.x, frame.y, frame.z), frame.origin};
}

FormulaCurve helix_about_z(const Expression& radius, const Rise& rise, double start, bool is_left) {
  const double last = kTwoPi * rise.turns;
  const std::vector<Expression::Constant> constants{{"start", start}, {"last", last}, {"sense", is_left ? -1.0 : 1.0}};
  const auto of_t = [&](const char* text) { return formula_of(text, {"t"}, constants); };
  const std::vector<Expression> s{of_t("t/last")};
  return FormulaCurve(
      PointFormulas({radius.of(s), of_t("start + sense*t"), rise_along(rise, last)}, Coordinates::cylindrical, {"t"}),
      {0, last});
}

}  // namespace

TypeDeclaration helix_type() {
  return declare(
             Category::curve, "helix",
             "Helix about an axis, cylindrical or with a radius that changes; its parameter is the angle in radians.")
      .field("axis", axis(), "the axis, from the plane where the helix begins", "z")
      .field("radius", formula({"s"}),
             "distance from the axis: a number, or a formula of s from 0 to 1 along the turns")
      .optional("pitch", formula({"s"}),
                "rise along the axis in one turn, against it where negative: a number, or a formula of s from 0 to 1")
      .optional("turns", number().positive(), "how many turns")
      .optional("height", length(), "rise in all turns")
      .field("start", angle(), "angle about the axis where it begins, from the x direction of the axis's frame", "0")
      .field("hand", choice({"right", "left"}),
             "how it turns as it goes along its parameter with a rise along the axis", "right")
      .example("radius: 1, pitch: 0.5, turns: 4")
      .built_by([](const Fields& f) -> std::any {
        const Expression& radius = f.get<Expression>("radius");
        const Rise rise = rise_of(f);
        if (radius(0.0) <= 0 && radius(0.5) <= 0 && radius(1.0) <= 0)
          throw FieldError("radius", "the radius is not positive");
        try {
          const FormulaCurve curve = helix_about_z(radius, rise, f.number("start"), f.text("hand") == "left");
          return std::any(transformed(std::make_shared<FormulaCurve>(curve), placed_at(f.axis("axis"))));
        } catch (const FieldError& error) {
          if (error.field != "domain") throw;
          throw FieldError("radius", "the radius or the pitch has no finite value somewhere between s = 0 and s = 1",
                           "s goes from 0 at the beginning to 1 at the end, all turns together");
        }
      });
}

}  // namespace lekalo::geometry
