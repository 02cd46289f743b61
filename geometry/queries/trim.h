// Regions of a parameter plane bounded by closed loops of curves: which points a trimmed face keeps.
#pragma once

#include <memory>
#include <vector>

#include "geometry/body.h"
#include "geometry/curve.h"

namespace lekalo::geometry {

// The region on the left of its loops (outer counterclockwise, holes clockwise). Boundary points count as inside.
// Curves may be any with rational pieces. Robust at vertices and tangencies: parity is counted on y-monotone arcs with
// half-open ends; an arc is decided by its convex hull and split until sure.
class TrimRegion {
 public:
  // Each loop is a closed chain of parameter curves; `forward` tells which way the loop runs along each. Periodic
  // directions: points are tested shifted by whole periods into the loops' range.
  struct Part {
    Curve2Ptr curve;
    bool forward;
  };
  explicit TrimRegion(const std::vector<std::vector<Part>>& loops);

  // True for points inside or within `tolerance` (a distance in the parameter plane) of the border.
  bool contains(double u, double v, double tolerance = 0) const;
  Interval u_range() const { return u_; }
  Interval v_range() const { return v_; }

 private:
  struct Arc {                 // monotone in y
    std::vector<Vec4> points;  // homogeneous rational Bezier in the plane (z unused)
    double x_lo, x_hi, y_lo, y_hi;
  };
  bool near_border(double u, double v, double tolerance) const;
  std::vector<Arc> arcs_;  // sorted by y_lo
  Interval u_;
  Interval v_;
};

// The trim of one face of a body, or null where the face fills its surface's domain.
std::shared_ptr<const TrimRegion> trim_of(const Body& body, int face);

}  // namespace lekalo::geometry
