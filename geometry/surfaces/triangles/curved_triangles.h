// Curved triangles on corners with normals or derivatives (Golovanov 2016, 3.17).
#pragma once

#include "geometry/curves/interpolation/hermite_edge.h"
#include "geometry/surfaces/triangles/bezier_triangle.h"

namespace lekalo::geometry {

// What is known of a corner: its point and unit normal, and for clough_tocher the derivatives by the parameters.
struct TriangleCorner {
  Vec3 point{0};
  Vec3 normal{0};
  Vec2 uv{0};
  Vec3 du{0}, dv{0};
};

// hermite: the surface on the three edge curves, of degree 4 (3.17.2); its normals are no better than those of flat
// facets. balanced: without its bulge (3.10). pn: cubic on the same edges (Vlachos et al. 2001). All three join their
// neighbours without a gap, and without a crease at the corners alone.
enum class CurvedTriangle { hermite, balanced, pn };
TriangularNet curved_triangle(const std::array<TriangleCorner, 3>& corners, CurvedTriangle kind,
                              EdgeTangents tangents = EdgeTangents::projected);

// Three cubics about the middle of the triangle, which join each other, and neighbours that have the same points and
// derivatives at the common corners, with equal derivatives by u and v (Clough, Tocher 1965): across a side these are
// linear along it. Quadratic surfaces are reproduced. The k-th lies on the corners k, k + 1 and the middle.
std::array<TriangularNet, 3> clough_tocher(const std::array<TriangleCorner, 3>& corners);

}  // namespace lekalo::geometry
