// A place where a ray meets surfaces: one, or several that lie on one another, as water and the glass that holds it do,
// or a block of glass and the table under it. What lies nearer to a surface than rays that leave it begin
// (World::leave) would never be met; so it is all taken at once, as one boundary, and the order in which rounding puts
// it is of no matter (docs/internals/light.md).
#pragma once

#include "render/integrators/media.h"
#include "render/materials/optical_constants.h"
#include "render/trace/world.h"

namespace lekalo::render {

// Of refraction where colours are not bent differently; of colours; and all of the light.
inline const Wavelengths kYellow{{kLineD, kLineD, kLineD, kLineD}};
inline const Wavelengths kPrimaries;
inline const Spectrum kWhite{1, 1, 1, 0};

class Boundary {
 public:
  // What the ray meets at the hit. `media`: around the ray's origin; a body that is left but was never entered is
  // added, for the ray has begun inside of it. Indices of refraction are those at the first of the wavelengths.
  Boundary(const World& world, const Ray& ray, const Hit& hit, const Wavelengths& wavelengths, Media& media)
      : point(world.surface_point(ray, hit)), front(glm::dot(ray.direction, point.geometric_normal) < 0) {
    show(world);
    if (!world.has_transmitting_materials()) return;
    const std::optional<Medium> medium = front_material_->interior(wavelengths);
    if (medium) {
      const bool was_entered = front || media.is_inside(point.instance);
      // What is left but was never entered may only be touched, at an edge.
      if ((!was_entered || world.may_be_in_contact(point)) && take_all(world, ray, hit, wavelengths, media)) return;
      if (!was_entered) media.enter(point.instance, *medium);
    }
    behind = media;
    if (!medium) return;
    front ? behind.enter(point.instance, *medium) : behind.leave(point.instance);
    changes_filling = (front ? behind : media).filling() == point.instance;
  }
  Boundary(const Boundary&) = delete;
  Boundary& operator=(const Boundary&) = delete;

  SurfacePoint point;                  // of the surface that shows
  bool front;                          // it shows its front
  const Material* material = nullptr;  // of the side that shows
  Media behind;                        // around what goes on straight
  // False for a surface inside of a substance that fills both its sides: none for light.
  bool changes_filling = true;

  // Both on the side from which it was met: of the surface or facet; and after bumps, for a ray of that direction.
  Vec3 geometric_normal() const { return front ? point.geometric_normal : -point.geometric_normal; }
  Vec3 shading_normal(const Vec3& direction) const;

  // The points that rays leave to the side from which the boundary was met, and to the other one.
  const SurfacePoint& near_side() const { return others_ ? others_->first : point; }
  const SurfacePoint& far_side() const { return others_ ? others_->second : point; }

 private:
  void show(const World& world) {
    front_material_ = &world.material(point, true);
    material = front ? front_material_ : &world.material(point, false);
  }
  // False, and nothing done, if the ray crosses just the one surface here.
  bool take_all(const World& world, const Ray& ray, const Hit& hit, const Wavelengths& wavelengths, Media& media);

  const Material* front_material_ = nullptr;
  std::optional<std::pair<SurfacePoint, SurfacePoint>> others_;  // where there are several: the first and the last
};

// What shows behind everything in a direction: a panorama, or the background.
Spectrum backdrop(const World& world, const Ray& ray);

// The media that a ray begins in: of the bodies that it leaves before it enters them, the one left last entered first.
// What it crosses both ways at an edge is neither left nor entered there.
Media media_at_origin(const World& world, const Ray& ray, const Wavelengths& wavelengths);

}  // namespace lekalo::render
