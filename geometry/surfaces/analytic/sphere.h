#pragma once

#include "geometry/surfaces/analytic/meridian_surface.h"

namespace lekalo::geometry {

// r(u, v) = o + R (cos v cos u x + cos v sin u y + sin v z); u the longitude, v the latitude, radians.
// The normal points outward; poles at v = -pi/2, pi/2.
class SphereSurface final : public MeridianFormula<SphereSurface> {
 public:
  static constexpr Rectangle kFull{{0, kTwoPi}, {-0.5 * kPi, 0.5 * kPi}};

  // Radius > 0, domain within a turn and [-pi/2, pi/2]; throws std::invalid_argument.
  SphereSurface(const Frame& frame, double radius, const Rectangle& domain = kFull);
  double radius() const { return radius_; }

  using MeridianSurface::normal;
  Vec3 normal(double u, double v, const SurfaceJet& jet) const override;
  FootPoint foot_point(const Vec3& near) const override;
  Sides convex_sides(double, double) const override { return {.front = true, .back = false}; }
  void line_hits(const Line& line, const Interval& t, LineHits& hits) const override;

  template <class T>
  MeridianPoint<T> meridian_at(const T& v) const {
    using std::cos;
    using std::sin;
    return {radius_ * cos(v), radius_ * sin(v)};
  }

 private:
  NurbsCurveForm meridian_form() const override;
  MeridianTangent meridian_near(const MeridianPoint<double>& near, double v) const override;
  double radius_;
};

}  // namespace lekalo::geometry
