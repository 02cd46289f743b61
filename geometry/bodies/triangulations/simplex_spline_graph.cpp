// The graph of a simplex spline over its support, piece by piece exact (Golovanov 2016, 3.13).
#include <fmt/format.h>

#include "geometry/bodies/triangulations/spline_graph.h"
#include "geometry/describe.h"
#include "geometry/surfaces/triangles/simplex_spline.h"

namespace lekalo::geometry {

namespace {

SplineOnCells on_cells(const Fields& f, const SimplexSpline& spline) {
  const std::vector<Vec2>& knots = spline.knots();
  SplineOnCells result{planar_cells(convex_hull(knots), all_segments(knots)), {}};
  const bool by_powers = f.text("method") == "truncated_powers";
  if (f.has("auxiliary") && !by_powers)
    throw FieldError("auxiliary", "the recurrence has no auxiliary point", "method: truncated_powers");
  const Vec2 x = f.has("auxiliary") ? Vec2(f.vec3("auxiliary")) : Vec2(0);
  for (size_t t = 0; t < result.cells.triangles.size(); ++t)
    result.nets.push_back(by_powers ? truncated_power_net(knots, x, result.cells.corners(t))
                                    : spline.net(result.cells.corners(t)));
  return result;
}

}  // namespace

TypeDeclaration simplex_spline_type() {
  return declare(Category::body, "simplex_spline",
                 "Graph of a simplex spline, the B-spline of two variables, over its support in the plane x, y "
                 "(Golovanov 2016, 3.13): of degree n on n + 3 knots. Its faces are the polynomials; 'lekalo evaluate "
                 "--uv' tells values and derivatives, with 'solid' the volume is the integral.")
      .field("knots", parameter_points().count(3, static_cast<int>(kMaxSimplexKnots)),
             "they may repeat, and lie on lines; not all on one")
      .field("scale", number().positive(), "of the height", "1")
      .field("method", choice({"recurrence", "truncated_powers"}),
             "truncated_powers: the divided difference of truncated powers, of knots no three of which are collinear",
             "recurrence")
      .optional("auxiliary", point(), "of truncated_powers: any point that is on no line through two knots; [0, 0]")
      .field("walls", boolean(), "upright where the function jumps", "true")
      .field("solid", boolean(), "a closed body that stands on the plane", "false")
      .example("knots: [[0, 0], [4, 0], [5, 3], [2, 5], [-1, 3]], scale: 100")
      .built_by([](const Fields& f) -> BodyPtr {
        try {
          const SimplexSpline spline(plane_points(f.points("knots")));
          const GraphOptions options{f.number("scale"), f.boolean("walls"), f.boolean("solid")};
          return std::make_shared<Body>(graph_of(on_cells(f, spline), options));
        } catch (const FieldError&) {
          throw;
        } catch (const std::invalid_argument& error) {
          const bool of_powers = f.text("method") == "truncated_powers";
          throw FieldError(of_powers ? "method" : "knots", error.what(),
                           of_powers ? "method: recurrence takes all knots; or move 'auxiliary'" : "");
        }
      });
}

}  // namespace lekalo::geometry
