// Materials as plain values for C++ programs: fill in a struct, make_material() it. Scene files build the same structs.
// What the `classic` integrator makes of each is stated at its declaration, in the file of its name.
#pragma once

#include <string>

#include "render/materials/normal_deviation.h"
#include "render/materials/textured_color.h"

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
  NormalDeviation normal_deviation;
};

// A coloured body under a clear coat.
struct Plastic {
  TexturedColor color = 0.8;
  double roughness = 0.4;  // in [0, 1]
  double index = 1.5;      // of the coat
  NormalDeviation normal_deviation;
};

struct Conductor {
  std::string metal = "Al";  // one of metal_names()
  double roughness = 0.2;    // in [0, 1]
  NormalDeviation normal_deviation;
};

// A clear body: glass, crystal, liquid.
struct Dielectric {
  std::string glass;  // one of dielectric_names(); empty: `index`
  double index = 1.5;
  Vec3 absorption{0};      // 1/length
  double roughness = 0.1;  // of highlights
  int priority = 0;
  NormalDeviation normal_deviation;
};

struct Emission {
  TexturedColor color = 1.0;
  double strength = 1;  // radiance is color times strength
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
MaterialPtr make_material(const Emission& emission);
MaterialPtr make_material(const ShadowCatcher& catcher);

}  // namespace lekalo::render
