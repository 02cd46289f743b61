#include "geometry/shapes/csg/half_space.h"

#include <algorithm>
#include <cmath>

#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

// Planes whose normals are this near to one plane have no corner. Of the corners that others have, those this far
// outside, of their own distance from the frames, are inside but for rounding.
constexpr double kNoCorner = 1e-12;
constexpr double kOutside = 1e-9;
// More are not asked for what they have in common: the time grows with the fourth power.
constexpr size_t kMaxHalfSpaces = 32;

}  // namespace

Box3 HalfSpaceShape::bounds() const {
  const Frame& frame = plane_.frame();
  Box3 box = Box3::everything();
  for (int k = 0; k < 3; ++k)
    if (std::abs(frame.z[k]) == 1) (frame.z[k] > 0 ? box.hi : box.lo)[k] = frame.origin[k];
  return box;
}

// What is common to half-spaces is the hull of its corners if it is bounded; it is not if there is a direction along
// which one leaves none of them, and then there is one along which two of the planes meet. (Ziegler 1995, 1.)
Box3 bounds_of_common(std::span<const Frame> planes) {
  const size_t count = planes.size();
  if (count < 4 || count > kMaxHalfSpaces) return Box3::everything();
  Box3 box;
  double far = 0;
  for (size_t i = 0; i < count; ++i)
    for (size_t j = 0; j < i; ++j) {
      const Vec3 edge = glm::cross(planes[i].z, planes[j].z);
      for (const double side : {-1.0, 1.0}) {
        const auto stays = [&](const Frame& plane) { return side * glm::dot(plane.z, edge) <= kNoCorner; };
        if (std::all_of(planes.begin(), planes.end(), stays) && glm::length(edge) > kNoCorner)
          return Box3::everything();
      }
      for (size_t k = 0; k < j; ++k) {
        const double volume = glm::dot(edge, planes[k].z);
        if (std::abs(volume) <= kNoCorner) continue;
        // About a point of one of the planes: its own coordinates are the least that matter.
        const Vec3 from = planes[k].origin;
        const double a = glm::dot(planes[i].z, planes[i].origin - from),
                     b = glm::dot(planes[j].z, planes[j].origin - from);
        const Vec3 off = (a * glm::cross(planes[j].z, planes[k].z) + b * glm::cross(planes[k].z, planes[i].z)) / volume;
        const Vec3 corner = from + off;
        const double slack = kOutside * (glm::length(off) + glm::length(from));
        const auto holds = [&](const Frame& plane) { return glm::dot(plane.z, corner - plane.origin) <= slack; };
        if (!std::all_of(planes.begin(), planes.end(), holds)) continue;
        box.include(corner);
        far = std::max(far, glm::length(off) + glm::length(from));
      }
    }
  return box.empty() ? Box3::everything() : box.inflated(kOutside * far);
}

void HalfSpaceShape::all_hits(const Line& line, const Interval& t, std::vector<SurfaceHit>& hits) const {
  LineHits found;
  plane_.line_hits(line, t, found);
  if (found.size() > 0) hits.push_back({found[0].t, found[0].u, found[0].v, 0, 0});
}

ShapePoint HalfSpaceShape::point(const SurfaceHit& hit, const Vec3& near) const {
  const Frame& frame = plane_.frame();
  return {plane_.foot_point(near).point, frame.z, frame.x, frame.y, hit.u, hit.v};
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
