// Bezier triangles (Golovanov 2016, 3.11).
#pragma once

#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/surfaces/triangles/triangular_surface.h"

namespace lekalo::geometry {

// r = sum B_ijk(a, b, c) p_ijk, rational where the weights differ; over the square an exact Bezier surface.
class BezierTriangle final : public TriangularSurface {
 public:
  // A net of degree 1..kMaxDegree in homogeneous coordinates. Throws FieldError as a NurbsSurface does.
  explicit BezierTriangle(TriangularNet net, const ParameterTriangle& triangle = {},
                          TrianglePole pole = TrianglePole::first);
  const TriangularNet& net() const { return net_; }
  SurfaceJet evaluate_over_triangle(const Vec2& uv, int order) const override;

 private:
  TriangularNet net_;
};

// The net of a Bezier triangle, or of an image of one; nothing of other surfaces.
std::optional<TriangularNet> triangular_net(const Surface& surface);

// A net of points with the weight 1.
TriangularNet net_of_points(int degree, const std::vector<Vec3>& points);

}  // namespace lekalo::geometry
