// Coloured body under a clear coat of refractive index n: paint, porcelain, plastic.
#include "render/lobes/scattering.h"
#include "render/materials/materials.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class PlasticMaterial final : public Material {
 public:
  explicit PlasticMaterial(const Plastic& plastic)
      : plastic_(plastic),
        coat_(coat_lobe(plastic.index)),
        roughness_(plastic.roughness,
                   [index = plastic.index](double roughness) { return coat_albedo(roughness, index); }) {}

  Scattering scattering(const SurfacePoint& point, const Wavelengths& wavelengths) const override {
    Scattering s;
    CoatedMattLobe lobe{plastic_.color.at(point, wavelengths), coat_};
    const TabledRoughness::Value rough = roughness_.at(point);
    lobe.coat.roughness = rough.roughness;
    lobe.coat.albedo = rough.albedo;
    s.lobes.add(lobe);
    return s;
  }
  bool uses_parameters() const override {
    return plastic_.color.texture() || plastic_.roughness.texture || plastic_.normal_deviation.amplitude != 0;
  }
  Vec3 shading_normal(const SurfacePoint& point) const override {
    return deviated_normal(point, plastic_.normal_deviation);
  }
  uint64_t cell(const SurfacePoint& point) const override {
    return hash_combine(deviation_cell(point, plastic_.normal_deviation), plastic_.color.cell(point));
  }
  std::any made_from() const override { return plastic_; }

 private:
  Plastic plastic_;
  CoatLobe coat_;  // without its roughness
  TabledRoughness roughness_;
};

}  // namespace

MaterialPtr make_material(const Plastic& plastic) { return std::make_shared<PlasticMaterial>(plastic); }

TypeDeclaration plastic_type() {
  TypeDeclaration type = declare(
      Category::material, "plastic",
      "Coloured body under a clear coat: plastic, paint, porcelain. Classic reading, with r the roughness, F0 and F "
      "the coat's reflectance at right and at the actual angle: k_a = k_d = color; Phong's exponent "
      "n = (1/r^4 - 1)/2 within 1 to 1000; k_s = F0 (n + 2)/2, at most 1; mirror = F (1 - 4 r^2)^2 up to r = 0.5.");
  type.field("color", textured_share(), "share of the light that the body reflects", "0.8")
      .field("index", number().at_least(1), "refractive index of the coat", "1.5");
  declare_roughness(type, "roughness", "0: glossy; 1: a wide, faint highlight", "0.4");
  declare_normal_deviation(type);
  type.example("color: [0.1, 0.3, 0.6], roughness: 0.15");
  return type.built_by([](const Fields& f) {
    return make_material(
        Plastic{color_texture(f, "color"), roughness(f, "roughness"), f.number("index"), normal_deviation(f)});
  });
}

}  // namespace lekalo::render
