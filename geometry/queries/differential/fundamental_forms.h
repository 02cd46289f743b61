// The two fundamental forms of a surface at a point and what follows from them (Golovanov 2016, 3.1.4-3.1.14; Zavyalov
// et al. 1985, II.3).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "geometry/queries/differential/curvature.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// Symmetric: E, F, G of the first form (length^2), L, M, N of the second (length).
struct QuadraticForm {
  double uu = 0, uv = 0, vv = 0;
  double operator()(const Vec2& a, const Vec2& b) const {
    return uu * a.x * b.x + uv * (a.x * b.y + a.y * b.x) + vv * a.y * b.y;
  }
  double operator()(const Vec2& a) const { return (*this)(a, a); }
  double determinant() const { return uu * vv - uv * uv; }
};

struct FundamentalForms {
  QuadraticForm first, second;
  // m_u = -w[0][0] r_u - w[0][1] r_v, m_v = -w[1][0] r_u - w[1][1] r_v (Weingarten).
  double weingarten[2][2] = {{0, 0}, {0, 0}};
  Vec3 normal_du{0}, normal_dv{0};
};

// At a regular place; nothing where r_u x r_v vanishes. The jet is of order >= 2, the normal of length 1; the second
// form has its sign.
std::optional<FundamentalForms> fundamental_forms(const SurfaceJet& jet, const Vec3& normal);

// elliptic, hyperbolic, parabolic, planar (both curvatures vanish), umbilic (elliptic with equal ones). Curvatures
// below 1e-9 of the larger, or of 1 / size for a surface's size, count as none; as do their differences.
std::string_view point_type(const SurfaceCurvature& curvature, double size);

// Unit vectors in which the normal curvature vanishes: two at a hyperbolic point, symmetric about the principal
// directions, one at a parabolic, none elsewhere (at a planar point all are).
std::vector<Vec3> asymptotic_directions(const SurfaceCurvature& curvature, double size);

// What is seen of a surface in the direction (du, dv) of its parameters, not zero.
struct DirectionalCurvature {
  Vec3 direction{0};   // of length 1
  double normal = 0;   // II / I, signed by the surface's normal
  double torsion = 0;  // of the geodesic in this direction
  double angle = 0;    // of its line from the first principal one, left seen from the normal, -pi/2..pi/2
};
DirectionalCurvature curvature_along(const SurfaceJet& jet, const Vec3& normal, const FundamentalForms& forms,
                                     const SurfaceCurvature& principal, const Vec2& direction);

// How a curve on a surface bends: k^2 = normal^2 + geodesic^2. The geodesic curvature is positive where the curve turns
// left, seen from the normal (Zavyalov et al. 1985, 113). The jet is of order >= 2 with r' != 0.
struct CurveOnSurfaceCurvature {
  double normal = 0, geodesic = 0;
};
CurveOnSurfaceCurvature curvature_on_surface(const CurveJet& jet, const Vec3& normal);

}  // namespace lekalo::geometry
