// Surface that glows evenly in all directions: it shows its outline and its brightness (Golovanov 2016, 8.4).
#include "render/lobes/scattering.h"
#include "render/materials/materials.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class EmissionMaterial final : public Material {
 public:
  explicit EmissionMaterial(const Emission& emission) : emission_(emission) {}

  Scattering scattering(const SurfacePoint& point, const Wavelengths& wavelengths) const override {
    Scattering s;
    const Spectrum light = emission_.spectrum ? emission_.spectrum->at(emission_.color.at(point), wavelengths)
                                              : emission_.color.light_at(point, wavelengths);
    s.emission = static_cast<float>(emission_.strength) * light;
    return s;
  }
  bool uses_parameters() const override { return emission_.color.texture() != nullptr; }
  uint64_t cell(const SurfacePoint& point) const override { return emission_.color.cell(point); }
  std::any made_from() const override { return emission_; }

 private:
  Emission emission_;
};

}  // namespace

MaterialPtr make_material(const Emission& emission) { return std::make_shared<EmissionMaterial>(emission); }

TypeDeclaration emission_type() {
  TypeDeclaration type =
      declare(Category::material, "emission",
              "Surface that glows evenly. Classic reading: the radiance color times strength whatever the light; it "
              "does not light other objects (area lights do). By paths it does.")
          .field("color", textured_color(), "of the light", "white")
          .field("strength", number().non_negative(), "multiplies the colour", "1");
  declare_lamp_spectrum(type);
  type.example("color: [1, 0.8, 0.5]");
  return type.built_by([](const Fields& f) {
    Emission emission{color_texture(f, "color"), f.number("strength"), lamp_spectrum(f)};
    if (emission.spectrum) emission.color = emission.spectrum->color();
    return make_material(emission);
  });
}

}  // namespace lekalo::render
