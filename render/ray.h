// Rays and hits in double precision.
#pragma once

#include <cstdint>

#include "geometry/surface.h"
#include "render/spectrum.h"

namespace lekalo::geometry {
struct SurfaceCurvature;
}

namespace lekalo::render {

// Which rays see an object (`visible_to` of scene files).
enum class RayKind : uint32_t { camera = 1, shadow = 2, reflection = 4 };  // reflection: also refracted rays
inline constexpr uint32_t kVisibleToAll = 7;

// A line with a unit direction, so that t is a distance, and a range of t.
struct Ray : geometry::Line {
  double t_min = 0;
  double t_max = geometry::kInfinity;
  // The piece of a face that the ray left; instance -1: none. `left_for_good`: to a side from which it does not meet
  // any of the face again (Surface::convex_sides).
  int64_t left_instance = -1;
  RayKind kind = RayKind::camera;
  int32_t left_face = 0;
  int32_t left_piece = 0;
  bool left_for_good = false;
};

// What a ray meets. `instance` numbers the copy of the object that was hit, in the World's order of compilation: groups
// in groups make more copies than 32 bits can tell apart.
struct Hit {
  double t = 0;
  double u = 0;  // natural parameters of the surface; of a mesh the interpolated ones
  double v = 0;
  int64_t instance = -1;
  int32_t face = 0;
  int32_t piece = 0;
  // A triangle's barycentric weights of its second and third vertex; unused by direct hits.
  double b = 0;
  double c = 0;
};

struct SurfacePoint;

// Who can tell how the surface of a point curves: the World.
class CurvatureSource {
 public:
  // Signed by point.normal, in world space; not regular where nothing is known.
  virtual geometry::SurfaceCurvature curvature(const SurfacePoint& point) const = 0;

 protected:
  ~CurvatureSource() = default;
};

// The differential geometry and identity of a hit, in world space.
struct SurfacePoint {
  Vec3 position{0};
  Vec3 smooth_position{0};         // of meshes: on the smooth surface that the normals describe, for rays that leave it
  Vec3 incoming{0};                // unit direction of the ray that met the point
  Vec3 geometric_normal{0, 0, 1};  // outward (or r_u x r_v) unit normal of what was really hit: a facet for meshes
  Vec3 normal{0, 0, 1};            // unit shading normal on the same side
  Vec3 du{0};
  Vec3 dv{0};
  double u = 0;
  double v = 0;
  double error = 0;       // bound on the distance of `position` from the surface that was hit
  double pixel_size = 0;  // width of a pixel at this distance in scene units; 0 where not known
  int64_t instance = -1;
  int32_t object = 0;  // number in the Model's objects, those of groups counted where they stand
  int32_t face = 0;
  int32_t piece = 0;
  geometry::Sides convex_sides;  // of the face that was hit; front is where geometric_normal points to
  const CurvatureSource* curvature_source = nullptr;  // where pixel_size is known
};

}  // namespace lekalo::render
