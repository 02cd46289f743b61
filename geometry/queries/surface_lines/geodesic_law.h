// The differential equation of geodesics, as a law of a surface flow: r'' has no part in the tangent plane (Golovanov
// 2016, 3.1; do Carmo 1976, 4-4 and 5-5),
//
//   u'' r_u + v'' r_v = -(tangential part of r_uu u'^2 + 2 r_uv u' v' + r_vv v'^2)
//
// and beside it that of Jacobi's field, J'' = -K J: J(s) is how far a geodesic moves sideways at s where the direction
// at its beginning turns by one radian (J(0) = 0, J'(0) = 1).
#pragma once

#include "geometry/queries/surface_lines/surface_flow.h"

namespace lekalo::geometry {

// The components of a tangent vector by r_u and r_v.
inline Vec2 tangent_components(const SurfaceJet& at, const Vec3& tangent) {
  const Vec3 n = glm::cross(at.du(), at.dv());
  const double area2 = glm::dot(n, n);
  return {glm::dot(glm::cross(tangent, at.dv()), n) / area2, glm::dot(glm::cross(at.du(), tangent), n) / area2};
}

// Derivatives on both sides of a line that differ by no more than this are one.
inline constexpr double kSameDerivative = 1e-9;

// False where parameter lines touch each other.
inline bool is_regular(const SurfaceJet& at) {
  return glm::length(glm::cross(at.du(), at.dv())) > 1e-12 * glm::length(at.du()) * glm::length(at.dv());
}

struct GeodesicLaw {
  static constexpr int kSize = 6;  // u, v, u', v', J, J'
  static constexpr bool kPassesPoles = true;
  using State = std::array<double, kSize>;

  // The state at (u, v) in the direction at the angle (radians) from r_u.
  static State start(const Surface& surface, const Vec2& uv, double angle);

  std::optional<State> rates(const SurfaceJet& at, const State& y, const Vec3& before) const;
  bool is_singular(const SurfaceJet&) const { return false; }
  // Gives the state a direction in space.
  void turn(const SurfaceJet& at, const Vec3& direction, State& y) const {
    const Vec2 rate = tangent_components(at, direction);
    y[2] = rate.x;
    y[3] = rate.y;
  }
  bool cross(const SurfaceJet& from, const SurfaceJet& to, bool along_u, State& y, const Vec3& before) const;
};

using GeodesicFlow = SurfaceFlow<GeodesicLaw>;

// The size by which lengths on the surface are judged, where `length` of it is looked at.
double line_size(const Surface& surface, double length);

// The line that the parts make; `again` is the same by other steps.
SurfaceLine finished(const Surface& surface, std::vector<PolynomialCurve::Part> parts,
                     const std::vector<PolynomialCurve::Part>& again);

// Throws FieldError (field `name`) unless the place lies in the domain and is no pole.
void check_place(const Surface& surface, const Vec2& uv, const char* name);

}  // namespace lekalo::geometry
