// From a camera ray to the light that it brings.
#pragma once

#include <any>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/ray.h"
#include "render/samplers/sampler.h"
#include "render/spectrum.h"

namespace lekalo::render {

class World;

// The light of a sample by where it comes from, for the layers of a picture that show it so. Colour is emission +
// diffuse + specular + transmission, and emission + direct + indirect, and the sum of all groups.
struct LightParts {
  static constexpr int kMaxGroups = 16;
  Spectrum emission;  // of what is seen: glowing things, lamps, the background
  Spectrum indirect;  // over two and more surfaces, or from a lamp seen in mirrors and clear bodies
  // By what the first surface did: matt lobes, other reflection, passed through.
  Spectrum diffuse, specular, transmission;
  std::array<Spectrum, kMaxGroups> groups;  // of lights (Model::light_groups); 0: all that is in none
};

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
  float quantity = 0;  // the number that the colour tells (Integrator::quantity); 0 where there is none
  int line = 0;        // tells the lines of the picture apart that the sample shows, however faint; 0: none
  uint64_t key = 0;    // identifies the tree of objects, shadows and texture cells behind this sample
  uint32_t shadow_rays = 0;                 // one that goes on behind a clear surface is another, as for POV-Ray
  uint32_t other_rays = 0;                  // reflected and refracted
  std::shared_ptr<const LightParts> parts;  // of Integrator::trace_parts
};

// What the colours of a picture tell, where they tell a number.
struct PictureScale {
  geometry::Interval range;    // of the first and last colour
  std::string colors;          // name of the scale of colours
  std::vector<double> levels;  // rising; within the range
  bool bands = false;          // one colour between two levels
  std::string title;           // plain words
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
  // Whether trace_parts() says where the light comes from; else the layers of LightParts are not to be had.
  virtual bool tells_parts() const { return false; }
  virtual RaySample trace_parts(const World& world, const Ray& ray, const Hit& first, SampleStream& random) const {
    return trace(world, ray, first, random);
  }
  // One that has looked at what the camera sees before the picture is begun; null: nothing is to be known.
  virtual std::shared_ptr<const Integrator> prepared(const World&) const { return nullptr; }
  // True if it asks for the parameters of hits, whatever the materials do.
  virtual bool uses_parameters() const { return false; }
  // Name of the number that samples bring beside their colour: a layer of the picture. Empty: there is none.
  virtual std::string quantity() const { return {}; }
  // Whether its colours tell a number; and how, of a prepared one.
  virtual bool has_scale() const { return false; }
  virtual std::optional<PictureScale> scale() const { return std::nullopt; }
  // What the user should know of the picture, a sentence each; of a prepared one.
  virtual std::vector<std::string> notes() const { return {}; }
  // The plain options that it was made from (ClassicOptions), for exporters; empty for other classes.
  virtual std::any made_from() const { return {}; }
};
using IntegratorPtr = std::shared_ptr<const Integrator>;

}  // namespace lekalo::render
