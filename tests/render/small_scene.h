// Scenes of a few spheres and planes for tests of shading, without scene files.
#pragma once

#include <memory>

#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "render/cameras/cameras.h"
#include "render/integrators/classic.h"
#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "render/materials/textures.h"
#include "render/trace/world.h"

namespace lekalo::render {

inline geometry::SurfacePtr sphere(const Vec3& center, double radius) {
  geometry::Frame frame;
  frame.origin = center;
  return std::make_shared<geometry::SphereSurface>(frame, radius);
}

inline geometry::SurfacePtr plane(const Vec3& through, const Vec3& normal) {
  return std::make_shared<geometry::Plane>(geometry::frame_about(through, glm::normalize(normal)));
}

// The part of the plane where frame x and y lie in the ranges.
inline geometry::SurfacePtr plane_part(const geometry::Frame& frame, const geometry::Interval& x,
                                       const geometry::Interval& y) {
  return std::make_shared<geometry::Plane>(frame, geometry::Rectangle{x, y});
}

// Both faces of the slab z0 <= z <= z1, as one object.
inline SurfaceSet slab(double z0, double z1) { return {plane({0, 0, z1}, {0, 0, 1}), plane({0, 0, z0}, {0, 0, -1})}; }

struct SmallScene {
  Model model;
  ClassicOptions options;

  SmallScene() { model.background = Spectrum(); }
  SmallScene& add(Entity shape, MaterialPtr material) {
    Object object;
    object.shape = std::move(shape);
    object.material = std::move(material);
    model.objects.push_back(object);
    return *this;
  }
  template <class LightValues>
  SmallScene& light(const LightValues& values) {
    model.lights.push_back(make_light(values));
    return *this;
  }
  std::shared_ptr<const World> world() const {
    auto finished = std::make_shared<Model>(model);
    finished->integrator = make_classic_integrator(options);
    return std::make_shared<World>(finished);
  }
};

// Every random number of the sample is that of pixel (0, 0).
inline RaySample trace(const World& world, const Vec3& origin, const Vec3& direction) {
  Ray ray;
  ray.origin = origin;
  ray.direction = glm::normalize(direction);
  SampleStream random(0, 0, 0, 1, 0);
  Hit first;
  if (!world.nearest(ray, first)) first.instance = -1;
  return world.model().integrator->trace(world, ray, first, random);
}

// Shows a coordinate of the place that is seen, so that a test can read where a ray went.
class CoordinateTexture final : public Texture {
 public:
  explicit CoordinateTexture(const Vec3& direction) : direction_(direction) {}
  Spectrum at(const SurfacePoint& point) const override {
    return Spectrum(static_cast<float>(glm::dot(point.position, direction_)));
  }

 private:
  Vec3 direction_;
};

inline MaterialPtr coordinate_screen(const Vec3& direction) {
  Emission emission;
  emission.color = TexturePtr(std::make_shared<CoordinateTexture>(direction));
  return make_material(emission);
}

}  // namespace lekalo::render
