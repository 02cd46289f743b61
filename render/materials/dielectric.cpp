// Clear body: glass, crystal, liquid. Snell's refraction, Fresnel's reflectance, Bouguer's absorption (Golovanov 2016,
// 8.4), the refractive index from the substance's dispersion formula.
#include "render/lobes/fresnel.h"
#include "render/lobes/scattering.h"
#include "render/materials/materials.h"
#include "render/materials/optical_constants.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class DielectricMaterial final : public Material {
 public:
  explicit DielectricMaterial(const Dielectric& dielectric) : dielectric_(dielectric), index_d_(index(kLineD)) {
    lobe_.index = index_d_;
    lobe_.facing = fresnel_dielectric(1, 1, index_d_);
    lobe_.thin = dielectric.thin;
    film_ = dielectric.film.table([this](double nanometres) { return std::complex<double>(index(nanometres)); });
    lobe_.film = film_.get();
  }

  Scattering scattering(const SurfacePoint& point, const Wavelengths& wavelengths) const override {
    Scattering s;
    ClearLobe lobe = lobe_;
    lobe.wavelengths = wavelengths;
    lobe.roughness = dielectric_.roughness.at(point);
    if (film_) lobe.thickness = dielectric_.film.thickness(point);
    s.lobes.add(lobe);
    return s;
  }

  std::optional<Medium> interior(const Wavelengths& wavelengths) const override {
    if (dielectric_.thin) return std::nullopt;
    const float nanometres = wavelengths.nanometres[0];
    return Medium{static_cast<float>(nanometres == kLineD ? index_d_ : index(nanometres)),
                  upsampled_light(rgb(dielectric_.absorption), wavelengths), dielectric_.priority,
                  upsampled_light(rgb(dielectric_.scattering), wavelengths), static_cast<float>(dielectric_.forward)};
  }
  bool transmits() const override { return true; }
  bool uses_parameters() const override {
    return dielectric_.roughness.texture || dielectric_.film.texture || dielectric_.normal_deviation.amplitude != 0;
  }
  Vec3 shading_normal(const SurfacePoint& point) const override {
    return deviated_normal(point, dielectric_.normal_deviation);
  }
  uint64_t cell(const SurfacePoint& point) const override {
    return deviation_cell(point, dielectric_.normal_deviation);
  }
  std::any made_from() const override { return dielectric_; }

 private:
  double index(double nanometres) const {
    if (!dielectric_.glass.empty()) return dielectric_index(dielectric_.glass, nanometres);
    return dielectric_.abbe > 0 ? cauchy_index(dielectric_.index, dielectric_.abbe, nanometres) : dielectric_.index;
  }

  Dielectric dielectric_;
  double index_d_;  // computed once for the usual wavelength
  ClearLobe lobe_;  // without its roughness
  FilmTablePtr film_;
};

}  // namespace

MaterialPtr make_material(const Dielectric& dielectric) { return std::make_shared<DielectricMaterial>(dielectric); }

TypeDeclaration dielectric_type() {
  TypeDeclaration type = declare(
      Category::material, "dielectric",
      "Clear body: glass, crystal, liquid. Classic reading, with F the boundary's reflectance at the actual "
      "angle: mirror "
      "= F, k_t = 1 - F, refracted with the index for yellow light (line d, 587.56 nm); k_a = k_d = 0; lamps "
      "show as Phong "
      "highlights with n = (1/r^4 - 1)/2 within 1 to 1000 and k_s = F0 (n + 2)/2, at most 1, r the roughness; of "
      "a thin pane F is that of both faces, 2 F / (1 + F); a film is left out.");
  type.optional("glass", choice(dielectric_names()), "substance; gives the index for every wavelength")
      .optional("index", number().positive(), "refractive index for yellow light; 1.5 without `glass`")
      .optional("abbe", number().at_least(5),
                "Abbe number of `index`: how little colours part, 60 of crown glass, 25 of flint; none without it")
      .field("absorption", color().non_negative(), "mu per unit of length: light falls by e^(-mu l)", "0")
      .field(
          "scattering", color().non_negative(),
          "mu_s per unit of length: how often light is scattered on its way, in milk, wax, marble; the classic model "
          "leaves it out",
          "0")
      .field("forward", number().above(-1).below(1),
             "mean cosine of the angle by which scattered light is turned; 0: evenly to all sides", "0")
      .field("thin", boolean(), "true: a pane, both its faces in one surface; light goes straight through", "false")
      .field("priority", integer(), "where bodies overlap the substance of the highest priority counts", "0");
  declare_roughness(
      type, "roughness",
      "0: clear; more: frosted, and wider highlights. Light that meets several facets in a row is lost: of a "
      "ball of index 1.5 in an all white world 0.5 % at 0.1, 5 % at 0.3, 22 % at 0.5, 66 % at 1, most at its rim",
      "0");
  declare_thin_film(type);
  declare_normal_deviation(type);
  type.example("glass: N-BK7");
  return type.built_by([](const Fields& f) {
    if (f.has("glass") && f.has("index"))
      throw FieldError("index", "both 'glass' and 'index' are given", "the glass has its own index: leave one out");
    if (f.has("glass") && f.has("abbe"))
      throw FieldError("abbe", "both 'glass' and 'abbe' are given", "the glass has its own dispersion: leave one out");
    Dielectric dielectric;
    if (f.has("glass")) dielectric.glass = f.text("glass");
    if (f.has("index")) dielectric.index = f.number("index");
    if (f.has("abbe")) dielectric.abbe = f.number("abbe");
    dielectric.absorption = f.vec3("absorption");
    dielectric.roughness = roughness(f, "roughness");
    dielectric.thin = f.boolean("thin");
    dielectric.scattering = f.vec3("scattering");
    dielectric.forward = f.number("forward");
    if (dielectric.thin && dielectric.scattering != Vec3(0))
      throw FieldError("scattering", "a thin pane has no substance that could scatter",
                       "thin: false, or the material translucent_sheet");
    dielectric.film = thin_film(f);
    dielectric.priority = f.integer("priority");
    dielectric.normal_deviation = normal_deviation(f);
    return make_material(dielectric);
  });
}

}  // namespace lekalo::render
