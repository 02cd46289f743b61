#include "render/drawing/annotations/light_path.h"

#include "render/integrators/boundary.h"
#include "render/integrators/classic_reading.h"
#include "render/integrators/phong_model.h"

namespace lekalo::render {

std::vector<Vec3> light_path(const World& world, const LightPath& path) {
  std::vector<Vec3> corners{path.from};
  const float nm = static_cast<float>(path.wavelength);
  const Wavelengths wavelengths{{nm, nm, nm, nm}};
  Ray ray;
  ray.origin = path.from, ray.direction = path.direction;
  Media media = media_at_origin(world, ray, wavelengths);
  Hit hit;
  for (int met = 0; world.nearest(ray, hit); ++met) {
    const Boundary at(world, ray, hit, wavelengths, media);
    corners.push_back(at.point.position);
    if (met >= path.bounces) return corners;
    const Vec3 normal = at.front ? at.point.geometric_normal : -at.point.geometric_normal;
    Vec3 next = ray.direction;
    bool reflects = false;
    if (!at.changes_filling) {
      media = at.behind;  // no boundary for light: another substance fills both sides
      corners.pop_back();
    } else if (at.material->transmits()) {
      const auto inward = refracted(ray.direction, normal, media.current().index, at.behind.current().index);
      reflects = !inward || path.reflection;
      if (!reflects) {
        next = *inward;
        media = at.behind;
      }
    } else if (!classic_reading(*at.material, at.point, wavelengths).mirror.is_zero()) {
      reflects = true;
    } else {
      return corners;
    }
    if (reflects) next = reflected(ray.direction, normal);
    world.leave(reflects ? at.near_side() : at.far_side(), next, ray);
    ray.direction = next;
  }
  corners.push_back(corners.back() + path.length * ray.direction);
  return corners;
}

}  // namespace lekalo::render
