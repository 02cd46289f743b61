#include "geometry/surfaces/triangles/triangular_surface.h"

#include <cmath>

#include "geometry/describe.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

SurfaceJet PlacedTriangle::evaluate(const Vec2& uv, int order) const {
  SurfaceJet jet = surface->evaluate_over_triangle(uv, order);
  for (int n = 0; n <= order; ++n)
    for (int j = 0; j <= n; ++j) jet.d(n - j, j) = n == 0 ? map.point(jet.d(0, 0)) : map.direction(jet.d(n - j, j));
  return jet;
}

PlacedTriangle placed_triangle(const Surface& surface) {
  const auto [triangular, map] = placed<TriangularSurface>(surface);
  return {triangular, map};
}

void declare_triangle(TypeDeclaration& type) {
  type.field("corners", parameter_points().count(3, 3),
             "of the triangle of parameters, where a, b and c are 1: those of 'lekalo evaluate --uv'",
             "[[1, 0], [0, 1], [0, 0]]")
      .field("pole", choice({"first", "second"}),
             "the corner that is an edge of the square over which everything else sees the surface: first, u = a and v "
             "= b/(b + c); second, v = b and u = a/(a + c)",
             "first");
}

ParameterTriangle triangle_of(const Fields& f) {
  const std::vector<Vec3>& given = f.points("corners");
  ParameterTriangle triangle;
  double longest = 0;
  for (size_t k = 0; k < 3; ++k) {
    triangle.corners[k] = Vec2(given[k]);
    longest = std::max(longest, glm::length(Vec2(given[k] - given[(k + 1) % 3])));
  }
  if (!(std::abs(triangle.determinant()) > 1e-14 * longest * longest))
    throw FieldError("corners", "the corners lie on one line", "a triangle of parameters needs three that do not");
  return triangle;
}

TrianglePole pole_of(const Fields& f) { return f.text("pole") == "first" ? TrianglePole::first : TrianglePole::second; }

}  // namespace lekalo::geometry
