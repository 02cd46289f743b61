// Composite Bezier surfaces (Golovanov 2016, 3.7): patches of one degree p that share the control points of their
// common edges. With the edge points q, their neighbours a and b on both sides,
//
//   b - q = k (q - a),  k the ratio of the lengths of parameter
//
// makes the derivatives across the edge the same. So q need not be given: it divides the leg from a to b. These are
// B-splines with knots of multiplicity p, or p - 1 where edges are smooth.
#include <fmt/format.h>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/describe.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

SplineAxis axis_of(const Fields& f, bool along_u) {
  const Grid<Vec3>& net = f.net("points");
  const char* name = along_u ? "u" : "v";
  const int degree = along_u ? f.u<int>("degree") : f.v<int>("degree"), count = along_u ? net.rows : net.columns;
  const bool smooth = (along_u ? f.u<std::string>("joints") : f.v<std::string>("joints")) == "smooth";
  if (smooth && degree < 2)
    throw FieldError("joints", fmt::format("patches of degree 1 along {} have no smooth joints", name), "degree: 2");
  // Of m patches there are m (p - 1) + 2 points, and m - 1 more where the joints' own are given.
  const int own = smooth ? degree - 1 : degree, first = smooth ? 2 : 1, patches = (count - first) / own;
  if (patches < 1 || patches * own + first != count)
    throw FieldError("points",
                     fmt::format("{} points along {} do not make patches of degree {}: {}, {}, {} .. do", count, name,
                                 degree, own + first, 2 * own + first, 3 * own + first),
                     smooth ? "the points of smooth joints are left out" : "neighbours share the points of their edge");
  std::vector<double> breaks;
  const char* field = along_u ? "knots_u" : "knots_v";
  if (f.has(field))
    breaks = f.numbers(field);
  else
    for (int i = 0; i <= patches; ++i) breaks.push_back(i);
  if (static_cast<int>(breaks.size()) != patches + 1)
    throw FieldError(field, fmt::format("{} patches have {} edges, not {}", patches, patches + 1, breaks.size()));
  for (int i = 1; i <= patches; ++i)
    if (!(breaks[i] - breaks[i - 1] > kSameKnot * (breaks.back() - breaks.front())))
      throw FieldError(field, fmt::format("values must increase, but {} follows {}", breaks[i], breaks[i - 1]));
  std::vector<double> knots;
  for (int i = 0; i <= patches; ++i) knots.insert(knots.end(), i == 0 || i == patches ? degree + 1 : own, breaks[i]);
  return SplineAxis(degree, std::move(knots), Extension::tangent);
}

}  // namespace

TypeDeclaration composite_bezier_type() {
  return declare(Category::surface, "composite_bezier",
                 "Bezier patches of one degree side by side, in rows and columns, with common points at their edges; "
                 "smooth over them if wanted.")
      .field("points", net(),
             "control points of all patches: points[i][j], i runs with u, j with v; those of an edge stand once, or "
             "where joints are smooth not at all")
      .field("degree", integer().between(1, kMaxDegree).for_each_direction(), "degree of the patches", "3")
      .field("joints", choice({"as_given", "smooth"}).for_each_direction(),
             "smooth: the points of a common edge divide the legs between its neighbours as the knots do, and the "
             "derivative across is continuous",
             "as_given")
      .optional("knots_u", numbers(), "values of u at the edges; else 0, 1, 2, ..")
      .optional("knots_v", numbers(), "values of v at the edges; else 0, 1, 2, ..")
      .optional("weights", number_grid(), "one weight for each point, in the same rows; all 1 when left out")
      .example("degree: 1, points: [[[0, 0], [0, 1]], [[1, 0, 1], [1, 1, 1]], [[2, 0], [2, 1]]]")
      .shows({"control_net", "knots"})
      .built_by([](const Fields& f) {
        SplineAxis u = axis_of(f, true), v = axis_of(f, false);
        return NurbsSurface(std::move(u), std::move(v), f.net("points").values, weights_of_net(f));
      });
}

}  // namespace lekalo::geometry
