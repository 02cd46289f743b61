// Shapes that answer for all their hits along a line at once: clipped bodies with caps, CSG. They stand in the
// hierarchy as one primitive.
#pragma once

#include <vector>

#include "geometry/queries/line_intersections.h"

namespace lekalo::render {

class Shape {
 public:
  virtual ~Shape() = default;
  virtual geometry::Box3 bounds() const = 0;
  // All hits with t in the interval, in order, one for each crossing.
  virtual void all_hits(const geometry::Line& line, const geometry::Interval& t,
                        std::vector<geometry::SurfaceHit>& hits) const = 0;
  // Surface that a hit's face number stands for, and the sign of its outward normal.
  virtual const geometry::Surface& surface(int face) const = 0;
  virtual double sign(int face) const = 0;
};

}  // namespace lekalo::render
