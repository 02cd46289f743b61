// From a camera ray to the light that it brings.
#pragma once

#include <any>
#include <memory>
#include <optional>

#include "render/ray.h"
#include "render/samplers/sampler.h"
#include "render/spectrum.h"

namespace lekalo::render {

class World;

// What one camera ray brings to the film.
struct RaySample {
  // Not a constant: compilers would copy the zeros of one over all of it, for every ray.
  RaySample() {}

  Spectrum radiance;
  float alpha = 0;                    // 0 where nothing was hit
  std::optional<SurfacePoint> point;  // first hit
  double depth = 0;                   // distance along the ray to it
  Spectrum direct;     // light of sources (ambient ones too) on the first hit, without reflections and refractions
  bool noisy = false;  // another sample of the same place might have shown another colour: a penumbra
  int line = 0;        // tells the lines of the picture apart that the sample shows, however faint; 0: none
  uint64_t key = 0;    // identifies the tree of objects, shadows and texture cells behind this sample
  uint32_t shadow_rays = 0;  // one that goes on behind a clear surface is another, as for POV-Ray
  uint32_t other_rays = 0;   // reflected and refracted
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  // `first`: what the ray meets (World::nearest of many rays), instance -1 for nothing.
  virtual RaySample trace(const World& world, const Ray& ray, const Hit& first, SampleStream& random) const = 0;
  // The same for who asks for colours and counts alone: `point`, `depth` and `key` may be left out.
  virtual RaySample trace_color(const World& world, const Ray& ray, const Hit& first, SampleStream& random) const {
    return trace(world, ray, first, random);
  }
  // The plain options that it was made from (ClassicOptions), for exporters; empty for other classes.
  virtual std::any made_from() const { return {}; }
};
using IntegratorPtr = std::shared_ptr<const Integrator>;

}  // namespace lekalo::render
