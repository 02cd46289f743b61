// Surfaces over a triangle of parameters (Golovanov 2016, 3.10).
//
// All that takes surfaces over rectangles sees them over a square of which one edge is a corner of the triangle:
//
//   pole at the first corner   a = u,            b = (1 - u) v,  c = (1 - u)(1 - v):  u = 1 is that corner
//   pole at the second corner  a = u (1 - v),    b = v,          c = (1 - u)(1 - v):  v = 1 is that corner
//
// What wants derivatives by the parameters of the triangle, in which nothing is singular, asks for these.
#pragma once

#include "geometry/surface.h"
#include "geometry/surfaces/triangles/parameter_triangle.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

enum class TrianglePole { first, second };

class TriangularSurface : public Surface {
 public:
  const ParameterTriangle& triangle() const { return triangle_; }
  TrianglePole pole() const { return pole_; }

  // By the parameters of the triangle: point and partial derivatives up to `order`, 0..kMaxSurfaceOrder.
  virtual SurfaceJet evaluate_over_triangle(const Vec2& uv, int order) const = 0;

  Rectangle domain() const override { return square_->domain(); }
  SurfaceJet evaluate(double u, double v, int order) const override { return square_->evaluate(u, v, order); }
  int max_order() const override { return square_->max_order(); }
  SurfaceEnclosure enclose(const Rectangle& box, int order) const override { return square_->enclose(box, order); }
  int enclosure_order() const override { return square_->enclosure_order(); }
  std::vector<SurfacePiece> pieces() const override { return square_->pieces(); }
  std::optional<NurbsSurfaceForm> as_nurbs() const override { return square_->as_nurbs(); }
  DegenerateEdges degenerate_edges() const override { return square_->degenerate_edges(); }

 protected:
  // `square`: the surface over the square.
  TriangularSurface(SurfacePtr square, const ParameterTriangle& triangle, TrianglePole pole)
      : square_(std::move(square)), triangle_(triangle), pole_(pole) {}

 private:
  SurfacePtr square_;
  ParameterTriangle triangle_;
  TrianglePole pole_;
};

// A surface over a triangle, or an image of one.
struct PlacedTriangle {
  const TriangularSurface* surface = nullptr;  // null: it is none
  Affine map;

  SurfaceJet evaluate(const Vec2& uv, int order) const;
};
PlacedTriangle placed_triangle(const Surface& surface);

// a, b, c as functions of the parameters of the triangle, for any number type.
template <class T>
std::array<T, 3> barycentric(const ParameterTriangle& triangle, const T& u, const T& v) {
  const auto& [p, q, r] = triangle.corners;
  const auto over = [&](const Vec2& from, const Vec2& to) {
    return ((from.x - u) * (to.y - v) - (from.y - v) * (to.x - u)) / triangle.determinant();
  };
  return {over(q, r), over(r, p), over(p, q)};
}

// The same of the square's.
template <class T>
std::array<T, 3> barycentric(TrianglePole pole, const T& u, const T& v) {
  if (pole == TrianglePole::first) return {u, (1.0 - u) * v, (1.0 - u) * (1.0 - v)};
  return {u * (1.0 - v), v, (1.0 - u) * (1.0 - v)};
}

// The fields `corners` and `pole` of such surfaces.
class Fields;
struct TypeDeclaration;
void declare_triangle(TypeDeclaration& type);
// Throws FieldError (field corners).
ParameterTriangle triangle_of(const Fields& fields);
TrianglePole pole_of(const Fields& fields);

}  // namespace lekalo::geometry
