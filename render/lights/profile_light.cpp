// Light from one point, by direction as the maker of a luminaire measured it.
#include <fstream>
#include <sstream>

#include "render/lights/lights.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class ProfileLamp final : public SpectralLight {
 public:
  explicit ProfileLamp(const ProfileLight& light) : SpectralLight(light.lamp), light_(light), irradiance_(light.lamp) {}

  LightSample sample(const Vec3& point, int, double, double) const override {
    const Vec3 to_light = light_.frame.origin - point;
    const double distance = glm::length(to_light);
    const Vec3 direction = to_light / distance;
    const double share = light_.profile.share(light_.frame.to_local_direction(-direction));
    return {direction, distance, static_cast<float>(share) * irradiance_.at(distance), 1};
  }
  bool casts_shadows() const override { return light_.lamp.shadows; }
  std::any made_from() const override { return light_; }

 private:
  ProfileLight light_;
  Irradiance irradiance_;
};

}  // namespace

LightPtr make_light(const ProfileLight& light) { return std::make_shared<ProfileLamp>(light); }

TypeDeclaration profile_light_type() {
  TypeDeclaration type =
      declare(Category::light, "profile_light",
              "Light from one point, by direction as an IES file of a luminaire says (photometry of type C).");
  type.field("frame", frame(),
             "of the luminaire: z is its axis (vertical angle 0, mostly down), x the horizontal angle 0",
             "{ origin: [0, 0, 0], z: -z }")
      .field("file", file(), "an IES file; its largest intensity counts as `intensity`");
  declare_lamp(type);
  type.example("frame: { origin: [0, 0, 3], z: -z }, file: lamp.ies");
  return type.built_by([](const Fields& f) {
    std::ifstream stream(f.text("file"));
    std::ostringstream text;
    text << stream.rdbuf();
    try {
      return make_light(ProfileLight{f.frame(), IesProfile(text.str()), lamp(f)});
    } catch (const IesError& error) {
      throw FieldError("file", error.what(), "IES files are text: LM-63, TILT=NONE, type C");
    }
  });
}

}  // namespace lekalo::render
