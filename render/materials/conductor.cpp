// Metal with its own measured reflectance: Fresnel's formulas with the complex index n - i k at the light's
// wavelengths, or for colours that which gives what the eye sees of all of them.
#include <algorithm>
#include <vector>

#include "render/lobes/fresnel.h"
#include "render/lobes/scattering.h"
#include "render/materials/materials.h"
#include "render/materials/optical_constants.h"
#include "render/spectra/hero_wavelengths.h"
#include "render/spectra/observer.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Of D65, by angle: what the eye sees of a metal, cut to Rec.709.
Spectrum seen_reflectance(const std::vector<ComplexIndex>& entries, double cosine) {
  std::vector<float> values;
  for (const ComplexIndex& index : entries) values.push_back(fresnel_conductor(cosine, index.n, index.k)[0]);
  const Vec3 seen = color_of([&](double nanometres) {
    return entry_at(nanometres, [&](size_t i) { return static_cast<double>(values[i]); });
  });
  return rgb(glm::clamp(seen, Vec3(0), Vec3(1)));
}

// The n and k of red, green and blue with which Fresnel's formulas say what the eye sees at right angles, and most
// nearly what it sees at others. Those of one reflectance r at right angles lie on a line (Gulbrandsen, "Artist
// friendly metallic Fresnel", 2014):
//   n = g (1 - r) / (1 + r) + (1 - g) (1 + sqrt r) / (1 - sqrt r),  k^2 = (r (n + 1)^2 - (n - 1)^2) / (1 - r)
ComplexIndex seen_index(const std::string& metal) {
  std::vector<ComplexIndex> entries;
  for (int i = 0; i < kSpectrumEntries; ++i) {
    Wavelengths one;
    one.nanometres.fill(static_cast<float>(entry_nanometres(i)));
    entries.push_back(metal_index(metal, one));
  }
  constexpr int kAngles = 8, kPlaces = 500;
  constexpr double kMaxReflectance = 0.9999;  // n and k of what reflects all are not finite
  std::vector<Spectrum> seen;
  for (int j = 1; j <= kAngles; ++j) seen.push_back(seen_reflectance(entries, static_cast<double>(j) / kAngles));
  ComplexIndex index;
  for (int lane = 0; lane < 3; ++lane) {
    const double r = std::min(kMaxReflectance, static_cast<double>(seen.back()[lane])), root = std::sqrt(r);
    double least = kInfinity;
    for (int place = 0; place <= kPlaces; ++place) {
      const double g = static_cast<double>(place) / kPlaces;
      const double n = g * (1 - r) / (1 + r) + (1 - g) * (1 + root) / (1 - root);
      const double k = std::sqrt(std::max(0.0, (r * (n + 1) * (n + 1) - (n - 1) * (n - 1)) / (1 - r)));
      const Spectrum tried_n(static_cast<float>(n)), tried_k(static_cast<float>(k));
      double squares = 0;
      for (int j = 1; j <= kAngles; ++j) {
        const double off = fresnel_conductor(static_cast<double>(j) / kAngles, tried_n, tried_k)[0] -
                           seen[static_cast<size_t>(j - 1)][lane];
        squares += off * off;
      }
      if (squares >= least) continue;
      least = squares;
      index.n.set(lane, tried_n[0]);
      index.k.set(lane, tried_k[0]);
    }
  }
  index.n.set(3, index.n[1]);  // as in Wavelengths
  index.k.set(3, index.k[1]);
  return index;
}

class ConductorMaterial final : public Material {
 public:
  explicit ConductorMaterial(const Conductor& conductor)
      : conductor_(conductor),
        rgb_index_(conductor.metal.empty() ? ComplexIndex{} : seen_index(conductor.metal)),
        rgb_mean_(MetalReflectance{rgb_index_.n, rgb_index_.k}.mean()),
        roughness_(conductor.roughness,
                   [stretch = conductor.anisotropy](double roughness) { return mirror_albedo(roughness, stretch); }),
        film_(conductor.film.table([metal = conductor.metal](double nanometres) {
          Wavelengths wavelengths;
          wavelengths.nanometres.fill(static_cast<float>(nanometres));
          const ComplexIndex index = metal_index(metal, wavelengths);
          return std::complex<double>(index.n[0], -index.k[0]);
        })) {
    if (conductor.metal.empty()) return;
    for (int i = 0; i < kSpectrumEntries; ++i) {
      Wavelengths one;
      one.nanometres.fill(static_cast<float>(entry_nanometres(i)));
      const ComplexIndex index = metal_index(conductor.metal, one);
      means_.push_back(MetalReflectance{index.n, index.k}.mean()[0]);
    }
  }

