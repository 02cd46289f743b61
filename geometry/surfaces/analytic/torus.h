#pragma once

#include "geometry/surfaces/analytic/meridian_surface.h"

namespace lekalo::geometry {

// r(u, v) = o + (R + r cos v)(cos u x + sin u y) + r sin v z; R the major, r the minor radius; u, v in radians.
// r < R ring; r = R horn; 0 < R < r apple, the outer sheet; R = 0 sphere; -r < R < 0 lemon, the inner sheet.
// The normal points away from the tube's center line. Apple and lemon end in conical tips on the axis.
class TorusSurface final : public MeridianFormula<TorusSurface> {
 public:
  // minor > 0, major > -minor; the domain within a turn in u and in v, for R < r within full_domain. Throws
  // std::invalid_argument.
  TorusSurface(const Frame& frame, double major, double minor, const Rectangle& domain);
  TorusSurface(const Frame& frame, double major, double minor)
      : TorusSurface(frame, major, minor, full_domain(major, minor)) {}

  // u in [0, 2 pi], v in [-pi, pi] or between the points on the axis.
  static Rectangle full_domain(double major, double minor);

  double major_radius() const { return major_; }
  double minor_radius() const { return minor_; }

  Periods periods() const override { return {kTwoPi, kTwoPi}; }
  // The tube's outer half lies on the convex hull.
  Sides convex_sides(double, double v) const override {
    return {.front = major_ <= 0 || std::cos(v) >= 0, .back = false};
  }
  void line_hits(const Line& line, const Interval& t, LineHits& hits) const override { meet_line(line, t, hits); }

  template <class T>
  MeridianPoint<T> meridian_at(const T& v) const {
    using std::cos;
    using std::sin;
    return {major_ + minor_ * cos(v), minor_ * sin(v)};
  }

 private:
  void meet_line(const Line& line, const Interval& t, LineHits& hits) const;
  NurbsCurveForm meridian_form() const override;
  MeridianTangent meridian_near(const MeridianPoint<double>& near, double v) const override;
  double major_, minor_;
};

}  // namespace lekalo::geometry
