// Matt surface: Lambert's law, the same brightness from everywhere (Golovanov 2016, 8.4).
#include "render/lobes/scattering.h"
#include "render/materials/materials.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class DiffuseMaterial final : public Material {
 public:
  explicit DiffuseMaterial(const Diffuse& diffuse) : diffuse_(diffuse) {}

  Scattering scattering(const SurfacePoint& point, const Wavelengths& wavelengths) const override {
    Scattering s;
    const double rough = diffuse_.roughness.at(point);
    if (rough > 0)
      s.lobes.add(RoughMattLobe{diffuse_.color.at(point, wavelengths), rough});
    else
      s.lobes.add(LambertLobe{diffuse_.color.at(point, wavelengths)});
    return s;
  }
  bool uses_parameters() const override {
    return diffuse_.color.texture() || diffuse_.roughness.texture || diffuse_.normal_deviation.amplitude != 0;
  }
  Vec3 shading_normal(const SurfacePoint& point) const override {
    return deviated_normal(point, diffuse_.normal_deviation);
  }
  uint64_t cell(const SurfacePoint& point) const override {
    return hash_combine(deviation_cell(point, diffuse_.normal_deviation), diffuse_.color.cell(point));
  }
  std::any made_from() const override { return diffuse_; }

 private:
  Diffuse diffuse_;
};

}  // namespace

MaterialPtr make_material(const Diffuse& diffuse) { return std::make_shared<DiffuseMaterial>(diffuse); }

TypeDeclaration diffuse_type() {
  TypeDeclaration type = declare(Category::material, "diffuse",
                                 "Matt surface: reflects light evenly in all directions. Classic reading: "
                                 "k_a = k_d = color.");
  type.field("color", textured_share(), "share of the light that is reflected", "0.8");
  declare_roughness(type, "roughness", "0: Lambert's; up to 1: brighter towards the light, as clay and the moon", "0");
  declare_normal_deviation(type);
  type.example("color: [0.65, 0.35, 0.2]");
  return type.built_by([](const Fields& f) {
    return make_material(Diffuse{color_texture(f, "color"), roughness(f, "roughness"), normal_deviation(f)});
  });
}

}  // namespace lekalo::render
