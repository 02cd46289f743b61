// Ground that looks like the background except where lights do not reach it.
#include "render/lobes/scattering.h"
#include "render/materials/materials.h"
#include "render/spectra/hero_wavelengths.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class ShadowCatcherMaterial final : public Material {
 public:
  explicit ShadowCatcherMaterial(const ShadowCatcher& catcher) : catcher_(catcher) {}
  Scattering scattering(const SurfacePoint&, const Wavelengths& wavelengths) const override {
    Scattering s;
    s.lobes.add(LambertLobe{static_cast<float>(catcher_.strength) * whole(wavelengths)});
    s.catches_shadows = true;
    return s;
  }
  bool uses_parameters() const override { return false; }
  Spectrum albedo(const SurfacePoint&, const Wavelengths&) const override { return {}; }
  std::any made_from() const override { return catcher_; }

 private:
  ShadowCatcher catcher_;
};

}  // namespace

MaterialPtr make_material(const ShadowCatcher& catcher) { return std::make_shared<ShadowCatcherMaterial>(catcher); }

TypeDeclaration shadow_catcher_type() {
  return declare(
             Category::material, "shadow_catcher",
             "Ground that shows only the background and the shadows on it; not seen from behind. Classic reading: the "
             "background times 1 - strength (1 - light received / light received without obstacles); alpha is the "
             "share "
             "taken away.")
      .field("strength", number().between(0, 1), "of the shadows", "1")
      .built_by([](const Fields& f) { return make_material(ShadowCatcher{f.number("strength")}); });
}

}  // namespace lekalo::render
