// Prisms and pyramids over a polygon.
#include <cmath>
#include <stdexcept>

#include "geometry/bodies/primitives/construct.h"
#include "geometry/bodies/primitives/primitives.h"

namespace lekalo::geometry {

namespace {

// Points 0..n-1 below, n..2n-1 above.
Body between_polygons(const std::vector<Vec3>& points) {
  const int n = static_cast<int>(points.size()) / 2;
  std::vector<PolygonFace> faces(2);
  faces[0].origin = {"", "start"};
  faces[1].origin = {"", "end"};
  for (int k = 0; k < n; ++k) {
    faces[0].corners.push_back(n - 1 - k);
    faces[1].corners.push_back(n + k);
    const int next = (k + 1) % n;
    faces.push_back({{k, next, n + next, n + k}, {"", "side", k}});
  }
  return polyhedron(points, faces);
}

}  // namespace

Body prism(const Frame& frame, const std::vector<Vec2>& base, double height) {
  if (base.size() < 3) throw std::invalid_argument("a prism needs at least three corners");
  if (!(height > 0)) throw std::invalid_argument("the height must be positive");
  std::vector<Vec3> points;
  for (double z : {0.0, height})
    for (const Vec2& p : base) points.push_back(frame.point({p.x, p.y, z}));
  return between_polygons(points);
}

Body pyramid(const Frame& frame, const std::vector<Vec2>& base, const Vec3& apex, double top) {
  if (base.size() < 3) throw std::invalid_argument("a pyramid needs at least three corners");
  if (!(apex.z > 0)) throw std::invalid_argument("the apex must lie above the base");
  if (!(top >= 0 && top < 1)) throw std::invalid_argument("the top must be at least 0 and less than 1");
  std::vector<Vec3> points;
  for (const Vec2& p : base) points.push_back(frame.point({p.x, p.y, 0}));
  const int n = static_cast<int>(base.size());
  if (top > 0) {
    for (const Vec2& p : base) points.push_back(frame.point(apex + top * (Vec3(p, 0) - apex)));
    return between_polygons(points);
  }
  points.push_back(frame.point(apex));
  std::vector<PolygonFace> faces(1);
  faces[0].origin = {"", "start"};
  for (int k = 0; k < n; ++k) {
    faces[0].corners.push_back(n - 1 - k);
    faces.push_back({{k, (k + 1) % n, n}, {"", "side", k}});
  }
  return polyhedron(points, faces);
}

TypeDeclaration prism_type() {
  TypeDeclaration type =
      declare(Category::body, "prism", "Upright prism over a regular or any other polygon. Faces: start, end, side.k.")
          .example("sides: 6, radius: 1, height: 2");
  declare_base(type);
  type.field("height", length().positive(), "distance of the ends along z").built_by([](const Fields& f) -> BodyPtr {
    return std::make_shared<Body>(prism(f.frame(), base_polygon(f), f.number("height")));
  });
  return type;
}

TypeDeclaration pyramid_type() {
  TypeDeclaration type = declare(Category::body, "pyramid",
                                 "Pyramid over a regular or any other polygon, or its part below a plane parallel to "
                                 "the base. Faces: start (the base), side.k, end (the top of a frustum).")
                             .example("sides: 4, radius: 1, height: 2");
  declare_base(type);
  type.optional("height", length().positive(), "height of the apex above the frame's origin")
      .optional("apex", point(), "the apex as a point, in place of height")
      .field("top_scale", number().between(0, 0.999999),
             "cut parallel to the base where the section is this many times the base; 0: up to the apex", "0")
      .built_by([](const Fields& f) -> BodyPtr {
        const Frame frame = f.frame();
        if (f.has("apex") == f.has("height"))
          throw FieldError("height", f.has("apex") ? "height and apex are both given" : "the height is missing",
                           "give height, or apex: [x, y, z]");
        const Vec3 apex = f.has("apex") ? frame.to_local_point(f.vec3("apex")) : Vec3(0, 0, f.number("height"));
        if (!(apex.z > 0)) throw FieldError("apex", "the apex must lie above the base, on the side of the frame's z");
        return std::make_shared<Body>(pyramid(frame, base_polygon(f), apex, f.number("top_scale")));
      });
  return type;
}

}  // namespace lekalo::geometry
