// A thin matt sheet that light comes through: paper, a lamp shade, a leaf.
#include "render/lobes/scattering.h"
#include "render/materials/materials.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class SheetMaterial final : public Material {
 public:
  explicit SheetMaterial(const TranslucentSheet& sheet) : sheet_(sheet) {}

  Scattering scattering(const SurfacePoint& point, const Wavelengths& wavelengths) const override {
    SheetLobe lobe{sheet_.color.at(point, wavelengths), sheet_.transmission.at(point, wavelengths)};
    const float most = (lobe.reflectance + lobe.transmittance).largest();
    if (most > 1) {  // of textures, which nobody has checked, and of spectra
      lobe.reflectance *= 1 / most;
      lobe.transmittance *= 1 / most;
    }
    Scattering s;
    s.lobes.add(lobe);
    return s;
  }
  bool uses_parameters() const override {
    return sheet_.color.texture() || sheet_.transmission.texture() || sheet_.normal_deviation.amplitude != 0;
  }
  Vec3 shading_normal(const SurfacePoint& point) const override {
    return deviated_normal(point, sheet_.normal_deviation);
  }
  uint64_t cell(const SurfacePoint& point) const override {
    return hash_combine(deviation_cell(point, sheet_.normal_deviation), sheet_.color.cell(point));
  }
  std::any made_from() const override { return sheet_; }

 private:
  TranslucentSheet sheet_;
};

}  // namespace

MaterialPtr make_material(const TranslucentSheet& sheet) { return std::make_shared<SheetMaterial>(sheet); }

TypeDeclaration translucent_sheet_type() {
  TypeDeclaration type = declare(Category::material, "translucent_sheet",
                                 "Thin matt sheet that light comes through, spread evenly: paper, a lamp shade, a "
                                 "leaf. Classic reading: k_a = k_d = color, opaque.");
  type.field("color", textured_share(), "share of the light that is reflected", "0.5")
      .field("transmission", textured_share(), "share that comes through; with `color` at most 1", "0.3");
  declare_normal_deviation(type);
  type.example("color: [0.5, 0.45, 0.3], transmission: [0.4, 0.35, 0.2]");
  return type.built_by([](const Fields& f) {
    const TranslucentSheet sheet{color_texture(f, "color"), color_texture(f, "transmission"), normal_deviation(f)};
    if (!sheet.color.texture() && !sheet.transmission.texture() &&
        (sheet.color.at({}) + sheet.transmission.at({})).largest() > 1.00001f)
      throw FieldError("transmission", "the sheet reflects and lets through more light than falls on it",
                       "'color' and 'transmission' add up to 1 at most, for each of red, green and blue");
    return make_material(sheet);
  });
}

}  // namespace lekalo::render
