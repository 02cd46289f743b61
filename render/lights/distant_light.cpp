// Light from infinitely far away, evenly from a disc of the sky: the sun (0.53 degrees), or a soft box of any scale.
#include <cmath>

#include "render/lights/lights.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class DistantLamp final : public SpectralLight {
 public:
  explicit DistantLamp(const DistantLight& light)
      : SpectralLight(light.lamp),
        light_(light),
        frame_(frame_about(Vec3(0), -light.direction)),
        sine_(std::sin(0.5 * light.angular_diameter)),
        one_minus_cosine_(1 - std::cos(0.5 * light.angular_diameter)),
        irradiance_(RoundIrradiance(light.lamp, light.sampling).at(1, one_minus_cosine_)),
        whole_(RoundIrradiance(light.lamp, {}).at(1, one_minus_cosine_)) {}

  int sample_count() const override { return light_.angular_diameter > 0 ? light_.sampling.n * light_.sampling.n : 1; }

  LightSample sample(const Vec3&, int index, double r1, double r2) const override {
    const int count = sample_count();
    LightSample sample{frame_.z, kInfinity, irradiance_, 1.0 / count};
    if (light_.angular_diameter > 0) sample.direction = direction(area_sample(light_.sampling, index, r1, r2));
    return sample;
  }
  LightSample sample_all(const Vec3&, const Vec2& square) const override {
    if (light_.angular_diameter == 0) return {frame_.z, kInfinity, whole_};
    return {direction(square), kInfinity, whole_, 1, 1 / (kTwoPi * one_minus_cosine_)};
  }
  std::optional<LightSample> towards(const Vec3&, const Vec3& direction) const override {
    if (light_.angular_diameter == 0 || 1 - glm::dot(direction, frame_.z) > one_minus_cosine_) return std::nullopt;
    return LightSample{direction, kInfinity, whole_, 1, 1 / (kTwoPi * one_minus_cosine_)};
  }
  bool has_size() const override { return light_.angular_diameter > 0; }
  bool is_jittered() const override { return light_.angular_diameter > 0 && !light_.sampling.grid; }
  std::optional<ConeLight> cone(const Vec3&) const override {
    if (!is_jittered()) return std::nullopt;
    return ConeLight{frame_.z, sine_, irradiance_, kInfinity, light_.sampling.n};
  }
  bool casts_shadows() const override { return light_.lamp.shadows; }
  std::any made_from() const override { return light_; }

 private:
  // Equal areas of the disc are equal solid angles when 1 - cos grows with the square of the disc's radius.
  Vec3 direction(const Vec2& place) const {
    const Vec2 disc = concentric_disc(place);
    const double square = glm::dot(disc, disc);
    const double height = square * one_minus_cosine_;  // 1 - cos of the angle from the axis
    const double scale = std::sqrt(one_minus_cosine_ * (2 - height));
    return frame_.direction(Vec3(disc * scale, 1 - height));
  }

  DistantLight light_;
  Frame frame_;
  double sine_, one_minus_cosine_;  // of half the angular diameter
  Spectrum irradiance_;             // of each sample
  Spectrum whole_;                  // of a random place on all of it
};

}  // namespace

LightPtr make_light(const DistantLight& light) { return std::make_shared<DistantLamp>(light); }

TypeDeclaration distant_light_type() {
  TypeDeclaration type =
      declare(Category::light, "distant_light", "Light from infinitely far away: the sun, or a soft box of any scale.");
  type.field("direction", direction(), "the way the light goes")
      .field("angular_diameter", angle().non_negative().at_most(kPi * 170 / 180),
             "of the source as seen from the scene; 0: parallel rays, sharp shadows", "0");
  declare_area_sampling(type);
  declare_lamp(type, false);
  type.example("direction: [-3, 4, -5], angular_diameter: 5");
  return type.built_by([](const Fields& f) {
    DistantLight light;
    light.direction = f.vec3("direction");
    light.angular_diameter = f.number("angular_diameter");
    light.sampling = area_sampling(f);
    light.lamp = lamp(f);
    return make_light(light);
  });
}

}  // namespace lekalo::render
