// The classic light model as it stands (Golovanov 2016, 8.4.2-8.4.5): ambient, Lambert, Phong, mirror, refraction,
// absorption and emission, each coefficient a number, a colour or a texture.
#include <vector>

#include "render/lobes/scattering.h"
#include "render/materials/materials.h"

namespace lekalo::render {

using namespace geometry;

namespace {

class ClassicMaterial final : public Material {
 public:
  explicit ClassicMaterial(const ClassicLook& look) : look_(look) {
    for (const TexturedColor* color : {&look_.color, &look_.ambient, &look_.diffuse, &look_.specular, &look_.mirror,
                                       &look_.transmission, &look_.emission})
      if (color->texture()) textures_.push_back(color->texture());
    if (textures_.empty()) same_everywhere_ = at({}, {});
    if (!look_.transmission.is_black())
      interior_ = Medium{static_cast<float>(look_.index), rgb(look_.absorption), look_.priority};
    is_even_ = textures_.empty() && look_.normal_deviation.amplitude == 0;
  }

  Scattering scattering(const SurfacePoint& point, const Wavelengths& wavelengths) const override {
    return textures_.empty() && !is_spectral(wavelengths) ? same_everywhere_ : at(point, wavelengths);
  }

  std::optional<Medium> interior(const Wavelengths& wavelengths) const override {
    std::optional<Medium> medium = interior_;
    if (medium) medium->absorption = upsampled_light(medium->absorption, wavelengths);
    return medium;
  }

  bool transmits() const override { return interior_.has_value(); }
  bool uses_parameters() const override { return !is_even_; }
  Vec3 shading_normal(const SurfacePoint& point) const override {
    return is_even_ ? point.normal : deviated_normal(point, look_.normal_deviation);
  }

  uint64_t cell(const SurfacePoint& point) const override {
    if (is_even_) return 0;
    uint64_t hash = deviation_cell(point, look_.normal_deviation);
    for (const TexturePtr& texture : textures_) hash = hash_combine(hash, texture->cell(point));
    return hash;
  }
  std::any made_from() const override { return look_; }

 private:
  Scattering at(const SurfacePoint& point, const Wavelengths& wavelengths) const {
    Scattering s;
    const Spectrum color = look_.color.at(point, wavelengths);
    s.emission = look_.emission.light_at(point, wavelengths);
    s.ambient = color * look_.ambient.at(point, wavelengths);
    const Spectrum diffuse = color * look_.diffuse.at(point, wavelengths),
                   specular = look_.specular.at(point, wavelengths);
    if (!diffuse.is_zero()) s.lobes.add(LambertLobe{diffuse});
    if (!specular.is_zero()) s.lobes.add(PhongLobe{specular, look_.exponent});
    const BoundaryLobe boundary{look_.mirror.at(point, wavelengths), look_.transmission.at(point, wavelengths),
                                look_.fresnel, look_.transmission_exponent};
    if (!boundary.mirror.is_zero() || !boundary.transmission.is_zero()) s.lobes.add(boundary);
    s.two_sided = look_.two_sided;
    s.unbalanced = true;
    return s;
  }

  ClassicLook look_;
  std::vector<TexturePtr> textures_;  // of all coefficients
  Scattering same_everywhere_;        // where there are none
  std::optional<Medium> interior_;    // where light passes
  bool is_even_ = true;               // neither textures nor deviations of the normal
};

}  // namespace

MaterialPtr make_material(const ClassicLook& look) { return std::make_shared<ClassicMaterial>(look); }

TypeDeclaration classic_look_type() {
  TypeDeclaration type = declare(
      Category::material, "classic",
      "The classic light model: I = k_a I_a + sum of I_p (k_d cos(theta) + k_s cos(alpha)^n) over the lights, with "
      "traced mirror reflection and refraction. A coefficient is a number, a colour or a texture.");
  type.field("color", textured_share(), "multiplies ambient and diffuse", "1")
      .field("ambient", textured_share(), "k_a: share of the ambient light", "0.2")
      .field("diffuse", textured_share(), "k_d: Lambert's reflection", "0.8")
      .field("specular", textured_share(), "k_s: height of Phong's highlight", "0")
      .field("exponent", number().at_least(1), "n: larger is sharper; about 1 to 200", "20")
      .field("mirror", textured_share(), "share of the traced mirror reflection", "0")
      .field("transmission", textured_share(), "k_t: share of the traced refracted ray", "0")
      .optional(
          "transmission_exponent", number().at_least(1),
          "lamps behind the surface shine through it with k_t cos(beta)^n, beta between their refracted light and "
          "the way to the viewer; without it they do not show")
      .field("fresnel", boolean(),
             "at angle-dependent reflectance F, reflect mirror + F transmission and let (1 - F) transmission through",
             "false")
      .field("index", number().positive(), "refractive index behind the surface; 1: light passes straight", "1")
      .field("absorption", color().non_negative(),
             "mu behind the surface, per unit of length: light falls by e^(-mu l)", "0")
      .field("priority", integer(), "where bodies overlap the substance of the highest priority counts", "0")
      .field("emission", textured_color(), "radiance added whatever the light", "0")
      .field("two_sided", boolean(), "false: the back shows only ambient light and emission", "true");
  declare_normal_deviation(type);
  type.example("color: [0.75, 0.25, 0.2], specular: 0.5, exponent: 40");
  return type.built_by([](const Fields& f) {
    ClassicLook look;
    look.color = color_texture(f, "color");
    look.ambient = color_texture(f, "ambient");
    look.diffuse = color_texture(f, "diffuse");
    look.specular = color_texture(f, "specular");
    look.exponent = f.number("exponent");
    look.mirror = color_texture(f, "mirror");
    look.transmission = color_texture(f, "transmission");
    if (f.has("transmission_exponent")) look.transmission_exponent = f.number("transmission_exponent");
    look.fresnel = f.boolean("fresnel");
    look.index = f.number("index");
    look.absorption = f.vec3("absorption");
    look.priority = f.integer("priority");
    look.emission = color_texture(f, "emission");
    look.two_sided = f.boolean("two_sided");
    look.normal_deviation = normal_deviation(f);
    return make_material(look);
  });
}

}  // namespace lekalo::render
