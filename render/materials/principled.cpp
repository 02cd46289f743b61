// A surface of layers by the parameters of OpenPBR 1.1 (Academy Software Foundation 2024): a base that is metal, matt
// under a clear skin, or glass, in any mixture; a clear coat over it; a nap of fibres over all.
#include <algorithm>
#include <cmath>

#include "render/lobes/fresnel.h"
#include "render/lobes/scattering.h"
#include "render/materials/materials.h"
#include "render/materials/optical_constants.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Index of a skin whose reflectance at right angles is `weight` times that of the given index (OpenPBR 1.1).
double weighted_index(double index, double weight) {
  const double root = std::sqrt(std::min(0.999, weight * fresnel_dielectric(1, 1, index)));
  return (1 + root) / (1 - root);
}

class PrincipledMaterial final : public Material {
 public:
  explicit PrincipledMaterial(const Principled& p)
      : p_(p),
        index_(weighted_index(p.specular_ior, p.specular_weight)),
        metal_(p.specular_roughness,
               [stretch = p.specular_roughness_anisotropy](double r) { return mirror_albedo(r, stretch); }),
        skin_(p.specular_roughness, [index = index_](double r) { return coat_albedo(r, index); }),
        coat_(coat_albedo(p.coat_roughness, p.coat_ior)),
        fuzz_(sheen_albedo(p.fuzz_roughness)) {
    for (int i = 0; i < 3; ++i)
      if (p.transmission_depth > 0) {
        const double extinction = -std::log(std::max(p.transmission_color[i], 1e-4)) / p.transmission_depth;
        scattering_[i] = p.transmission_scatter[i] / p.transmission_depth;
        absorption_[i] = std::max(0.0, extinction - scattering_[i]);
      }
  }

  Scattering scattering(const SurfacePoint& point, const Wavelengths& wavelengths) const override {
    Scattering s;
    const Spectrum base = static_cast<float>(p_.base_weight) * p_.base_color.at(point, wavelengths);
    // What passes the coat is coloured by it.
    const auto coated = static_cast<float>(p_.coat_weight.at(point));
    const Spectrum tint = Spectrum(1 - coated) + coated * p_.coat_color.at(point, wavelengths);
    const double metalness = p_.base_metalness.at(point), opaque = 1 - metalness;
    const double passing = p_.transmission_weight.at(point);
    s.lobes.add(metal(point, base, wavelengths), part(metalness) * tint);
    s.lobes.add(matt(point, base), part(opaque * (1 - passing)) * tint);
    s.lobes.add(clear(point, wavelengths), part(opaque * passing) * tint);
    CoatLobe coat = coat_lobe(p_.coat_ior);
    coat.roughness = p_.coat_roughness;
    coat.albedo = coat_.get();
    s.lobes.cover(coat, Spectrum(coated), *coat_);
    SheenLobe nap;
    nap.color = p_.fuzz_color.at(point, wavelengths);
    nap.roughness = p_.fuzz_roughness;
    nap.albedo = fuzz_.get();
    s.lobes.cover(nap, Spectrum(static_cast<float>(p_.fuzz_weight.at(point))), *fuzz_);
    s.emission = static_cast<float>(p_.emission_luminance) * p_.emission_color.light_at(point, wavelengths);
    return s;
  }

  std::optional<Medium> interior(const Wavelengths& wavelengths) const override {
    if (!transmits()) return std::nullopt;
    return Medium{static_cast<float>(index(wavelengths.nanometres[0])), upsampled_light(rgb(absorption_), wavelengths),
                  0, upsampled_light(rgb(scattering_), wavelengths),
                  static_cast<float>(p_.transmission_scatter_anisotropy)};
  }
  bool transmits() const override {
    const Roughness &passing = p_.transmission_weight, &metalness = p_.base_metalness;
    return (passing.texture || passing.value > 0) && (metalness.texture || metalness.value < 1);
  }
  bool uses_parameters() const override {
    return p_.base_color.texture() || p_.specular_color.texture() || p_.coat_color.texture() ||
           p_.fuzz_color.texture() || p_.emission_color.texture() || p_.specular_roughness.texture ||
           p_.base_metalness.texture || p_.transmission_weight.texture || p_.coat_weight.texture ||
           p_.fuzz_weight.texture || p_.specular_roughness_anisotropy > 0 || p_.normal_deviation.amplitude != 0;
  }
  Vec3 shading_normal(const SurfacePoint& point) const override { return deviated_normal(point, p_.normal_deviation); }
  uint64_t cell(const SurfacePoint& point) const override {
    return hash_combine(deviation_cell(point, p_.normal_deviation), p_.base_color.cell(point));
  }
  std::any made_from() const override { return p_; }

 private:
  double index(double nanometres) const {
    const double scale = p_.transmission_dispersion_scale;
    if (scale == 0) return p_.specular_ior;
    return cauchy_index(p_.specular_ior, p_.transmission_dispersion_abbe_number / scale, nanometres);
  }
  static Spectrum part(double weight) { return Spectrum(static_cast<float>(weight)); }
  MetalLobe metal(const SurfacePoint& point, const Spectrum& color, const Wavelengths& wavelengths) const {
    MetalLobe lobe;
    lobe.reflectance.color = static_cast<float>(p_.specular_weight) * color;
    lobe.reflectance.edge_tint = p_.specular_color.at(point, wavelengths);
    lobe.mean = lobe.reflectance.mean();
    lobe.anisotropy = p_.specular_roughness_anisotropy;
    const TabledRoughness::Value rough = metal_.at(point);
    lobe.roughness = rough.roughness;
    lobe.albedo = rough.albedo;
    return lobe;
  }
  CoatedMattLobe matt(const SurfacePoint& point, const Spectrum& color) const {
    const TabledRoughness::Value rough = skin_.at(point);
    CoatLobe skin = coat_lobe(index_);
    skin.roughness = rough.roughness;
    skin.albedo = rough.albedo;
    return {color, skin};
  }
  ClearLobe clear(const SurfacePoint& point, const Wavelengths& wavelengths) const {
    ClearLobe lobe;
    lobe.roughness = p_.specular_roughness.at(point);
    lobe.index = p_.specular_ior;
    lobe.facing = fresnel_dielectric(1, 1, p_.specular_ior);
    if (p_.transmission_depth == 0) lobe.tint = upsampled_reflectance(rgb(p_.transmission_color), wavelengths);
    return lobe;
  }

