// Lobes of clear coats: over a matt body (plastic, porcelain), and alone, to lie over other lobes.
#pragma once

#include "render/lobes/lobe.h"
#include "render/lobes/lobe_albedo.h"

namespace lekalo::render {

// The reflection of a coat of an index in air, smooth or of GGX facets.
struct CoatLobe {
  double roughness = 0;
  double index = 1.5;
  double facing = 0.04;                // reflectance of that index at right angles
  const LobeAlbedo* albedo = nullptr;  // coat_albedo of both

  Spectrum evaluate(const Vec3& out, const Vec3& in, const Sides& sides) const;
  double density(const Vec3& out, const Vec3& in, const Sides& sides) const;
  LobeSample sample(const Vec3& out, const Vec2& choice, const Vec2& square, const Sides& sides) const;
  double importance(const Vec3& out, const Sides&) const;
};

// A smooth one, without its table.
CoatLobe coat_lobe(double index);

// A coat over a matt body. With E the reflectance of the coat by angle and E_mean its mean, the body adds
//   f = albedo (1 - E(out)) (1 - E(in)) / (pi (1 - E_mean)):
// what a white body does not get because the coat mirrors it, is all that it does not return. The albedo is that of the
// body as it is seen through the coat, which throws some of its light back to it.
struct CoatedMattLobe {
  Spectrum albedo;
  CoatLobe coat;

  Spectrum evaluate(const Vec3& out, const Vec3& in, const Sides& sides) const;
  // Without the coat's own reflection.
  Spectrum evaluate_body(const Vec3& out, const Vec3& in) const;
  double density(const Vec3& out, const Vec3& in, const Sides& sides) const;
  LobeSample sample(const Vec3& out, const Vec2& choice, const Vec2& square, const Sides& sides) const;
  double importance(const Vec3& out, const Sides& sides) const;

 private:
  double coat_probability(const Vec3& out) const;
};

}  // namespace lekalo::render
