// Lobes of metals, smooth or rough.
#pragma once

#include "render/lobes/film.h"
#include "render/lobes/lobe.h"
#include "render/lobes/lobe_albedo.h"
#include "render/lobes/microfacet.h"

namespace lekalo::render {

// Reflectance by angle: Fresnel's with the complex index n - i k; or, with n zero, a colour at right angles and a tint
// at 82 degrees over Schlick's curve (Hoffman, "Generalization of Adobe's Fresnel model", 2023):
//   F(c) = F0 + (1 - F0) (1 - c)^5 - b c (1 - c)^6,
//   b = (F0 + (1 - F0) (6/7)^5) (1 - tint) / ((1/7) (6/7)^6).
struct MetalReflectance {
  Spectrum n, k;
  Spectrum color, edge_tint{1.0f};
  const FilmTable* film = nullptr;  // over the metal, in place of all these
  double thickness = 0;             // of the film, nanometres
  Wavelengths wavelengths;          // of the lanes, for the film

  bool measured() const { return !n.is_zero(); }
  // From a side of the given index.
  Spectrum at(double cosine, double near = 1) const;
  // 2 times the integral of F c dc: of colours closed; of measured metals a sum, to be made once and kept.
  Spectrum mean() const;

 private:
  Spectrum tinted(double schlick, double dip) const;
};

// GGX mirrors (microfacet.h): f = F D G / (4 in.z out.z), and the light of further bounces between the facets,
//   F_more (1 - E(out)) (1 - E(in)) / (pi (1 - E_mean)),  F_more = F_mean^2 E_mean / (1 - F_mean (1 - E_mean))
// (Kulla and Conty 2017).
struct MetalLobe {
  MetalReflectance reflectance;
  double roughness = 0;
  double anisotropy = 0;
  double rotation = 0;                 // radians, of the long direction of highlights, from the frame's x towards y
  const LobeAlbedo* albedo = nullptr;  // mirror_albedo of the two; none: no further bounces
  Spectrum mean;                       // reflectance.mean(), for these

  Spectrum evaluate(const Vec3& out, const Vec3& in, const Sides& sides) const;
  double density(const Vec3& out, const Vec3& in, const Sides& sides) const;
  LobeSample sample(const Vec3& out, const Vec2& choice, const Vec2& square, const Sides& sides) const;
  double importance(const Vec3& out, const Sides& sides) const { return reflectance.at(out.z, sides.near).largest(); }

 private:
  Vec3 turned(const Vec3& w, double angle) const;
  double further_share(const Vec3& w) const;
};

}  // namespace lekalo::render
