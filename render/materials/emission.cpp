// Surface that glows evenly in all directions: it shows its outline and its brightness (Golovanov 2016, 8.4).
#include "render/lobes/scattering.h"
#include "render/materials/materials.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class EmissionMaterial final : public Material {
 public:
  explicit EmissionMaterial(const Emission& emission) : emission_(emission) {}

  Scattering scattering(const SurfacePoint& point, const Wavelengths&) const override {
    Scattering s;
    s.emission = static_cast<float>(emission_.strength) * emission_.color.at(point);
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
  return declare(Category::material, "emission",
                 "Surface that glows evenly. Classic reading: the radiance color times strength whatever the light; it "
                 "does not light other objects (area lights do). By paths it does.")
      .field("color", textured_color(), "of the light", "white")
      .field("strength", number().non_negative(), "multiplies the colour", "1")
      .example("color: [1, 0.8, 0.5]")
      .built_by([](const Fields& f) {
        return make_material(Emission{color_texture(f, "color"), f.number("strength")});
      });
}

}  // namespace lekalo::render
