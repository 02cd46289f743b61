// Light from one point into a cone.
#include <algorithm>
#include <cmath>

#include "render/lights/lights.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class SpotLamp final : public SpectralLight {
 public:
  explicit SpotLamp(const SpotLight& light)
      : SpectralLight(light.lamp),
        light_(light),
        irradiance_(light.lamp),
        cos_outer_(std::cos(light.angle)),
        cos_inner_(std::cos(light.inner_angle)) {}

  LightSample sample(const Vec3& point, int, double, double) const override {
    const Vec3 to_light = light_.position - point;
    const double distance = glm::length(to_light);
    const Vec3 direction = to_light / distance;
    const float share = static_cast<float>(cone_share(-glm::dot(direction, light_.direction)));
    return {direction, distance, share * irradiance_.at(distance), 1};
  }
  bool casts_shadows() const override { return light_.lamp.shadows; }
  std::any made_from() const override { return light_; }

 private:
  double cone_share(double cosine) const {
    if (cosine < cos_outer_) return 0;
    if (cosine >= cos_inner_) return 1;
    const double s = (cosine - cos_outer_) / (cos_inner_ - cos_outer_);
    return s * s * (3 - 2 * s);
  }

  SpotLight light_;
  Irradiance irradiance_;
  double cos_outer_, cos_inner_;
};

}  // namespace

LightPtr make_light(const SpotLight& light) { return std::make_shared<SpotLamp>(light); }

TypeDeclaration spot_light_type() {
  TypeDeclaration type = declare(Category::light, "spot_light", "Light from one point into a cone.")
                             .example("position: [0, 0, 5], at: [0, 0, 0]");
  type.field("position", point(), "where it stands")
      .optional("at", point(), "where it points to; or give `direction`")
      .optional("direction", direction(), "along the axis of the cone")
      .field("angle", angle().positive().at_most(kPi / 2), "from the axis to where the light ends", "30")
      .optional("inner_angle", angle().non_negative(),
                "from the axis to where the full light ends; between the two it fades smoothly; default: no fading");
  declare_lamp(type);
  return type.built_by([](const Fields& f) {
    if (f.has("at") == f.has("direction"))
      throw FieldError(f.has("at") ? "direction" : "at", "a spot light needs one of 'at' and 'direction'",
                       "at: a point that it shines on; direction: along its axis");
    SpotLight light;
    light.position = f.vec3("position");
    const Vec3 along = f.has("at") ? f.vec3("at") - light.position : f.vec3("direction");
    if (glm::length(along) == 0) throw FieldError("at", "the light points at its own position", "move one of the two");
    light.direction = glm::normalize(along);
    light.angle = f.number("angle");
    light.inner_angle = f.has("inner_angle") ? f.number("inner_angle") : light.angle;
    if (light.inner_angle > light.angle)
      throw FieldError("inner_angle", "'inner_angle' is larger than 'angle'",
                       "the light fades from the inner to the outer");
    light.lamp = lamp(f);
    return make_light(light);
  });
}

}  // namespace lekalo::render
