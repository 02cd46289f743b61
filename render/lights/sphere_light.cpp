// Light from a ball, evenly bright over the disc as which it is seen.
#include <cmath>

#include "render/lights/lights.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class SphereLamp final : public SpectralLight {
 public:
  explicit SphereLamp(const SphereLight& light)
      : SpectralLight(light.lamp), light_(light), irradiance_(light.lamp, light.sampling), whole_(light.lamp, {}) {}

  int sample_count() const override { return light_.sampling.n * light_.sampling.n; }

  // The directions fill the cone around the ball evenly in solid angle; the place is the near side of the ball.
  LightSample sample(const Vec3& point, int index, double r1, double r2) const override {
    return sample_at(point, area_sample(light_.sampling, index, r1, r2), irradiance_, 1.0 / sample_count());
  }
  LightSample sample_all(const Vec3& point, const Vec2& square) const override {
    return sample_at(point, square, whole_, 1);
  }
  std::optional<LightSample> towards(const Vec3& point, const Vec3& direction) const override {
    const Vec3 to_center = light_.center - point;
    const double distance = glm::length(to_center), along = glm::dot(to_center, direction);
    const Vec3 off = to_center - along * direction;
    const double square = light_.radius * light_.radius - glm::dot(off, off);
    if (distance <= light_.radius || along <= 0 || square < 0) return std::nullopt;
    const double height = one_minus_cosine(distance);
    return LightSample{direction, along - std::sqrt(square), whole_.at(distance, height), 1, 1 / (kTwoPi * height)};
  }
  bool has_size() const override { return true; }
  bool is_jittered() const override { return !light_.sampling.grid; }
  std::optional<ConeLight> cone(const Vec3& point) const override {
    const Vec3 to_center = light_.center - point;
    const double distance = glm::length(to_center);
    if (distance <= light_.radius || !is_jittered()) return std::nullopt;
    return ConeLight{to_center / distance, light_.radius / distance,
                     irradiance_.at(distance, one_minus_cosine(distance)), distance, light_.sampling.n};
  }
  Box3 places() const override {
    return {light_.center - Vec3(light_.radius * (1 + 1e-12)), light_.center + Vec3(light_.radius * (1 + 1e-12))};
  }
  bool casts_shadows() const override { return light_.lamp.shadows; }
  std::any made_from() const override { return light_; }

 private:
  LightSample sample_at(const Vec3& point, const Vec2& square_place, const RoundIrradiance& irradiance,
                        double weight) const {
    const Vec3 to_center = light_.center - point;
    const double distance = glm::length(to_center);
    LightSample sample{{0, 0, 1}, 0, {}, weight};
    if (distance <= light_.radius) return sample;  // inside the lamp: no light
    const double one_minus_cosine = this->one_minus_cosine(distance);
    const Vec2 disc = concentric_disc(square_place);
    const double height = glm::dot(disc, disc) * one_minus_cosine;
    const Vec3 local(disc * std::sqrt(one_minus_cosine * (2 - height)), 1 - height);
    sample.direction = frame_about(Vec3(0), to_center / distance).direction(local);
    const double along = distance * local.z;
    const double square = light_.radius * light_.radius - (distance * distance - along * along);
    sample.distance = along - std::sqrt(std::fmax(0.0, square));
    sample.irradiance = irradiance.at(distance, one_minus_cosine);
    sample.density = 1 / (kTwoPi * one_minus_cosine);
    return sample;
  }
  // Of half the angle under which the ball is seen.
  double one_minus_cosine(double distance) const {
    const double sine = light_.radius / distance;
    return sine * sine / (1 + std::sqrt(1 - sine * sine));
  }

  SphereLight light_;
  RoundIrradiance irradiance_, whole_;  // of its samples; of random places on all of it
};

}  // namespace

LightPtr make_light(const SphereLight& light) { return std::make_shared<SphereLamp>(light); }

TypeDeclaration sphere_light_type() {
  TypeDeclaration type = declare(Category::light, "sphere_light", "Light from a ball: soft shadows on all sides.");
  type.field("center", point(), "of the ball").field("radius", length().positive(), "of the ball");
  declare_area_sampling(type);
  declare_lamp(type);
  type.example("center: [3, -4, 5], radius: 1");
  return type.built_by([](const Fields& f) {
    return make_light(SphereLight{f.vec3("center"), f.number("radius"), area_sampling(f), lamp(f)});
  });
}

}  // namespace lekalo::render
