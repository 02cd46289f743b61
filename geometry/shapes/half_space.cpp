#include "geometry/shapes/half_space.h"

#include "geometry/describe.h"

namespace lekalo::geometry {

void HalfSpaceShape::all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const {
  LineHits found;
  plane_.line_hits(line, t, found);
  if (found.size() > 0) hits.push_back({found[0].t, found[0].u, found[0].v, 0, 0});
}

ShapePoint HalfSpaceShape::point(const SurfaceHit& hit, const Vec3& near) const {
  const Frame& frame = plane_.frame();
  return {plane_.foot(near).point, frame.z, frame.x, frame.y, hit.u, hit.v};
}

// A line that is met comes from the side that its direction leaves; one that is not lies on one side.
bool HalfSpaceShape::begins_inside(const Line& line) const {
  const Vec3& normal = plane_.frame().z;
  LineHits found;
  plane_.line_hits(line, Interval::entire(), found);
  if (found.size() > 0) return glm::dot(line.direction, normal) > 0;
  return glm::dot(line.origin - plane_.frame().origin, normal) < 0;
}

TypeDeclaration half_space_type() {
  return declare(Category::shape, "half_space",
                 "All of space on one side of a plane: the side that the normal looks away from. To cut shapes with "
                 "(intersection, difference), or as water to the horizon.")
      .field("through", point(), "a point of the plane", "[0, 0, 0]")
      .field("normal", direction(), "of the plane, out of the half-space", "z")
      .built_by([](const Fields& f) -> ShapePtr {
        return std::make_shared<HalfSpaceShape>(f.vec3("through"), f.vec3("normal"));
      });
}

}  // namespace lekalo::geometry
