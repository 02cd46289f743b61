// A bicubic patch in place of a part of any smooth surface, with a proven bound on how far it is from it.
#pragma once

#include <array>

#include "geometry/queries/rays/bezier_patch.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

struct ProxyPatch {
  std::array<Vec4, 16> points;
  // Bounds over the rectangle, for the same x, y in [-1, 1]: on the distance from the surface's point, and on the
  // differences of the derivatives by x and by y. Infinite near singularities of the surface's formulas.
  double off = kInfinity, off_x = kInfinity, off_y = kInfinity;
  // How far rounding alone moves the surface's own points, as its enclosures at the corners say.
  double rounding = kInfinity;
  PatchView view() const { return {points.data(), 3, 3}; }
};

// The patch that has the surface's points, first and mixed derivatives at the corners of the rectangle.
ProxyPatch proxy_of(const Surface& surface, const Rectangle& box);

}  // namespace lekalo::geometry