  Scattering scattering(const SurfacePoint& point, const Wavelengths& wavelengths) const override {
    MetalLobe lobe;
    lobe.reflectance = reflectance(point, wavelengths);
    lobe.mean = mean(lobe.reflectance, wavelengths);
    lobe.anisotropy = conductor_.anisotropy;
    lobe.rotation = conductor_.rotation;
    const TabledRoughness::Value rough = roughness_.at(point);
    lobe.roughness = rough.roughness;
    lobe.albedo = rough.albedo;
    Scattering s;
    s.lobes.add(lobe);
    return s;
  }
  Spectrum albedo(const SurfacePoint& point, const Wavelengths& wavelengths) const override {
    return reflectance(point, wavelengths).at(1);
  }
  bool uses_parameters() const override {
    return conductor_.color.texture() || conductor_.edge_tint.texture() || conductor_.roughness.texture ||
           conductor_.anisotropy > 0 || conductor_.film.texture || conductor_.normal_deviation.amplitude != 0;
  }
  Vec3 shading_normal(const SurfacePoint& point) const override {
    return deviated_normal(point, conductor_.normal_deviation);
  }
  uint64_t cell(const SurfacePoint& point) const override { return deviation_cell(point, conductor_.normal_deviation); }
  std::any made_from() const override { return conductor_; }

 private:
  static bool is_usual(const Wavelengths& wavelengths) { return wavelengths.nanometres == Wavelengths{}.nanometres; }
  Spectrum mean(const MetalReflectance& reflectance, const Wavelengths& wavelengths) const {
    if (!reflectance.measured() || film_) return reflectance.mean();
    if (is_usual(wavelengths)) return rgb_mean_;
    if (!is_spectral(wavelengths)) return reflectance.mean();
    Spectrum means;
    for (int i = 0; i < 4; ++i) {
      const double nanometres = wavelengths.nanometres[static_cast<size_t>(i)];
      means.set(i, static_cast<float>(entry_at(nanometres, [this](size_t entry) { return means_[entry]; })));
    }
    return means;
  }
  MetalReflectance reflectance(const SurfacePoint& point, const Wavelengths& wavelengths) const {
    MetalReflectance f;
    f.wavelengths = wavelengths;
    if (conductor_.metal.empty()) {
      f.color = conductor_.color.at(point, wavelengths);
      f.edge_tint = conductor_.edge_tint.at(point, wavelengths);
      return f;
    }
    const ComplexIndex index = is_usual(wavelengths) ? rgb_index_ : metal_index(conductor_.metal, wavelengths);
    f.n = index.n;
    f.k = index.k;
    if (film_) {
      f.film = film_.get();
      f.thickness = conductor_.film.thickness(point);
    }
    return f;
  }

  Conductor conductor_;
  ComplexIndex rgb_index_;    // of red, green and blue as the eye sees them
  Spectrum rgb_mean_;         // of the measured reflectance there
  std::vector<float> means_;  // and at the entries of the tables of spectra
  TabledRoughness roughness_;
  FilmTablePtr film_;
};

}  // namespace

MaterialPtr make_material(const Conductor& conductor) { return std::make_shared<ConductorMaterial>(conductor); }

TypeDeclaration conductor_type() {
  TypeDeclaration type =
      declare(Category::material, "conductor",
              "Metal, with its measured reflectance, in red, green and blue as the eye sees it under D65 and "
              "at most 1. Classic reading, with r the roughness, F0 and F the metal's "
              "reflectance at right and at the actual angle, s = (1 - 4 r^2)^2 up to r = 0.5, then 0: mirror = s F; "
              "k_a = (1 - s) F0; k_d = r k_a; Phong's exponent n = (1/r^4 - 1)/2 within 1 to 1000; k_s = F0 times (1 - "
              "s)(n + 2)/2, "
              "at most F0.");
  type.optional("metal", choice(metal_names()), "chemical symbol; CuZn is brass, CuZn_90_10 tombac; or give `color`")
      .optional("color", textured_share(), "reflectance at right angles, in place of a measured metal")
      .field("edge_tint", textured_share(), "of `color`: factor of the reflectance at 82 degrees", "1")
      .field("anisotropy", number().non_negative().below(1), "0: round highlights; towards 1: stretched ones", "0")
      .field("rotation", angle(), "of the long direction of highlights, from the direction in which u grows", "0");
  type.example_fields = "metal: Cu";
  declare_roughness(type, "roughness", "0: mirror; 0.5 and more: no mirror images, only highlights", "0.2");
  declare_thin_film(type);
  declare_normal_deviation(type);
  return type.built_by([](const Fields& f) {
    if (f.has("metal") == f.has("color"))
      throw FieldError(f.has("metal") ? "color" : "metal", "a conductor needs one of 'metal' and 'color'",
                       "metal: Cu takes measured copper; color: [0.9, 0.6, 0.4] any reflectance");
    Conductor conductor;
    conductor.metal = f.has("metal") ? f.text("metal") : std::string();
    conductor.roughness = roughness(f, "roughness");
    conductor.anisotropy = f.number("anisotropy");
    conductor.rotation = f.number("rotation");
    if (f.has("color")) conductor.color = color_texture(f, "color");
    conductor.edge_tint = color_texture(f, "edge_tint");
    conductor.film = thin_film(f);
    if (conductor.film.exists() && conductor.metal.empty())
      throw FieldError("film", "what a film does depends on the metal below it", "take a measured one: metal: Fe");
    conductor.normal_deviation = normal_deviation(f);
    return make_material(conductor);
  });
}

}  // namespace lekalo::render
