#include "geometry/surfaces/triangles/curved_triangles.h"

#include "geometry/surfaces/triangles/three_curves.h"

namespace lekalo::geometry {

namespace {

std::vector<Vec3> edge(const TriangleCorner& from, const TriangleCorner& to, EdgeTangents tangents) {
  return hermite_edge(from.point, from.normal, to.point, to.normal, tangents);
}

// The middle point from the mean of the other points: E + (E - V)/2.
TriangularNet pn_triangle(const std::array<TriangleCorner, 3>& p, EdgeTangents tangents) {
  const std::vector<Vec3> ab = edge(p[0], p[1], tangents), bc = edge(p[1], p[2], tangents),
                          ca = edge(p[2], p[0], tangents);
  const Vec3 edges = (ab[1] + ab[2] + bc[1] + bc[2] + ca[1] + ca[2]) / 6.0;
  const Vec3 corners = (p[0].point + p[1].point + p[2].point) / 3.0;
  const Vec3 middle = edges + 0.5 * (edges - corners);
  return net_of_points(3, {ab[0], ab[1], ca[2], ab[2], middle, ca[1], bc[0], bc[1], bc[2], ca[0]});
}

Vec3 derivative(const TriangleCorner& corner, const Vec2& along) { return along.x * corner.du + along.y * corner.dv; }

// The inner point of the cubic on the corners p, q and the middle m: across the side the derivative is linear.
Vec3 inner_point(const TriangleCorner& p, const TriangleCorner& q, const Vec2& m, const Vec3& at_p, const Vec3& at_q) {
  const Vec2 side = q.uv - p.uv, across(-side.y, side.x);
  const Barycentric t = ParameterTriangle{{p.uv, q.uv, m}}.direction(across);
  const Vec3 middle = (derivative(p, across) + derivative(q, across)) / 6.0;
  return (middle - t.x * at_p - t.y * at_q) / t.z;
}

}  // namespace

TriangularNet curved_triangle(const std::array<TriangleCorner, 3>& p, CurvedTriangle kind, EdgeTangents tangents) {
  if (kind == CurvedTriangle::pn) return pn_triangle(p, tangents);
  const std::array<std::vector<Vec3>, 3> curves{edge(p[2], p[1], tangents), edge(p[0], p[2], tangents),
                                                edge(p[1], p[0], tangents)};
  return kind == CurvedTriangle::hermite ? net_on_three_curves(curves) : balanced_net_on_three_curves(curves);
}

std::array<TriangularNet, 3> clough_tocher(const std::array<TriangleCorner, 3>& p) {
  const Vec2 m = (p[0].uv + p[1].uv + p[2].uv) / 3.0;
  const auto beside = [&](size_t i, const Vec2& to) { return p[i].point + derivative(p[i], to - p[i].uv) / 3.0; };
  std::array<Vec3, 3> inner, first, second;  // of the side k, k + 1; on the way from the corner k to the middle
  for (size_t k = 0; k < 3; ++k) {
    const size_t next = (k + 1) % 3;
    inner[k] = inner_point(p[k], p[next], m, beside(k, p[next].uv), beside(next, p[k].uv));
    first[k] = beside(k, m);
  }
  for (size_t k = 0; k < 3; ++k) second[k] = (first[k] + inner[k] + inner[(k + 2) % 3]) / 3.0;
  const Vec3 middle = (second[0] + second[1] + second[2]) / 3.0;
  std::array<TriangularNet, 3> result;
  for (size_t k = 0; k < 3; ++k) {
    const size_t next = (k + 1) % 3;
    result[k] = net_of_points(3, {p[k].point, beside(k, p[next].uv), first[k], beside(next, p[k].uv), inner[k],
                                  second[k], p[next].point, first[next], second[next], middle});
  }
  return result;
}

}  // namespace lekalo::geometry
