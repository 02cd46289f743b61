#pragma once

#include "geometry/surfaces/analytic/meridian_surface.h"

namespace lekalo::geometry {

// r(u, v) = o + a cos v cos u x + b cos v sin u y + c sin v z, radians; x^2/a^2 + y^2/b^2 + z^2/c^2 = 1.
// The normal points outward; poles at v = -pi/2, pi/2.
class Ellipsoid final : public MeridianFormula<Ellipsoid> {
 public:
  static constexpr Rectangle kFull{{0, kTwoPi}, {-0.5 * kPi, 0.5 * kPi}};

  // Semi-axes (a, b, c) > 0, domain within a turn and [-pi/2, pi/2]; throws std::invalid_argument.
  Ellipsoid(const Frame& frame, const Vec3& semi_axes, const Rectangle& domain = kFull);
  Vec3 semi_axes() const { return {a_, b_, c_}; }

  Sides convex_sides(double, double) const override { return {.front = true, .back = false}; }
  void line_hits(const Line& line, const Interval& t, LineHits& hits) const override;

  template <class T>
  MeridianPoint<T> meridian_at(const T& v) const {
    using std::cos;
    using std::sin;
    return {cos(v), c_ * sin(v)};
  }

 private:
  NurbsCurveForm meridian_form() const override;
  double c_;
};

}  // namespace lekalo::geometry
