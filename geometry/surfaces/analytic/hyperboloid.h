#pragma once

#include "geometry/surfaces/analytic/meridian_surface.h"

namespace lekalo::geometry {

// One sheet: r(u, v) = o + a cosh v cos u x + b cosh v sin u y + c sinh v z; x^2/a^2 + y^2/b^2 - z^2/c^2 = 1.
// u in radians, v any; the normal points away from the axis.
class HyperboloidOneSheet final : public MeridianFormula<HyperboloidOneSheet> {
 public:
  static constexpr Rectangle kUnbounded{{0, kTwoPi}, {-kInfinity, kInfinity}};

  // Semi-axes (a, b, c) > 0; throws std::invalid_argument.
  HyperboloidOneSheet(const Frame& frame, const Vec3& semi_axes, const Rectangle& domain);
  Vec3 semi_axes() const { return {a_, b_, c_}; }

  void line_hits(const Line& line, const Interval& t, LineHits& hits) const override;

  template <class T>
  MeridianPoint<T> meridian_at(const T& v) const {
    using std::cosh;
    using std::sinh;
    return {cosh(v), c_ * sinh(v)};
  }

 private:
  NurbsCurveForm meridian_form() const override;
  double c_;
};

// One of two sheets: r(u, v) = o + a sinh v cos u x + b sinh v sin u y + c cosh v z; x^2/a^2 + y^2/b^2 - z^2/c^2 = -1.
// c > 0 is the sheet z >= c, where the normal points to the convex side (downward at the vertex v = 0); c < 0 the other
// one, where it points to the concave side. u in radians, v >= 0.
class HyperboloidTwoSheets final : public MeridianFormula<HyperboloidTwoSheets> {
 public:
  static constexpr Rectangle kUnbounded{{0, kTwoPi}, {0, kInfinity}};

  // a, b > 0, c not zero, v >= 0; throws std::invalid_argument.
  HyperboloidTwoSheets(const Frame& frame, const Vec3& semi_axes, const Rectangle& domain);
  Vec3 semi_axes() const { return {a_, b_, c_}; }

  Sides convex_sides(double, double) const override { return {.front = c_ > 0, .back = c_ < 0}; }
  void line_hits(const Line& line, const Interval& t, LineHits& hits) const override;

  template <class T>
  MeridianPoint<T> meridian_at(const T& v) const {
    using std::cosh;
    using std::sinh;
    return {sinh(v), c_ * cosh(v)};
  }

 private:
  NurbsCurveForm meridian_form() const override;
  double c_;
};

}  // namespace lekalo::geometry
