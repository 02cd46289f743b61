// Metal with its own measured reflectance: Fresnel's formulas with the complex index n - i k at the light's
// wavelengths.
#include "render/materials/fresnel.h"
#include "render/materials/gloss.h"
#include "render/materials/materials.h"
#include "render/materials/optical_constants.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class ConductorMaterial final : public Material {
 public:
  explicit ConductorMaterial(const Conductor& conductor)
      : conductor_(conductor), rgb_index_(metal_index(conductor.metal, Wavelengths{})) {}

  ClassicCoefficients classic(const SurfacePoint&, const Wavelengths& wavelengths) const override {
    const ComplexIndex index =
        wavelengths.nanometres == Wavelengths{}.nanometres ? rgb_index_ : metal_index(conductor_.metal, wavelengths);
    const double share = mirror_share(conductor_.roughness);
    const Spectrum reflectance = fresnel_conductor(1, index.n, index.k);
    ClassicCoefficients c;
    c.exponent = phong_exponent(conductor_.roughness);
    c.ambient = static_cast<float>(1 - share) * reflectance;
    c.diffuse = static_cast<float>(conductor_.roughness) * c.ambient;
    c.specular = static_cast<float>(phong_height(c.exponent, 1 - share)) * reflectance;
    c.mirror = Spectrum(static_cast<float>(share));
    c.fresnel = Fresnel::conductor;
    c.index = index.n;
    c.extinction = index.k;
    return c;
  }
  Spectrum albedo(const SurfacePoint& point, const Wavelengths& wavelengths) const override {
    const ClassicCoefficients c = classic(point, wavelengths);
    return fresnel_conductor(1, c.index, c.extinction);
  }
  bool uses_parameters() const override { return conductor_.normal_deviation.amplitude != 0; }
  Vec3 shading_normal(const SurfacePoint& point) const override {
    return deviated_normal(point, conductor_.normal_deviation);
  }
  uint64_t cell(const SurfacePoint& point) const override { return deviation_cell(point, conductor_.normal_deviation); }
  std::any made_from() const override { return conductor_; }

 private:
  Conductor conductor_;
  ComplexIndex rgb_index_;  // looked up once for the usual wavelengths
};

}  // namespace

MaterialPtr make_material(const Conductor& conductor) { return std::make_shared<ConductorMaterial>(conductor); }

TypeDeclaration conductor_type() {
  TypeDeclaration type =
      declare(Category::material, "conductor",
              "Metal, with its measured reflectance. Classic reading, with r the roughness, F0 and F the metal's "
              "reflectance at right and at the actual angle, s = (1 - 4 r^2)^2 up to r = 0.5, then 0: mirror = s F; "
              "k_a = (1 - s) F0; k_d = r k_a; Phong's exponent n = (1/r^4 - 1)/2 within 1 to 1000; k_s = F0 times (1 - "
              "s)(n + 2)/2, "
              "at most F0.");
  type.field("metal", choice(metal_names()), "chemical symbol; CuZn is brass, CuZn_90_10 tombac")
      .field("roughness", number().between(0, 1), "0: mirror; 0.5 and more: no mirror images, only highlights", "0.2");
  declare_normal_deviation(type);
  return type.built_by([](const Fields& f) {
    return make_material(Conductor{f.text("metal"), f.number("roughness"), normal_deviation(f)});
  });
}

}  // namespace lekalo::render
