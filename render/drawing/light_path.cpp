#include "render/drawing/light_path.h"

#include "render/integrators/classic_model.h"
#include "render/integrators/media.h"

namespace lekalo::render {

std::vector<Vec3> light_path(const World& world, const LightPath& path) {
  std::vector<Vec3> corners{path.from};
  const float nm = static_cast<float>(path.wavelength);
  const Wavelengths wavelengths{{nm, nm, nm, nm}};
  Media media;
  Ray ray;
  ray.origin = path.from, ray.direction = path.direction;
  Hit hit;
  for (int met = 0; world.nearest(ray, hit); ++met) {
    const SurfacePoint at = world.surface_point(ray, hit);
    corners.push_back(at.position);
    if (met >= path.bounces) return corners;
    const bool front = glm::dot(ray.direction, at.geometric_normal) < 0;
    const Vec3 normal = front ? at.geometric_normal : -at.geometric_normal;
    const Material& material = world.material(at, front);
    const auto medium = world.material(at, true).interior(wavelengths);
    if (medium && !front && !media.is_inside(at.instance)) media.enter(at.instance, *medium);
    Media behind = media;
    if (medium) front ? behind.enter(at.instance, *medium) : behind.leave(at.instance);
    const ClassicCoefficients c = material.classic(at, wavelengths);
    Vec3 next = ray.direction;
    if (medium && (front ? behind : media).filling() == at.instance) {
      const auto inward = refracted(ray.direction, normal, media.current().index, behind.current().index);
      if (inward && !path.reflection) {
        next = *inward;
        media = behind;
      } else {
        next = reflected(ray.direction, normal);
      }
    } else if (medium) {
      media = behind;  // no boundary for light: another substance fills both sides
      corners.pop_back();
    } else if (!c.mirror.is_zero()) {
      next = reflected(ray.direction, normal);
    } else {
      return corners;
    }
    world.leave(at, next, ray);
    ray.direction = next;
  }
  corners.push_back(corners.back() + path.length * ray.direction);
  return corners;
}

}  // namespace lekalo::render
