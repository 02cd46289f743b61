// Sources of light.
//
// Radiometry. A light's `intensity` I is the I_p of Golovanov 2016, 8.4: a white matt surface facing the light shows
// the radiance I. Lambert's surface of albedo k_d under the irradiance E shows k_d E / pi, so the irradiance that the
// light gives at right angles is E = pi I: the same everywhere (decay none, the classic model's point light), or at
// unit distance (decay inverse_square: E = pi I / d^2). The Phong lobe adds k_s cos(alpha)^n E / pi. Ambient light of
// intensity I_a is the radiance I_a from all sides; a surface shows k_a I_a of it.
#pragma once

#include <any>
#include <memory>
#include <optional>
#include <string>

#include "render/samplers/sampler.h"
#include "render/spectrum.h"

namespace lekalo::render {

// One sample of a light as seen from a point.
struct LightSample {
  Vec3 direction{0, 0, 1};                // unit, from the point towards the light
  double distance = geometry::kInfinity;  // to the sampled place on the light
  Spectrum irradiance;  // E on a surface facing the sample if nothing is in the way, as if all the light came from it
  double weight = 1;    // of this sample among those of the light; sums to 1 over all samples
  // Per unit of solid angle, of sample_all(): the radiance that comes from there is irradiance times density. 0 for
  // light from a single direction.
  double density = 0;
};

// The light of a source that fills a round cone of directions evenly, as a matt surface receives it. If nothing is in
// the way it is known without the noise of samples; and of samples that stand as close as the surface takes their light
// in each brings the same, so that there is no noise in full shadow either.
struct ConeLight {
  Vec3 axis{0, 0, 1};                     // unit, towards the middle of the source
  double sine = 0;                        // of half its opening, which is less than pi
  Spectrum irradiance;                    // of LightSample, the same for all directions of the cone
  double distance = geometry::kInfinity;  // of the middle of the ball that the source is
  int parts = 1;                          // n of the n x n samples to take

  // Mean over the cone of max(0, cosine of the angle from the normal), the angle between axis and normal having the
  // given cosine (Snyder, "Area light sources for real-time graphics", 1996).
  double mean_cosine(double axis_cosine) const;
  // Direction of sample `index` of n x n, random in its part of the cone, of a density as the cosine of the angle from
  // the normal. mean_cosine() must not be 0.
  //
  // Cosine times solid angle is area of the projection to the surface's plane (Nusselt). That of a cone above the
  // horizon is an ellipse. Of one that the horizon cuts it lies between two circles and two radii about the normal,
  // and places among these that are not in it are drawn anew.
  Vec3 direction(const Vec3& normal, int index, SampleStream& random) const;
  // To the source, from the point that sees it, along one of its directions.
  double distance_along(const Vec3& direction) const;
};

class Light {
 public:
  virtual ~Light() = default;
  // Radiance that reaches every point from everywhere (I_a); the other lights return none.
  virtual Spectrum ambient() const { return {}; }
  // Number of samples to take at a point; 1 for point and spot lights, 0 for ambient ones.
  virtual int sample_count() const { return 1; }
  // Sample `index` of sample_count() at the point; (r1, r2) in [0, 1)^2 jitters it within its stratum and is not used
  // where `sampling: grid` asks for fixed places.
  virtual LightSample sample(const Vec3& point, int index, double r1, double r2) const = 0;
  // One place of the whole light, with `square` uniform in the unit square; whatever `sampling` says.
  virtual LightSample sample_all(const Vec3& point, const Vec2&) const { return sample(point, 0, 0.5, 0.5); }
  // What sample_all() says of the place of the light that lies in the direction from the point; nothing if none does.
  virtual std::optional<LightSample> towards(const Vec3&, const Vec3& /*direction*/) const { return std::nullopt; }
  // True if it is seen under more than a point, so that towards() may find it.
  virtual bool has_size() const { return false; }
  // True for surroundings that show themselves in place of the background.
  virtual bool is_backdrop() const { return false; }
  // True if r1 and r2 matter.
  virtual bool is_jittered() const { return false; }
  // What the source is from the point, for jittered sources that are a cone of directions.
  virtual std::optional<ConeLight> cone(const Vec3&) const { return std::nullopt; }
  // A box around the places of all samples; without bounds where there is none.
  virtual geometry::Box3 places() const { return geometry::Box3::everything(); }
  virtual bool casts_shadows() const { return true; }
  // The plain value of lights.h that it was made from, for exporters; empty for other classes.
  virtual std::any made_from() const { return {}; }
  // The group of lights whose layer shows its light; empty: none.
  const std::string& group() const { return group_; }
  void set_group(const std::string& name) { group_ = name; }

 private:
  std::string group_;
};
using LightPtr = std::shared_ptr<const Light>;

}  // namespace lekalo::render
