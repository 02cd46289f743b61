// Lights as plain values for C++ programs: fill in a struct, make_light() it. Scene files build the same structs.
// What `intensity` means is said in light.h.
#pragma once

#include "geometry/describe.h"
#include "render/image/image.h"
#include "render/light.h"
#include "render/lights/ies_profile.h"
#include "render/spectra/lamp_spectrum.h"

namespace lekalo::render {

// What all lights that have a place or direction share.
struct Lamp {
  Vec3 color{1};         // linear Rec.709, multiplies the intensity
  double intensity = 1;  // >= 0
  bool inverse_square = false;
  bool shadows = true;
  LampSpectrumPtr spectrum;  // for spectral rendering; then `color` is its colour. Null: the colour alone is known
};

// How an area is sampled: n x n places.
struct AreaSampling {
  int n = 4;          // >= 1
  bool grid = false;  // fixed places, evenly from edge to edge (one place: the middle); false: one random place in each
                      // of n x n strata
};

struct PointLight {
  Vec3 position{0};
  Lamp lamp;
};

// Cone of light: full inside `inner_angle` from the axis, nothing outside `angle`, between them the smooth step
// s^2 (3 - 2 s) of the cosine.
struct SpotLight {
  Vec3 position{0};
  Vec3 direction{0, 0, -1};                // unit, along the axis of the cone
  double angle = geometry::kPi / 6;        // half the opening, radians, in (0, pi/2]
  double inner_angle = geometry::kPi / 6;  // in [0, angle]
  Lamp lamp;
};

// From infinitely far away, evenly from a disc of the sky.
struct DistantLight {
  Vec3 direction{0, 0, -1};     // unit, the way the light goes
  double angular_diameter = 0;  // of the disc, radians, in [0, pi); 0: parallel rays
  AreaSampling sampling;
  Lamp lamp;
};

// Rectangle in the xy plane of its frame, centred at the origin.
struct RectangleLight {
  geometry::Frame frame;
  Vec2 size{1};            // along x and y
  bool one_sided = false;  // shines to the side of z only, with the cosine of the angle to z (a matt emitter)
  AreaSampling sampling;
  Lamp lamp;
};

struct DiscLight {
  geometry::Frame frame;
  double radius = 0.5;
  bool one_sided = false;  // as for RectangleLight
  AreaSampling sampling;
  Lamp lamp;
};

// Evenly bright over the disc as which it is seen.
struct SphereLight {
  Vec3 center{0};
  double radius = 0.5;
  AreaSampling sampling;
  Lamp lamp;
};

// A panorama all around, see environment_light.cpp.
struct EnvironmentLight {
  Image image;          // equirectangular, with colour
  double rotation = 0;  // radians
  Vec3 color{1};
  double intensity = 1;
  bool visible = true;  // stands in place of the background
  bool shadows = true;
  AreaSampling sampling;
};

// A luminaire: z of the frame is its axis.
struct ProfileLight {
  geometry::Frame frame;
  IesProfile profile;
  Lamp lamp;  // of the direction of the largest intensity
};

struct AmbientLight {
  Vec3 color{1};
  double intensity = 1;
};

LightPtr make_light(const PointLight& light);
LightPtr make_light(const SpotLight& light);
LightPtr make_light(const DistantLight& light);
LightPtr make_light(const RectangleLight& light);
LightPtr make_light(const DiscLight& light);
LightPtr make_light(const SphereLight& light);
// Throws std::invalid_argument for a picture without colour, or with a pixel that is no finite number.
LightPtr make_light(const EnvironmentLight& light);
LightPtr make_light(const ProfileLight& light);
LightPtr make_light(const AmbientLight& light);

// Light of a source at the wavelengths, for the colour that it tells: by the lamp's own spectrum, or upsampled.
Spectrum light_of(const Light& light, const Spectrum& color, const Wavelengths& wavelengths);

// For the lights' own files.

// A light whose values hold a Lamp.
class SpectralLight : public Light {
 public:
  explicit SpectralLight(const Lamp& lamp) : spectrum_(lamp.spectrum) {}
  const LampSpectrum* spectrum() const { return spectrum_.get(); }

 private:
  LampSpectrumPtr spectrum_;
};

// E at right angles by distance.
class Irradiance {
 public:
  explicit Irradiance(const Lamp& lamp);
  Spectrum at(double distance) const {
    return inverse_square_ ? static_cast<float>(1 / (distance * distance)) * at_one_ : at_one_;
  }

 private:
  Spectrum at_one_;
  bool inverse_square_;
};
// Place of sample `index` in the unit square.
Vec2 area_sample(const AreaSampling& sampling, int index, double r1, double r2);
// The unit square onto the unit disc, area preserving (Shirley and Chiu 1997).
Vec2 concentric_disc(const Vec2& square);

// That of a round source, whose samples fill a cone evenly in solid angle (area_sample on concentric_disc): of such a
// strength that a surface that faces the middle receives of all of them what it would of one light there.
// `height`: 1 - the cosine of half the cone's opening.
class RoundIrradiance {
 public:
  RoundIrradiance(const Lamp& lamp, const AreaSampling& sampling);
  Spectrum at(double distance, double height) const {
    return static_cast<float>(1 / mean_cosine(height)) * irradiance_.at(distance);
  }
  // Of the angles between the samples and the middle.
  double mean_cosine(double height) const { return 1 - mean_square_ * height; }

 private:
  Irradiance irradiance_;
  double mean_square_;  // of the samples' distances from the disc's centre
};

// Fields color, spectrum, temperature, intensity, shadows, and decay where `with_decay`.
void declare_lamp(geometry::TypeDeclaration& type, bool with_decay = true);
Lamp lamp(const geometry::Fields& fields);
// Fields samples and sampling.
void declare_area_sampling(geometry::TypeDeclaration& type);
AreaSampling area_sampling(const geometry::Fields& fields);

}  // namespace lekalo::render
