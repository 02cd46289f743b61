// Box and wedge (Golovanov 2016, 5.6).
//
// Surfaces of a box with the corner p: u x + v y (z_min), u y + v z (x_min), u x + v z (y_min) and the same moved by
// the opposite lengths; the normals of z_max, x_max and y_min look outward, the others inward. Edges run along the
// positive axes.
#include <stdexcept>

#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/primitives/primitives.h"

namespace lekalo::geometry {

namespace {

// Corner 4 i + 2 j + k of a box stands at x = i, y = j, z = k.
Body hexahedron(const Frame& frame, const std::array<Vec3, 8>& local, bool ridge) {
  std::vector<Vec3> points;
  for (const Vec3& p : local) points.push_back(frame.point(p));
  const Frame xy{points[0], frame.x, frame.y, frame.z}, yz{points[0], frame.y, frame.z, frame.x},
      xz{points[0], frame.x, frame.z, -frame.y};
  Frame top = xy, back = xz;
  top.origin = points[1];
  back.origin = points[2];
  Frame right = yz;
  right.origin = points[4];
  const bool upright = local[4].x == local[5].x;
  if (ridge) {
    // The top corners at x_min and x_max are one.
    const std::vector<Vec3> corners{points[0], points[1], points[2], points[3], points[4], points[6]};
    return polyhedron(corners, {{{0, 1, 3, 2}, {"", "x_min"}, &yz},
                                {{4, 5, 3, 1}, {"", "x_max"}},
                                {{0, 4, 1}, {"", "y_min"}, &xz},
                                {{2, 3, 5}, {"", "y_max"}, &back},
                                {{0, 2, 5, 4}, {"", "z_min"}, &xy}});
  }
  return polyhedron(points, {{{0, 1, 3, 2}, {"", "x_min"}, &yz},
                             {{4, 6, 7, 5}, {"", "x_max"}, upright ? &right : nullptr},
                             {{0, 4, 5, 1}, {"", "y_min"}, &xz},
                             {{2, 3, 7, 6}, {"", "y_max"}, &back},
                             {{0, 2, 6, 4}, {"", "z_min"}, &xy},
                             {{1, 5, 7, 3}, {"", "z_max"}, &top}});
}

void require_size(const Vec3& size) {
  if (!(size.x > 0 && size.y > 0 && size.z > 0)) throw std::invalid_argument("all three sizes must be positive");
}

Vec3 positive_size(const Fields& f) {
  const Vec3 size = f.vec3("size");
  if (!(size.x > 0 && size.y > 0 && size.z > 0)) throw FieldError("size", "all three sizes must be positive");
  return size;
}

// The corner of least coordinates.
Frame placed_corner(const Fields& f, const Vec3& size) {
  if (f.has("corner") && f.has("center")) throw FieldError("center", "a box has a corner or a center, not both");
  Frame frame;
  if (f.has("corner")) frame.origin = f.vec3("corner");
  if (f.has("center")) frame.origin = f.vec3("center") - 0.5 * size;
  return frame;
}

}  // namespace

Body box(const Frame& frame, const Vec3& size) {
  require_size(size);
  std::array<Vec3, 8> corners;
  for (int c = 0; c < 8; ++c) corners[c] = {c & 4 ? size.x : 0, c & 2 ? size.y : 0, c & 1 ? size.z : 0};
  return hexahedron(frame, corners, false);
}

Body wedge(const Frame& frame, const Vec3& size, double top) {
  require_size(size);
  if (!(top >= 0)) throw std::invalid_argument("the length of the top must not be negative");
  std::array<Vec3, 8> corners;
  for (int c = 0; c < 8; ++c) corners[c] = {c & 4 ? (c & 1 ? top : size.x) : 0, c & 2 ? size.y : 0, c & 1 ? size.z : 0};
  return hexahedron(frame, corners, top == 0);
}

TypeDeclaration box_type() {
  return declare(Category::body, "box", "Box along the axes. Faces: x_min, x_max, y_min, y_max, z_min, z_max.")
      .example("size: [3, 2, 1]")
      .field("size", vector(), "lengths along x, y and z")
      .optional("corner", point(), "corner with the least coordinates; the origin when center is not given either")
      .optional("center", point(), "center, in place of corner")
      .built_by([](const Fields& f) -> BodyPtr {
        const Vec3 size = positive_size(f);
        return std::make_shared<Body>(box(placed_corner(f, size), size));
      });
}

TypeDeclaration wedge_type() {
  return declare(Category::body, "wedge",
                 "Box with a shortened top: its face x_max leans towards x_min. Faces as a box; without a top length "
                 "there is a ridge and no z_max.")
      .example("size: [3, 2, 1], top: 1")
      .field("size", vector(), "lengths along x (of the bottom), y and z")
      .field("top", length().non_negative(), "length of the top along x; 0 makes a ridge over x_min", "0")
      .optional("corner", point(), "corner with the least coordinates; the origin when center is not given either")
      .optional("center", point(), "center of the surrounding box, in place of corner")
      .built_by([](const Fields& f) -> BodyPtr {
        const Vec3 size = positive_size(f);
        return std::make_shared<Body>(wedge(placed_corner(f, size), size, f.number("top")));
      });
}

}  // namespace lekalo::geometry
