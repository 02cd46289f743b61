// Shapes that answer for all their hits along a line at once: clipped bodies with caps, CSG. They stand in the
// hierarchy as one primitive.
#pragma once

#include <vector>

#include "geometry/queries/line_intersections.h"

namespace lekalo::render {

// What a shape shows at a hit: point, outward unit normal, parameters and the derivatives by them (zero where it has
// none).
struct ShapePoint {
  geometry::Vec3 position{0};
  geometry::Vec3 normal{0, 0, 1};
  geometry::Vec3 du{0};
  geometry::Vec3 dv{0};
  double u = 0;
  double v = 0;
};

class Shape {
 public:
  virtual ~Shape() = default;
  virtual geometry::Box3 bounds() const = 0;
  // All hits with t in the interval, in order, one for each crossing.
  virtual void all_hits(const geometry::Line& line, const geometry::Interval& t,
                        std::vector<geometry::SurfaceHit>& hits) const = 0;
  // `near` is the hit's place on the line that found it.
  virtual ShapePoint point(const geometry::SurfaceHit& hit, const geometry::Vec3& near) const = 0;
};

}  // namespace lekalo::render
