#include "render/model/mesh_tolerance.h"

#include <algorithm>

#include "geometry/curves/analytic/polyline.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Largest turn of the normal along a side of a triangle, whatever the sag: shading takes the surface's own normals, so
// this only keeps shapes of some pixels round and the way from a facet to its surface short enough for one step.
constexpr double kMeshAngle = 10 * kPi / 180;

}  // namespace

TessellationTolerance mesh_tolerance(const Object& object, const Affine& to_world, const CameraPtr& camera) {
  TessellationTolerance tolerance;
  const bool is_curve = std::holds_alternative<CurvePtr>(object.shape);
  tolerance.angle = object.mesh_angle > 0 ? object.mesh_angle : is_curve ? kPi : kMeshAngle;
  const Mat3& a = to_world.linear;
  const double scale = std::max({glm::length(a[0]), glm::length(a[1]), glm::length(a[2]), 1e-300});
  if (object.sag > 0) {
    tolerance.sag = object.sag / scale;
  } else if (camera) {
    const double pixels = object.sag_pixels;
    tolerance.sag_at = [camera, to_world, pixels, scale](const Vec3& p) {
      return pixels * camera->pixel_size(to_world.point(p)) / scale;
    };
  } else {
    tolerance.sag = 1e-3 * bounds(object.shape).diameter();
  }
  return tolerance;
}

CurvePtr polygon_of(const Curve& curve, const TessellationTolerance& tolerance) {
  std::vector<Vec3> points;
  for (const double t : polygon_parameters(curve, tolerance))
    if (const Vec3 p = curve.point(t); points.empty() || p != points.back()) points.push_back(p);
  const bool closed = curve.is_closed() && points.size() > 3;
  if (closed) points.pop_back();
  return std::make_shared<NurbsCurve>(polyline(points, closed));
}

}  // namespace lekalo::render
