// The band of the parameter plane that a cutter covers along a line, with cusps of a given height beside it: the
// envelope of circles of the diameter d(t) about the line c(t) (Zavyalov, Leus, Skorospelov 1985, V.1, figure 45). With
// r = d/2, s = |c'|, T = c'/s and N to its left
//
//   g(t) = c - r r'/s T +- r sqrt(1 - (r'/s)^2) N
//
// d has no formula in t that could be differentiated: r is its approximation by polynomials.
#include <fmt/format.h>

#include <cmath>

#include "geometry/composition.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/splines/polynomial_approximation.h"
#include "geometry/describe.h"
#include "geometry/machining/tool_path.h"

namespace lekalo::geometry {

namespace {

constexpr double kTolerance = 1e-10;  // of r, of its size
constexpr int kPlaces = 256;

struct Envelope {
  CurvePtr image, radius;  // x of the second
  double side;

  template <class T>
  Triple<T> operator()(const T& t) const {
    using std::sqrt;
    const Triple<T> c = curve_at(*image, t), way = curve_at(*image, t, 1);
    const T r = curve_at(*radius, t).x, speed = length(way), sine = curve_at(*radius, t, 1).x / speed;
    const Triple<T> along = (T(1) / speed) * way, across{-along.y, along.x, T(0)};
    return c - (r * sine) * along + (T(side) * r * sqrt(T(1) - sine * sine)) * across;
  }
};

CurvePtr radius_of(const CoverageBand& band) {
  std::vector<Interval> stretches;
  for (const CurvePiece& piece : band.image->pieces()) stretches.push_back(piece.domain);
  const Interval domain = band.image->domain();
  const auto radius = [&](double t) { return Vec3(0.5 * band.diameter(t), 0, 0); };
  const double size = radius(domain.middle()).x;
  CurvePtr found = polynomial_approximation(radius, stretches, kTolerance * size);
  if (!found) throw FieldError("of", "the width of the strip is not smooth along the path", "a shorter path");
  for (int i = 0; i <= kPlaces; ++i) {
    const double t = domain.clamp(domain.lo + domain.width() * i / kPlaces);
    if (!(std::abs(found->evaluate(t, 1).d[1].x) < glm::length(band.image->evaluate(t, 1).d[1])))
      throw FieldError("of", fmt::format("at t = {:.6g} the strip widens faster than the path goes on", t),
                       "a lower scallop, or a shorter path");
  }
  return found;
}

std::any coverage_band(const Fields& f) {
  const auto* path = dynamic_cast<const ToolPath*>(f.curve("of").get());
  if (!path || path->bands().empty())
    throw FieldError("of", "the curve is no path of a cutter that knows the width of its strip",
                     "a cutter_path or tool_path with 'scallop', not moved");
  const int rows = static_cast<int>(path->bands().size()), row = f.integer("row");
  if (row >= rows) throw FieldError("row", fmt::format("the path has {} rows, numbered from 0", rows));
  const CoverageBand& band = path->bands()[static_cast<size_t>(row)];
  const bool is_circle = f.text("part") == "circle";
  if (is_circle != f.has("at"))
    throw FieldError(is_circle ? "part" : "at", "a circle, and it alone, has a place", "part: circle, at: 0.5");
  if (is_circle) {
    const double t = f.number("at");
    if (!band.image->domain().contains(t)) throw FieldError("at", "the parameter is outside of the path's domain");
    Frame frame;
    frame.origin = band.image->point(t);
    return std::any(CurvePtr(std::make_shared<Circle>(frame, 0.5 * band.diameter(t))));
  }
  const CurvePtr radius = radius_of(band);
  CurveProperties properties = properties_of(*band.image, 1);
  add_operand(properties, *radius, 1);
  return std::any(CurvePtr(std::make_shared<ComposedCurve<Envelope>>(
      Envelope{band.image, radius, f.text("part") == "left" ? 1.0 : -1.0}, properties)));
}

}  // namespace

TypeDeclaration coverage_band_type() {
  return declare(Category::curve, "coverage_band",
                 "Border of the band of a surface's parameter plane that a cutter covers along its path, with cusps of "
                 "a given height beside it; or one of the circles between its borders. Its parameter is the row's.")
      .example(
          "of: { type: cutter_path, of: { type: sphere_surface, radius: 4, domain: { u: [0, 2], v: [0.3, 1.2] } }, v: "
          "0.7, cutter: { radius: 1, corner_radius: 1, length: 3 }, scallop: 0.01 }")
      .field("of", reference({Category::curve}), "a cutter_path or tool_path with 'scallop'")
      .field("row", integer().at_least(0), "of a tool_path, from 0", "0")
      .field("part", choice({"left", "right", "circle"}),
             "the border to the left or the right of the path, or a circle", "left")
      .optional("at", number(), "parameter at the middle of the circle")
      .built_by(coverage_band);
}

}  // namespace lekalo::geometry