  Principled p_;
  double index_;  // of the skin over the matt base
  TabledRoughness metal_, skin_;
  LobeAlbedoPtr coat_, fuzz_;
  Vec3 absorption_{0}, scattering_{0};
};

}  // namespace

MaterialPtr make_material(const Principled& principled) { return std::make_shared<PrincipledMaterial>(principled); }

TypeDeclaration principled_type() {
  TypeDeclaration type = declare(
      Category::material, "principled",
      "Surface of layers with OpenPBR's names: a base of metal, of a matt body under a clear skin, or of glass, "
      "in any mixture; a clear coat over it; a nap over all. Classic reading: that of conductor, plastic, "
      "dielectric by their shares, highlight and mirror of the last one that there is.");
  type.field("base_weight", number().between(0, 1), "multiplies base_color", "1")
      .field("base_color", textured_share(), "of the matt base, of metals the reflectance at right angles", "0.8");
  declare_roughness(type, "base_metalness", "share of the base that is metal", "0");
  type.field("specular_weight", number().between(0, 1), "multiplies the reflectance of metal and skin", "1")
      .field("specular_color", textured_share(), "of metals, the tint at the edge", "1");
  declare_roughness(type, "specular_roughness", "0: sharp mirror images", "0.3");
  type.field("specular_roughness_anisotropy", number().non_negative().below(1), "of metals: stretched highlights", "0")
      .field("specular_ior", number().at_least(1), "refractive index of skin and glass", "1.5");
  declare_roughness(type, "transmission_weight", "share of what is no metal that is clear", "0");
  type.field("transmission_color", color().between(0, 1), "of light that passes", "white")
      .field("transmission_depth", number().non_negative(), "way after which it has that colour; 0: at once", "0")
      .field("transmission_scatter", color().non_negative(),
             "how often light is scattered over that way; the classic model leaves it out", "0")
      .field("transmission_scatter_anisotropy", number().above(-1).below(1), "mean cosine of the angles", "0")
      .field("transmission_dispersion_scale", number().between(0, 1), "0: colours do not part", "0")
      .field("transmission_dispersion_abbe_number", number().at_least(9), "divided by that scale it is Abbe's", "20");
  declare_roughness(type, "coat_weight", "share of the surface that is under a coat", "0");
  type.field("coat_color", textured_share(), "of light that comes back through the coat", "1")
      .field("coat_roughness", number().between(0, 1), "of the coat", "0")
      .field("coat_ior", number().at_least(1), "refractive index of the coat", "1.6");
  declare_roughness(type, "fuzz_weight", "how dense the nap is", "0");
  type.field("fuzz_color", textured_share(), "of the nap", "1")
      .field("fuzz_roughness", number().between(0, 1), "of the nap", "0.5")
      .field("emission_luminance", number().non_negative(), "radiance, multiplies emission_color", "0")
      .field("emission_color", textured_color(), "of the glow", "1");
  declare_normal_deviation(type);
  type.example("base_color: [0.7, 0.15, 0.1], coat_weight: 1");
  return type.built_by([](const Fields& f) {
    Principled p;
    p.base_weight = f.number("base_weight");
    p.base_color = color_texture(f, "base_color");
    p.base_metalness = roughness(f, "base_metalness");
    p.specular_weight = f.number("specular_weight");
    p.specular_color = color_texture(f, "specular_color");
    p.specular_roughness = roughness(f, "specular_roughness");
    p.specular_roughness_anisotropy = f.number("specular_roughness_anisotropy");
    p.specular_ior = f.number("specular_ior");
    p.transmission_weight = roughness(f, "transmission_weight");
    p.transmission_color = f.vec3("transmission_color");
    p.transmission_depth = f.number("transmission_depth");
    p.transmission_scatter = f.vec3("transmission_scatter");
    p.transmission_scatter_anisotropy = f.number("transmission_scatter_anisotropy");
    p.transmission_dispersion_scale = f.number("transmission_dispersion_scale");
    p.transmission_dispersion_abbe_number = f.number("transmission_dispersion_abbe_number");
    if (p.transmission_depth == 0 && p.transmission_scatter != Vec3(0))
      throw FieldError("transmission_scatter", "without a depth there is no substance that could scatter",
                       "give transmission_depth, the way over which the light is scattered so often");
    p.coat_weight = roughness(f, "coat_weight");
    p.coat_color = color_texture(f, "coat_color");
    p.coat_roughness = f.number("coat_roughness");
    p.coat_ior = f.number("coat_ior");
    p.fuzz_weight = roughness(f, "fuzz_weight");
    p.fuzz_color = color_texture(f, "fuzz_color");
    p.fuzz_roughness = f.number("fuzz_roughness");
    p.emission_luminance = f.number("emission_luminance");
    p.emission_color = color_texture(f, "emission_color");
    p.normal_deviation = normal_deviation(f);
    return make_material(p);
  });
}

}  // namespace lekalo::render
