// The smallest box about a thing that stands along an axis: the blank from which it is milled (Zavyalov et al. 1985,
// VII.3).
#pragma once

#include "geometry/queries/closest/distance.h"

namespace lekalo::geometry {

struct BlankBox {
  Frame frame;  // z along the axis, x and y along the sides; its origin is the corner of the lowest coordinates
  Vec3 size{0};
  double angle = 0;  // by which x is turned from the x of frame_about, less than a right angle
  double volume() const { return size.x * size.y * size.z; }
};

// Widths are certified; the angle is that of the least local minimum, to 1e-9, of those beside each angle of 3 degrees
// with no less area than its neighbours: a narrower one may be missed. `box` is any that holds the thing. Throws
// std::invalid_argument for what is unbounded.
BlankBox blank_box(const Distant& of, const Box3& box, const Vec3& axis);

}  // namespace lekalo::geometry
