// Lobe of a clear boundary: glass, water, a soap bubble's skin.
#pragma once

#include "render/lobes/film.h"
#include "render/lobes/lobe.h"

namespace lekalo::render {

// Fresnel's reflectance F of the indices on both sides; what is not reflected is refracted. Smooth, or of GGX facets
// (Walter et al. 2007), whose further bounces are left out: rough glass loses a little light.
//   reflection    f = F D G / (4 in.z out.z)
//   transmission  f = (1 - F) D G |in.h| |out.h| / (|in.z out.z| (in.h + out.h / eta)^2),  eta = behind / near,
// for radiance over the square of the index. `thin`: both faces of a pane, which is `index` against both sides; light
// goes straight on, reflectance of all bounces within 2 F / (1 + F).
struct ClearLobe {
  double roughness = 0;
  double index = 1.5;    // of thin panes
  double facing = 0.04;  // reflectance at right angles against air, at the yellow line d
  bool thin = false;
  Spectrum tint{1.0f};  // of what passes
  const FilmTable* film =
      nullptr;              // over the body, of panes over one face; it takes the place of Fresnel's reflectance
  double thickness = 0;     // of the film, nanometres
  Wavelengths wavelengths;  // of the lanes, for the film

  Spectrum evaluate(const Vec3& out, const Vec3& in, const Sides& sides) const;
  double density(const Vec3& out, const Vec3& in, const Sides& sides) const;
  LobeSample sample(const Vec3& out, const Vec2& choice, const Vec2& square, const Sides& sides) const;
  double importance(const Vec3&, const Sides&) const { return 1; }
  Spectrum straight_share(const Vec3& out, const Sides& sides) const;
  bool smooth(const Sides& sides) const;

 private:
  double pane_reflectance(double cosine, const Sides& sides) const;
  // Of the whole; `cosine` of the angle to the facet's normal on the viewer's side.
  Spectrum reflectance(double cosine, const Sides& sides) const;
  LobeSample smooth_sample(const Vec3& out, double choice, const Sides& sides) const;
};

}  // namespace lekalo::render
