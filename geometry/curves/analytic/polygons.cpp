// Closed curves of lines and arcs: rectangle, polygon, regular polygon, slot; and the polyline with rounded corners.
#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/analytic/line_arc_path.h"

namespace lekalo::geometry {

namespace {

std::vector<Vec3> placed(const Frame& frame, std::vector<Vec3> points) {
  for (Vec3& point : points) point = frame.point(point);
  return points;
}

}  // namespace

TypeDeclaration rectangle_type() {
  TypeDeclaration type = declare(Category::curve, "rectangle",
                                 "Rectangle in the x, y plane of its frame, counterclockwise from its lower left "
                                 "corner, with rounded corners or sharp ones.");
  type.example("size: [3, 2], corner_radius: 0.4")
      .field("frame", frame(), "placement: the center, the normal z and the direction x of the width", "{}")
      .field("size", numbers().count(2, 2).positive(), "width along x and height along y");
  return declare_corner_radii(type).built_by([](const Fields& f) {
    const double x = 0.5 * f.numbers("size")[0], y = 0.5 * f.numbers("size")[1];
    return rounded_polygon(f, placed(f.frame(), {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}));
  });
}

TypeDeclaration polygon_type() {
  TypeDeclaration type = declare(Category::curve, "polygon", "Closed polygon with rounded corners or sharp ones.");
  type.example("points: [[0, 0], [4, 0], [1, 3]], corner_radius: 0.3")
      .field("points", points().count(3), "corners in order, the first not repeated");
  return declare_corner_radii(type).shows({"control_polygon"}).built_by([](const Fields& f) {
    return rounded_polygon(f, f.points("points"));
  });
}

TypeDeclaration regular_polygon_type() {
  TypeDeclaration type = declare(Category::curve, "regular_polygon",
                                 "Regular polygon in the x, y plane of its frame, counterclockwise from the corner on "
                                 "the x axis, with rounded corners or sharp ones.");
  type.example("sides: 6, radius: 2")
      .field("frame", frame(), "placement: the center, the normal z and the direction x of the first corner", "{}")
      .field("sides", integer().between(3, 10000), "how many")
      .field("radius", length().positive(), "of the circle through the corners");
  return declare_corner_radii(type).built_by([](const Fields& f) {
    const int sides = f.integer("sides");
    std::vector<Vec3> corners;
    for (int i = 0; i < sides; ++i)
      corners.push_back(Affine::rotation(kTwoPi * i / sides, {0, 0, 1}).point({f.number("radius"), 0, 0}));
    return rounded_polygon(f, placed(f.frame(), std::move(corners)));
  });
}

TypeDeclaration slot_type() {
  return declare(Category::curve, "slot",
                 "Slot in the x, y plane of its frame: two sides along x and a half circle at each end, "
                 "counterclockwise from the beginning of the lower side.")
      .example("length: 3, width: 1")
      .field("frame", frame(), "placement: the center, the normal z and the direction x along the slot", "{}")
      .field("length", length().positive(), "between the centers of the half circles")
      .field("width", length().positive(), "between the sides")
      .built_by([](const Fields& f) {
        const Frame& at = f.frame();
        const double x = 0.5 * f.number("length"), r = 0.5 * f.number("width");
        LineArcPath path(at.point({-x, -r, 0}), r);
        path.line_to(at.point({x, -r, 0}));
        path.arc_to(at.point({x, 0, 0}), at.z, kPi, at.point({x, r, 0}));
        path.line_to(at.point({-x, r, 0}));
        path.arc_to(at.point({-x, 0, 0}), at.z, kPi, at.point({-x, -r, 0}));
        return path.curve(true);
      });
}

TypeDeclaration rounded_polyline_type() {
  return declare(Category::curve, "rounded_polyline",
                 "Straight sides through points of space, the corners between them rounded by arcs.")
      .example("points: [[0, 0, 0], [2, 0, 0], [2, 2, 0], [2, 2, 2]], corner_radius: 0.5")
      .field("points", points().count(2), "corners in order, the ends included")
      .field("corner_radius", length().non_negative(), "of the arcs at the inner corners", "0")
      .optional("corner_radii", numbers().at_least(0), "one radius for each inner corner instead, 0 for a sharp one")
      .built_by([](const Fields& f) {
        const std::vector<Vec3>& points = f.points("points");
        std::vector<double> radii = read_corner_radii(f, points.size() - 2);
        radii.insert(radii.begin(), 0.0);
        radii.push_back(0.0);
        return rounded_path(points, radii, false, f.has("corner_radii") ? "corner_radii" : "corner_radius");
      });
}

}  // namespace lekalo::geometry
