// Arc of a conic by its end points and the meeting point of its end tangents (Golovanov 2016, 2.5.10):
//
//   r(t) = ((1-t)^2 p_0 + 2 t (1-t) w p_1 + t^2 p_2) / ((1-t)^2 + 2 t (1-t) w + t^2),   0 <= t <= 1
//
// |w| < 1 ellipse, w = 1 parabola, w > 1 hyperbola, -w the other arc of the same conic; w <= -1 goes through infinity.
// The shoulder r(1/2) = m + w/(1+w) (p_1 - m) lies on the median from p_1 to the middle m of the chord. Through a point
// r with the signed areas S = [p_0 p_1 p_2], S_1 = [p_0 p_1 r], S_2 = [r p_1 p_2]: w = (S - S_1 - S_2)/sqrt(4 S_1 S_2).
#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/conic_equation.h"
#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

namespace {

constexpr double kSameLength = 1e-9;

double weight_through(const std::vector<Vec3>& p, const Vec3& r) {
  const std::array<Vec3, 4> all{p[0], p[1], p[2], r};
  plane_of(all, "through");
  const Vec3 area = glm::cross(p[0] - p[1], p[2] - p[1]);
  const double s = glm::dot(area, area);
  const double u = glm::dot(area, glm::cross(r - p[1], p[2] - p[1])) / s,
               v = glm::dot(area, glm::cross(p[0] - p[1], r - p[1])) / s;
  const char* cure = "move the point between the lines of the tangents, on the side of the chord";
  if (!(u * v > 0)) throw FieldError("through", "no arc with these tangents passes through the point", cure);
  const double w = (1 - u - v) / std::sqrt(4 * u * v);
  if (u < 0) throw FieldError("through", "the point lies on the other branch of a hyperbola", cure);
  if (w <= -1) throw FieldError("through", "the arc through the point would pass through infinity", cure);
  return w;
}

double circular_weight(const std::vector<Vec3>& p) {
  const double a = glm::length(p[0] - p[1]), b = glm::length(p[2] - p[1]);
  if (!(std::abs(a - b) <= kSameLength * std::max(a, b)))
    throw FieldError("points",
                     fmt::format("the tangents of a circular arc are of one length, these are {:.6g} and {:.6g}", a, b),
                     "move the middle point, or give another weight");
  return 0.5 * glm::length(p[2] - p[0]) / a;  // cos (alpha/2) = sin of half the angle at p_1
}

double weight_of(const Fields& f, const std::vector<Vec3>& p) {
  if (f.has("weight") + f.has("rho") + f.has("through") != 1)
    throw FieldError(f.has("rho")       ? "rho"
                     : f.has("through") ? "through"
                                        : "weight",
                     "one of weight, rho and through says which of the conics it is", "write for instance weight: 0.5");
  if (f.has("through")) return weight_through(p, f.vec3("through"));
  if (f.has("rho")) return f.number("rho") / (1 - f.number("rho"));
  const std::string word = f.word("weight");
  if (word == "circular") return circular_weight(p);
  if (word == "quarter_ellipse") return std::sqrt(0.5);
  return f.number("weight");
}

NurbsCurve rational_quadratic(const Vec4& a, const Vec4& b, const Vec4& c) {
  return NurbsCurve(NurbsCurveForm{2, {0, 0, 0, 1, 1, 1}, {a, b, c}, {}});
}

NurbsCurve conic_arc(const Fields& f) {
  const std::vector<Vec3>& p = f.points("points");
  if (f.has("toward") != (p.size() == 2))
    throw FieldError(f.has("toward") ? "toward" : "points",
                     "an arc has three points, or two and the vector 'toward' for a middle one at infinity");
  if (p.size() == 2) {
    for (const char* field : {"weight", "rho", "through"})
      if (f.has(field)) throw FieldError(field, "with 'toward' the vector's length stands for the weight");
    const Vec3 chord = p[1] - p[0], toward = f.vec3("toward");
    if (!(glm::length(glm::cross(chord, toward)) > 1e-9 * glm::length(chord) * glm::length(toward)))
      throw FieldError("toward", "the vector is along the chord");
    return rational_quadratic(Vec4(p[0], 1), Vec4(toward, 0), Vec4(p[1], 1));
  }
  plane_of(p, "points");
  const double w = weight_of(f, p);
  return rational_quadratic(Vec4(p[0], 1), Vec4(w * p[1], w), Vec4(p[2], 1));
}

// About the normal from the first point to the second, by the angle of the arc.
Circle arc_between(const Vec3& a, const Vec3& b, double angle, const Vec3& normal) {
  const Vec3 chord = b - a, across = glm::cross(normal, chord);
  const Vec3 center = 0.5 * (a + b) + across / (2 * std::tan(0.5 * angle));
  return Circle(frame_from(center, normal, a - center), glm::length(chord) / (2 * std::sin(0.5 * angle)), {0, angle});
}

}  // namespace

