// Two materials in grains too small to be seen: dust, a worn coat, a mask from a texture.
#include <fmt/format.h>

#include <stdexcept>

#include "render/lobes/scattering.h"
#include "render/materials/materials.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Of the light of ambient lights in the classic model.
Spectrum matt_ambient(const Scattering& scattering) {
  return scattering.ambient.value_or(matt_reflectance(scattering));
}

class MixedMaterial final : public Material {
 public:
  explicit MixedMaterial(const Mix& mix) : mix_(mix), lobe_count_(lobe_count(*mix.first) + lobe_count(*mix.second)) {}

  // Of all grains, whatever the share.
  int lobe_count() const { return lobe_count_; }
  static int lobe_count(const Material& material) {
    const auto* mixed = dynamic_cast<const MixedMaterial*>(&material);
    return mixed ? mixed->lobe_count() : material.scattering({}, Wavelengths{}).lobes.size();
  }

  Scattering scattering(const SurfacePoint& point, const Wavelengths& wavelengths) const override {
    const Spectrum share = mix_.share.share_at(point, wavelengths), rest = whole(wavelengths) - share;
    const Scattering first = mix_.first->scattering(point, wavelengths);
    const Scattering second = mix_.second->scattering(point, wavelengths);
    Scattering s;
    s.lobes.append(first.lobes, rest);
    s.lobes.append(second.lobes, share);
    s.emission = rest * first.emission + share * second.emission;
    s.two_sided = first.two_sided || second.two_sided;
    if (first.ambient || second.ambient) s.ambient = rest * matt_ambient(first) + share * matt_ambient(second);
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
  int lobe_count_;
};

struct Fault {
  std::string field, message, hint;
};

std::optional<Fault> fault(const Mix& mix) {
  for (const auto& [field, material] : {std::pair("first", mix.first), std::pair("second", mix.second)})
    if (material->scattering({}, Wavelengths{}).catches_shadows)
      return Fault{field, "a shadow_catcher cannot be mixed", "give it to an object of its own"};
  if (mix.first->interior(Wavelengths{}) && mix.second->interior(Wavelengths{}))
    return Fault{"second", "both materials of the mix have a substance behind them",
                 "mix a clear material with one that is opaque or thin"};
  const int count = MixedMaterial::lobe_count(*mix.first) + MixedMaterial::lobe_count(*mix.second);
  if (count > LobeList::kMaxLobes)
    return Fault{
        "second",
        fmt::format("the mix has {} lobes, more than the {} that a surface can have", count, LobeList::kMaxLobes),
        "mix fewer materials, or such of fewer layers"};
  return std::nullopt;
}

}  // namespace

MaterialPtr make_material(const Mix& mix) {
  if (const std::optional<Fault> found = fault(mix)) throw std::invalid_argument(found->message);
  return std::make_shared<MixedMaterial>(mix);
}

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
        if (const std::optional<Fault> found = fault(mix)) throw FieldError(found->field, found->message, found->hint);
        return make_material(mix);
      });
}

}  // namespace lekalo::render
