// Two materials in grains too small to be seen: dust, a worn coat, a mask from a texture.
#include <stdexcept>

#include "render/lobes/scattering.h"
#include "render/materials/materials.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class MixedMaterial final : public Material {
 public:
  explicit MixedMaterial(const Mix& mix) : mix_(mix) {
    if (mix.first->interior(Wavelengths{}) && mix.second->interior(Wavelengths{}))
      throw std::invalid_argument("both materials of the mix have a substance behind them");
  }

  Scattering scattering(const SurfacePoint& point, const Wavelengths& wavelengths) const override {
    const Spectrum share = mix_.share.at(point);
    const Scattering first = mix_.first->scattering(point, wavelengths);
    const Scattering second = mix_.second->scattering(point, wavelengths);
    Scattering s;
    s.lobes.append(first.lobes, Spectrum(1, 1, 1) - share);
    s.lobes.append(second.lobes, share);
    s.emission = (Spectrum(1, 1, 1) - share) * first.emission + share * second.emission;
    s.two_sided = first.two_sided || second.two_sided;
    s.unbalanced = first.unbalanced || second.unbalanced;
    return s;
  }
  std::optional<Medium> interior(const Wavelengths& wavelengths) const override {
    const auto medium = mix_.first->interior(wavelengths);
    return medium ? medium : mix_.second->interior(wavelengths);
  }
  bool transmits() const override { return mix_.first->transmits() || mix_.second->transmits(); }
  bool uses_parameters() const override {
    return mix_.share.texture() || mix_.first->uses_parameters() || mix_.second->uses_parameters();
  }
  Vec3 shading_normal(const SurfacePoint& point) const override { return mix_.first->shading_normal(point); }
  uint64_t cell(const SurfacePoint& point) const override {
    return hash_combine(hash_combine(mix_.share.cell(point), mix_.first->cell(point)), mix_.second->cell(point));
  }
  std::any made_from() const override { return mix_; }

 private:
  Mix mix_;
};

}  // namespace

MaterialPtr make_material(const Mix& mix) { return std::make_shared<MixedMaterial>(mix); }

TypeDeclaration mix_type() {
  return declare(Category::material, "mix",
                 "Two materials in grains too small to be seen, or side by side by a texture. Classic reading: the "
                 "coefficients of both by their shares, highlight and mirror of the last one that has them.")
      .field("first", reference({Category::material}), "where the share is 0; its bumps are those of the mix")
      .field("second", reference({Category::material}), "where the share is 1")
      .field("share", textured_share(), "of the second material", "0.5")
      .example("first: { type: diffuse, color: 0.6 }, second: { type: conductor, metal: Au }, share: 0.3")
      .built_by([](const Fields& f) {
        const Mix mix{f.get<MaterialPtr>("first"), f.get<MaterialPtr>("second"), color_texture(f, "share")};
        if (mix.first->interior(Wavelengths{}) && mix.second->interior(Wavelengths{}))
          throw FieldError("second", "both materials of the mix have a substance behind them",
                           "mix a clear material with one that is opaque or thin");
        return make_material(mix);
      });
}

}  // namespace lekalo::render