TypeDeclaration conic_arc_type() {
  return declare(
             Category::curve, "conic_arc",
             "Arc of a conic by its ends and the point where its end tangents meet, as an exact rational quadratic; "
             "lekalo measure says which conic it is.")
      .field("points", points().count(2, 3),
             "start, where the tangents meet, end; without the middle one with `toward`")
      .optional("weight", number().above(-1).or_word({"circular", "quarter_ellipse"}),
                "of the middle point: below 1 an ellipse, 1 a parabola, above 1 a hyperbola, negative the other arc of "
                "the same ellipse; circular where both tangents are equally long; quarter_ellipse with its vertices at "
                "the ends where they are at right angles")
      .optional(
          "rho", number().above(0).below(1),
          "in place of weight: where the arc cuts the median from the chord (0) to the middle point (1); 1/2 is a "
          "parabola")
      .optional("through", point(), "in place of weight: a fourth point on the arc")
      .optional(
          "toward", vector(),
          "in place of a middle point: one at infinity, the arc is half an ellipse, the vector its other half axis")
      .shows({"control_polygon"})
      .example("points: [[0, 0], [2, 3], [5, 0]], weight: 0.7")
      .built_by([](const Fields& f) { return conic_arc(f); });
}

TypeDeclaration circular_arc_type() {
  return declare(Category::curve, "circular_arc", "Arc of a circle between two points, by its angle or radius.")
      .field("points", points().count(2, 2), "start and end")
      .optional("angle", angle().above(0).below(kTwoPi), "of the arc")
      .optional("radius", length().positive(), "in place of angle: of the circle; the arc is at most half of it")
      .field("normal", direction(), "the arc goes about it by the right-hand rule; across the chord", "z")
      .example("points: [[1, 0], [0, 1]], angle: 90")
      .built_by([](const Fields& f) {
        const std::vector<Vec3>& p = f.points("points");
        const double chord = glm::length(p[1] - p[0]);
        if (!(chord > 0)) throw FieldError("points", "the ends of an arc coincide", "a full circle is a circle");
        if (f.has("angle") == f.has("radius"))
          throw FieldError(f.has("angle") ? "radius" : "angle", "an arc is given by its angle or by its radius");
        if (std::abs(glm::dot(f.vec3("normal"), p[1] - p[0])) > 1e-9 * chord)
          throw FieldError("normal", "the normal is not at right angles to the chord",
                           "give the normal of a plane that contains both points");
        if (f.has("angle")) return arc_between(p[0], p[1], f.number("angle"), f.vec3("normal"));
        const double sine = chord / (2 * f.number("radius"));
        if (sine > 1 + 1e-12)
          throw FieldError("radius", fmt::format("the ends are {:.6g} apart, farther than the diameter", chord));
        return arc_between(p[0], p[1], 2 * std::asin(std::min(sine, 1.0)), f.vec3("normal"));
      });
}

}  // namespace lekalo::geometry
