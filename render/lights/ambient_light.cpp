// Light that comes evenly from everywhere and throws no shadows: the I_a of Golovanov 2016, 8.4.
#include "render/lights/lights.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class AmbientLamp final : public Light {
 public:
  explicit AmbientLamp(const AmbientLight& light) : light_(light), radiance_(rgb(light.intensity * light.color)) {}

  Spectrum ambient() const override { return radiance_; }
  int sample_count() const override { return 0; }
  LightSample sample(const Vec3&, int, double, double) const override { return {}; }
  std::any made_from() const override { return light_; }

 private:
  AmbientLight light_;
  Spectrum radiance_;
};

}  // namespace

LightPtr make_light(const AmbientLight& light) { return std::make_shared<AmbientLamp>(light); }

TypeDeclaration ambient_light_type() {
  return declare(Category::light, "ambient_light", "Light that comes evenly from everywhere: no shadows.")
      .field("color", color().non_negative(), "of the light", "white")
      .field("intensity", number().non_negative(), "radiance of a white surface (k_a = 1) under it alone", "1")
      .built_by([](const Fields& f) {
        return make_light(AmbientLight{f.vec3("color"), f.number("intensity")});
      });
}

}  // namespace lekalo::render
