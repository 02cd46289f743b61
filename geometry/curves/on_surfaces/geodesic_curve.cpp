// Geodesics in scene files (Golovanov 2016, 3.1; Zavyalov et al. 1980, 113).
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/describe.h"
#include "geometry/queries/surface_lines/surface_lines.h"

namespace lekalo::geometry {

namespace {

Vec2 place(const Fields& f, const char* field) {
  const std::vector<double>& uv = f.numbers(field);
  return {uv[0], uv[1]};
}

}  // namespace

TypeDeclaration geodesic_curve_type() {
  return declare(
             Category::curve, "geodesic_curve",
             "Geodesic of a surface: from a point in a direction, or the shortest between two points. Its parameter is "
             "its length. It ends at the border of the domain or at a pole; over a crease it goes on at the same "
             "angle.")
      .example("of: { type: sphere_surface, radius: 2 }, from: [0, 0], direction: 30, length: 4")
      .field("of", reference({Category::surface}), "the surface")
      .field("from", numbers().count(2, 2), "parameters u and v of the beginning")
      .optional(
          "direction", angle(),
          "angle from the u line to the geodesic at its beginning, counterclockwise seen from the normal r_u x r_v")
      .optional("length", length().positive(), "with a direction: how far it goes, if it does not end before")
      .optional("to", numbers().count(2, 2), "instead of a direction and a length: parameters of the end")
      .built_by([](const Fields& f) {
        const SurfacePtr surface = f.surface("of");
        if (f.has("to") == f.has("direction"))
          throw FieldError(f.has("to") ? "to" : "from", "a geodesic has either a direction or an end",
                           "give 'direction' and 'length', or 'to'");
        if (f.has("to") && f.has("length"))
          throw FieldError("length", "a geodesic between two points has its own length", "leave it out");
        if (f.has("direction") && !f.has("length"))
          throw FieldError("direction", "the length of the geodesic is missing", "length: how far it goes");
        const SurfaceLine line = f.has("to")
                                     ? shortest_geodesic(*surface, place(f, "from"), place(f, "to"))
                                     : geodesic(*surface, place(f, "from"), f.number("direction"), f.number("length"));
        return SurfaceCurve(surface, line.image, line.error);
      });
}

}  // namespace lekalo::geometry
