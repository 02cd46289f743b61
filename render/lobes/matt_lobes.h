// Lobes of matt surfaces.
#pragma once

#include "render/lobes/lobe.h"

namespace lekalo::render {

// Lambert: f = albedo / pi.
struct LambertLobe {
  Spectrum albedo;

  Spectrum evaluate(const Vec3& out, const Vec3& in, const Sides&) const;
  double density(const Vec3&, const Vec3& in, const Sides&) const { return cosine_density(in); }
  LobeSample sample(const Vec3& out, const Vec2& choice, const Vec2& square, const Sides& sides) const;
  double importance(const Vec3&, const Sides&) const { return albedo.largest(); }
};

// Oren and Nayar's rough matt surface in Fujii's form, with the light of further bounces between its facets added, so
// that a white surface loses nothing (Portsmouth, Kutz, Hill, "EON: A practical energy-preserving rough diffuse BRDF",
// 2024). With r the roughness in [0, 1], A = 1 / (1 + (1/2 - 2/(3 pi)) r), s = in.out - in.z out.z, t = max(in.z,
// out.z) where s > 0, else 1:
//   f = albedo A (1 + r s / t) / pi + a (1 - E(out)) (1 - E(in)) / (pi (1 - E_mean)),
//   a = albedo^2 E_mean / (1 - albedo (1 - E_mean)),
// E the reflectance of the first term at albedo 1, E_mean its mean over the cosine.
struct RoughMattLobe {
  Spectrum albedo;
  double roughness = 0;

  Spectrum evaluate(const Vec3& out, const Vec3& in, const Sides&) const;
  double density(const Vec3&, const Vec3& in, const Sides&) const { return cosine_density(in); }
  LobeSample sample(const Vec3& out, const Vec2& choice, const Vec2& square, const Sides& sides) const;
  double importance(const Vec3&, const Sides&) const { return albedo.largest(); }
};

// A thin matt sheet, paper or a leaf: Lambert to both sides.
struct SheetLobe {
  Spectrum reflectance, transmittance;  // their sum is at most 1

  Spectrum evaluate(const Vec3& out, const Vec3& in, const Sides&) const;
  double density(const Vec3& out, const Vec3& in, const Sides&) const;
  LobeSample sample(const Vec3& out, const Vec2& choice, const Vec2& square, const Sides& sides) const;
  double importance(const Vec3&, const Sides&) const { return (reflectance + transmittance).largest(); }

 private:
  double reflected_share() const;
};

}  // namespace lekalo::render
