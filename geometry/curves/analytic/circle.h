// Circles and circular arcs.
#pragma once

#include "geometry/curves/analytic/ellipse.h"

namespace lekalo::geometry {

// r(t) = o + R (cos t x + sin t y), t in radians, counterclockwise seen from the tip of z.
class Circle final : public Ellipse {
 public:
  // Radius > 0; the arc may start anywhere and is at most one turn long. Throws std::invalid_argument.
  Circle(const Frame& frame, double radius, const Interval& arc = {0, kTwoPi}) : Ellipse(frame, radius, radius, arc) {}
  double radius() const { return semi_axis_x(); }
};

// The arc from a through b to c; t = 0 at a. Throws std::invalid_argument where the points are on one line or coincide.
Circle arc_through(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace lekalo::geometry
