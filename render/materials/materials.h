// Materials as plain values for C++ programs: fill in a struct, make_material() it. Scene files build the same structs.
// What the `classic` integrator makes of each: integrators/classic_reading.h.
#pragma once

#include <string>

#include "render/materials/normal_deviation.h"
#include "render/materials/roughness.h"
#include "render/materials/textured_color.h"
#include "render/materials/thin_film.h"
#include "render/spectra/lamp_spectrum.h"

namespace lekalo::render {

// The coefficients of Golovanov 2016, 8.4 as they stand. All but `index`, `absorption`, `exponent` in [0, 1].
struct ClassicLook {
  TexturedColor color = 1.0;         // multiplies k_a and k_d
  TexturedColor ambient = 0.2;       // k_a
  TexturedColor diffuse = 0.8;       // k_d
  TexturedColor specular = 0.0;      // k_s of the Phong lobe
  double exponent = 20;              // n of the Phong lobe, >= 1
  TexturedColor mirror = 0.0;        // k_s of the traced reflection
  TexturedColor transmission = 0.0;  // k_t
  double transmission_exponent = 0;  // n of k_t cos(beta)^n of lamps behind, >= 1; 0: these do not show
  bool fresnel = false;              // mirror + transmission F and transmission (1 - F) take their places
  double index = 1;                  // refractive index of the substance behind the surface
  Vec3 absorption{0};                // mu of that substance, 1/length
  int priority = 0;                  // of that substance where media overlap
  TexturedColor emission = 0.0;
  bool two_sided = true;
  NormalDeviation normal_deviation;
};

struct Diffuse {
  TexturedColor color = 0.8;
  Roughness roughness = 0;  // in [0, 1]; 0: Lambert's
  NormalDeviation normal_deviation;
};

// A coloured body under a clear coat.
struct Plastic {
  TexturedColor color = 0.8;
  Roughness roughness = 0.4;  // in [0, 1]
  double index = 1.5;         // of the coat
  NormalDeviation normal_deviation;
};

struct Conductor {
  std::string metal = "Al";       // one of metal_names(); empty: `color`
  Roughness roughness = 0.2;      // in [0, 1]
  double anisotropy = 0;          // in [0, 1): 0 round highlights, towards 1 stretched ones
  double rotation = 0;            // radians, of the long direction of highlights, from r_u towards r_v
  TexturedColor color = 0.9;      // reflectance at right angles
  TexturedColor edge_tint = 1.0;  // its factor at 82 degrees
  ThinFilm film;                  // over a measured metal
  NormalDeviation normal_deviation;
};

// A clear body: glass, crystal, liquid.
struct Dielectric {
  std::string glass;  // one of dielectric_names(); empty: `index`
  double index = 1.5;
  double abbe = 0;          // Abbe number, by Cauchy's formula; 0: `index` for all wavelengths
  Vec3 absorption{0};       // 1/length
  Roughness roughness = 0;  // in [0, 1]
  int priority = 0;
  bool thin = false;   // a pane: both its faces in one, no substance behind
  Vec3 scattering{0};  // mu_s, 1/length: milky; needs the path tracer
  double forward = 0;  // mean cosine of its angles, in (-1, 1)
  ThinFilm film;       // of a pane: over one of its faces
  NormalDeviation normal_deviation;
};

// A matt body under a nap of fibres: velvet, felt.
struct Cloth {
  TexturedColor color = 0.5;
  double roughness = 0.5;  // of the body, in [0, 1]
  double sheen = 1;        // in [0, 1]
  TexturedColor sheen_color = 1.0;
  double sheen_roughness = 0.4;  // in [0, 1]
  NormalDeviation normal_deviation;
};

// A thin matt sheet that light comes through: paper, a lamp shade, a leaf.
struct TranslucentSheet {
  TexturedColor color = 0.5;         // share of the light that is reflected
  TexturedColor transmission = 0.3;  // share that comes through
  NormalDeviation normal_deviation;
};

// Two materials side by side in grains too small to be seen.
struct Mix {
  MaterialPtr first, second;
  TexturedColor share = 0.5;  // of the second
};

// A surface of layers by the parameters of OpenPBR 1.1 (Academy Software Foundation 2024), those of them that are here.
// Weights and roughnesses may come from textures.
struct Principled {
  double base_weight = 1;
  TexturedColor base_color = 0.8;
  Roughness base_metalness = 0;
  double specular_weight = 1;
  TexturedColor specular_color = 1.0;  // of metals: the tint at the edge
  Roughness specular_roughness = 0.3;
  double specular_roughness_anisotropy = 0;
  double specular_ior = 1.5;
  Roughness transmission_weight = 0;
  Vec3 transmission_color{1};
  double transmission_depth = 0;               // where transmission_color is reached; 0: at the surface
  Vec3 transmission_scatter{0};                // scattering coefficient times that depth
  double transmission_scatter_anisotropy = 0;  // in (-1, 1)
  double transmission_dispersion_scale = 0;    // in [0, 1]; 0: specular_ior for all wavelengths
  double transmission_dispersion_abbe_number = 20;
  Roughness coat_weight = 0;
  TexturedColor coat_color = 1.0;
  double coat_roughness = 0;
  double coat_ior = 1.6;
  Roughness fuzz_weight = 0;
  TexturedColor fuzz_color = 1.0;
  double fuzz_roughness = 0.5;
  double emission_luminance = 0;  // radiance, multiplies the colour
  TexturedColor emission_color = 1.0;
  NormalDeviation normal_deviation;
};

struct Emission {
  TexturedColor color = 1.0;
  double strength = 1;       // radiance is color times strength
  LampSpectrumPtr spectrum;  // for spectral rendering; then `color` is its colour
};

// Ground that shows nothing but the background and the shadows on it.
struct ShadowCatcher {
  double strength = 1;  // share of the light whose absence shows, in [0, 1]
};

// Throw std::invalid_argument for an unknown metal or glass.
MaterialPtr make_material(const ClassicLook& look);
MaterialPtr make_material(const Diffuse& diffuse);
MaterialPtr make_material(const Plastic& plastic);
MaterialPtr make_material(const Conductor& conductor);
MaterialPtr make_material(const Dielectric& dielectric);
MaterialPtr make_material(const Cloth& cloth);
MaterialPtr make_material(const TranslucentSheet& sheet);
// Throws std::invalid_argument if both have a substance behind them.
MaterialPtr make_material(const Mix& mix);
MaterialPtr make_material(const Principled& principled);
MaterialPtr make_material(const Emission& emission);
MaterialPtr make_material(const ShadowCatcher& catcher);

}  // namespace lekalo::render
