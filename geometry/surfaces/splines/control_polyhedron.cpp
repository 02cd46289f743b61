// The control polyhedron of a NURBS surface: bilinear facets on neighbouring quadruples of its control points
// (Golovanov 2016, 3.7, 3.8). It is the surface of degree 1 on the same points with equal weights.
#include <fmt/format.h>

#include "geometry/describe.h"
#include "geometry/surfaces/splines/nurbs_surface.h"

namespace lekalo::geometry {

namespace {

SplineAxis linear_axis(int count) {
  std::vector<double> knots{0};
  for (int i = 0; i < count; ++i) knots.push_back(i);
  knots.push_back(count - 1);
  return SplineAxis(1, std::move(knots), Extension::tangent);
}

NurbsSurface polyhedron(const Surface& of) {
  const auto form = of.as_nurbs();
  if (!form)
    throw FieldError("of", "the surface has no control points", "a NURBS surface, or one that can be written so");
  std::vector<Vec3> points;
  for (size_t k = 0; k < form->points.size(); ++k) {
    const Vec4& p = form->points[k];
    if (p.w == 0)
      throw FieldError("of",
                       fmt::format("control point ({}, {}) is at infinity", k / form->count_v(), k % form->count_v()));
    points.push_back(Vec3(p) / p.w);
  }
  return NurbsSurface(linear_axis(form->count_u()), linear_axis(form->count_v()), points);
}

}  // namespace

TypeDeclaration control_polyhedron_type() {
  return declare(Category::surface, "control_polyhedron",
                 "The control points of a surface joined by bilinear facets; u and v count them.")
      .example("of: { type: bezier_surface, points: [[[0, 0], [0, 1, 1], [0, 2]], [[1, 0, 1], [1, 1, 2], [1, 2]]] }")
      .field("of", reference({Category::surface}), "the surface")
      .shows({"control_net"})
      .built_by([](const Fields& f) { return polyhedron(*f.surface("of")); });
}

}  // namespace lekalo::geometry
