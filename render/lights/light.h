// Sources of light.
#pragma once

#include <memory>

#include "render/spectrum.h"

namespace lekalo::render {

// One sample of a light as seen from a point.
struct LightSample {
  Vec3 direction{0, 0, 1};                // unit, from the point towards the light
  double distance = geometry::kInfinity;  // to the sampled place on the light
  Spectrum radiance;                      // what arrives at the point, per unit cosine, if nothing is in the way
  double weight = 1;                      // of this sample among those of the light; sums to 1 over all samples
};

class Light {
 public:
  virtual ~Light() = default;
  // Light that reaches every point from everywhere (I_a); the other lights return none.
  virtual Spectrum ambient() const { return {}; }
  // Number of samples to take at a point; 1 for point, spot and distant lights, 0 for ambient ones.
  virtual int sample_count() const { return 1; }
  // Sample `index` of sample_count() at the point; (r1, r2) in [0, 1)^2 jitters it within its stratum and is not used
  // where `sampling: grid` asks for fixed places.
  virtual LightSample sample(const Vec3& point, int index, double r1, double r2) const = 0;
  virtual bool casts_shadows() const { return true; }
};
using LightPtr = std::shared_ptr<const Light>;

}  // namespace lekalo::render
