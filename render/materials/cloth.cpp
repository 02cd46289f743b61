// Velvet, felt: a matt body under a nap of fibres that scatter light back at grazing angles.
#include "render/lobes/scattering.h"
#include "render/materials/materials.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class ClothMaterial final : public Material {
 public:
  explicit ClothMaterial(const Cloth& cloth) : cloth_(cloth), albedo_(sheen_albedo(cloth.sheen_roughness)) {}

  Scattering scattering(const SurfacePoint& point, const Wavelengths& wavelengths) const override {
    Scattering s;
    s.lobes.add(RoughMattLobe{cloth_.color.at(point, wavelengths), cloth_.roughness});
    SheenLobe nap;
    nap.color = cloth_.sheen_color.at(point, wavelengths);
    nap.roughness = cloth_.sheen_roughness;
    nap.albedo = albedo_.get();
    s.lobes.cover(nap, Spectrum(static_cast<float>(cloth_.sheen)), *albedo_);
    return s;
  }
  bool uses_parameters() const override {
    return cloth_.color.texture() || cloth_.sheen_color.texture() || cloth_.normal_deviation.amplitude != 0;
  }
  Vec3 shading_normal(const SurfacePoint& point) const override {
    return deviated_normal(point, cloth_.normal_deviation);
  }
  uint64_t cell(const SurfacePoint& point) const override {
    return hash_combine(deviation_cell(point, cloth_.normal_deviation), cloth_.color.cell(point));
  }
  std::any made_from() const override { return cloth_; }

 private:
  Cloth cloth_;
  LobeAlbedoPtr albedo_;  // of the nap
};

}  // namespace

MaterialPtr make_material(const Cloth& cloth) { return std::make_shared<ClothMaterial>(cloth); }

TypeDeclaration cloth_type() {
  TypeDeclaration type = declare(Category::material, "cloth",
                                 "Velvet, felt: a matt body under a nap that is bright at grazing angles. Classic "
                                 "reading: k_a = k_d = color, no nap.");
  type.field("color", textured_share(), "of the body", "0.5")
      .field("roughness", number().between(0, 1), "of the body", "0.5")
      .field("sheen", number().between(0, 1), "how dense the nap is", "1")
      .field("sheen_color", textured_share(), "of the nap", "1")
      .field("sheen_roughness", number().between(0, 1), "how untidy the nap is", "0.4");
  declare_normal_deviation(type);
  type.example("color: [0.3, 0.05, 0.1], sheen_color: [1, 0.8, 0.8]");
  return type.built_by([](const Fields& f) {
    return make_material(Cloth{color_texture(f, "color"), f.number("roughness"), f.number("sheen"),
                               color_texture(f, "sheen_color"), f.number("sheen_roughness"), normal_deviation(f)});
  });
}

}  // namespace lekalo::render
