// Circle, circular arc and arc through three points (Golovanov 2016, 2.2).
//
//   u = B - A, v = C - A, w = u x v:   center = A + (|u|^2 v - |v|^2 u) x w / (2 |w|^2), plane normal w.
#include "geometry/curves/analytic/circle.h"

#include <cmath>
#include <stdexcept>

#include "geometry/describe.h"

namespace lekalo::geometry {

Circle arc_through(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a, w = glm::cross(u, v);
  const double area = glm::length(w);
  if (!(area > 1e-12 * glm::length(u) * glm::length(v)))
    throw std::invalid_argument("the three points of an arc lie on one line or coincide");
  const Vec3 to_center = glm::cross(glm::dot(u, u) * v - glm::dot(v, v) * u, w / area) / (2 * area);
  const Frame frame = frame_from(a + to_center, w, -to_center);
  const Vec3 end = frame.to_local_point(c);
  const double angle = std::atan2(end.y, end.x);
  return Circle(frame, glm::length(to_center), {0, angle > 0 ? angle : angle + kTwoPi});
}

TypeDeclaration circle_type() {
  return declare(Category::curve, "circle", "Circle or circular arc in the x, y plane of its frame.")
      .field("frame", frame(), "placement: the center, the normal z and the direction x of the angle zero", "{}")
      .field("radius", length().positive(), "radius")
      .optional("arc", angle_range(), "part of the circle: start and end angle, from x towards y; at most one turn")
      .built_by([](const Fields& f) {
        if (!f.has("arc")) return Circle(f.frame(), f.number("radius"));
        if (f.range("arc").width() > kTwoPi * (1 + 1e-12))
          throw FieldError("arc", "the arc is longer than one turn", "end - start must not exceed 360");
        return Circle(f.frame(), f.number("radius"), f.range("arc"));
      });
}

TypeDeclaration arc_through_points_type() {
  return declare(Category::curve, "arc_through_points", "Circular arc from the first through the second to the third.")
      .field("points", points().count(3, 3), "start, a point on the arc, end; not on one line")
      .built_by([](const Fields& f) {
        const std::vector<Vec3>& p = f.points("points");
        try {
          return arc_through(p[0], p[1], p[2]);
        } catch (const std::invalid_argument& error) {
          throw FieldError("points", error.what(), "move one of the points off the line, or use a segment");
        }
      });
}

}  // namespace lekalo::geometry
