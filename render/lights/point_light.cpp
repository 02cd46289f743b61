// Light from one point: sharp shadows (Golovanov 2016, 8.4, 8.5).
#include "render/lights/lights.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class PointLamp final : public SpectralLight {
 public:
  explicit PointLamp(const PointLight& light) : SpectralLight(light.lamp), light_(light), irradiance_(light.lamp) {}

  LightSample sample(const Vec3& point, int, double, double) const override {
    const Vec3 to_light = light_.position - point;
    const double distance = glm::length(to_light);
    return {to_light / distance, distance, irradiance_.at(distance), 1};
  }
  bool casts_shadows() const override { return light_.lamp.shadows; }
  std::any made_from() const override { return light_; }

 private:
  PointLight light_;
  Irradiance irradiance_;
};

}  // namespace

LightPtr make_light(const PointLight& light) { return std::make_shared<PointLamp>(light); }

TypeDeclaration point_light_type() {
  TypeDeclaration type = declare(Category::light, "point_light", "Light from one point: sharp shadows.");
  type.field("position", point(), "where it stands");
  declare_lamp(type);
  type.example("position: [3, -4, 5]");
  return type.built_by([](const Fields& f) { return make_light(PointLight{f.vec3("position"), lamp(f)}); });
}

}  // namespace lekalo::render
