// What a line that is followed on a surface must know of the surface's domain: smooth pieces, where it is closed,
// poles.
#pragma once

#include <optional>
#include <vector>

#include "geometry/surface.h"

namespace lekalo::geometry {

struct FlowDomain {
  explicit FlowDomain(const Surface& surface);

  // An edge of the domain that is one point.
  struct Pole {
    int axis = 0;  // of the parameter that is held on the edge
    bool above = false;
    Vec3 point{0};
  };

  double edge(const Pole& pole) const;
  // The place beside a pole that lies `out` from it, if the pole is a smooth point of the surface; `out` is short.
  std::optional<Vec2> beyond(const Pole& pole, const Vec3& out) const;

  const Surface& surface;
  Rectangle whole;
  std::vector<Rectangle> pieces;
  double period[2] = {0, 0};  // where the surface is closed
  // The largest |r_u| and |r_v| of a surface with poles: an error of u made next to a pole counts wherever the line
  // goes then. Else 0.
  double speeds[2] = {0, 0};
  std::vector<Pole> poles;
};

inline const Interval& side(const Rectangle& box, int axis) { return axis == 0 ? box.u : box.v; }

// Numbers of a range that differ by so much are one but for rounding.
double slack(const Interval& range);

}  // namespace lekalo::geometry
