#pragma once

#include "geometry/surfaces/analytic/meridian_surface.h"

namespace lekalo::geometry {

// r(u, v) = o + rho cos u x + rho sin u y + h v z,  rho(v) = radius + (top_radius - radius) v; u in radians, v = 0 at
// the base, 1 at the height h. The half-angle between generatrix and axis has the tangent (top_radius - radius)/h. The
// normal points outward, away from the axis, where h > 0, on both nappes.
class ConeSurface : public MeridianFormula<ConeSurface> {
 public:
  static constexpr Rectangle kFull{{0, kTwoPi}, {0, 1}};

  // radius, top_radius of any sign, not both zero; height not zero. An unbounded cone has v in [-inf, inf].
  // Throws std::invalid_argument.
  ConeSurface(const Frame& frame, double radius, double top_radius, double height, const Rectangle& domain = kFull);
  double radius() const { return radius_; }
  double top_radius() const { return radius_ + widening_; }
  double height() const { return height_; }

  // Of one nappe the outer side.
  Sides convex_sides(double u, double v) const override;
  FootPoint foot_point(const Vec3& near) const override;
  void line_hits(const Line& line, const Interval& t, LineHits& hits) const override { meet_line(line, t, hits); }

  template <class T>
  MeridianPoint<T> meridian_at(const T& v) const {
    return {radius_ + widening_ * v, height_ * v};
  }

 private:
  void meet_line(const Line& line, const Interval& t, LineHits& hits) const;
  NurbsCurveForm meridian_form() const override;
  Vec3 nearest_axis_point() const;
  double radius_, widening_, height_;
};

// The cone of half-angle zero.
class CylinderSurface final : public ConeSurface {
 public:
  static constexpr Rectangle kUnbounded{{0, kTwoPi}, {-kInfinity, kInfinity}};

  // Radius > 0. With height 1 and the domain kUnbounded, v is the length along the axis.
  CylinderSurface(const Frame& frame, double radius, double height, const Rectangle& domain = kFull)
      : ConeSurface(frame, radius, radius, height, domain) {}
};

}  // namespace lekalo::geometry
