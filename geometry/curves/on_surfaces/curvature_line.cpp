// Lines of curvature and asymptotic lines in scene files (Golovanov 2016, 3.1).
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/describe.h"
#include "geometry/queries/surface_lines/surface_lines.h"

namespace lekalo::geometry {

namespace {

TypeDeclaration declare_line(const char* name, const char* description, std::vector<std::string> families,
                             const char* of_families) {
  return declare(Category::curve, name, description)
      .field("of", reference({Category::surface}), "the surface")
      .field("through", numbers().count(2, 2), "parameters u and v of a point of the line; t is 0 there")
      .field("family", choice(std::move(families)), of_families)
      .optional("length", length().positive(), "goes no farther than half of it to each side of the point");
}

template <class Family, class Line>
SurfaceCurve build(const Fields& f, Line line_of, Family family) {
  const SurfacePtr surface = f.surface("of");
  const std::vector<double>& uv = f.numbers("through");
  std::optional<double> length;
  if (f.has("length")) length = f.number("length");
  const SurfaceLine line = line_of(*surface, Vec2(uv[0], uv[1]), family, length);
  return SurfaceCurve(surface, line.image, line.error);
}

}  // namespace

TypeDeclaration curvature_line_type() {
  return declare_line("curvature_line",
                      "Line of curvature through a point of a surface, both ways to the border of the domain, to an "
                      "umbilic, or until it closes. Its parameter is its length from the point.",
                      {"maximum", "minimum"}, "along the largest or the smallest curvature, signed by the normal")
      .example("of: { type: ellipsoid, semi_axes: [3, 2, 1] }, through: [0.5, 0.3], family: maximum")
      .built_by([](const Fields& f) {
        return build(f, curvature_line,
                     f.text("family") == "maximum" ? CurvatureFamily::maximum : CurvatureFamily::minimum);
      });
}

TypeDeclaration asymptotic_line_type() {
  return declare_line(
             "asymptotic_line",
             "Line through a saddle point of a surface along which its normal curvature vanishes, both ways to "
             "the border of the domain, to a parabolic point, or until it closes. Its parameter is its length "
             "from the point.",
             {"first", "second"},
             "turned from the direction of the largest curvature to the left (first) or to the right, seen from "
             "the normal")
      .example(
          "of: { type: hyperbolic_paraboloid, semi_axes: [1, 1], domain: { u: [-1, 1], v: [-1, 1] } }, through: [0.2, "
          "0.3], family: first")
      .built_by([](const Fields& f) {
        return build(f, asymptotic_line,
                     f.text("family") == "first" ? AsymptoticFamily::first : AsymptoticFamily::second);
      });
}

}  // namespace lekalo::geometry
