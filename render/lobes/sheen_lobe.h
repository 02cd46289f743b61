// Lobe of cloth: light that fibres which stand up from the surface scatter back at grazing angles.
#pragma once

#include "render/lobes/lobe.h"
#include "render/lobes/lobe_albedo.h"

namespace lekalo::render {

// f of a white sheen: D(h) = (2 + 1/r) sin(h)^(1/r) / (2 pi) (Estevez and Kulla 2017), visibility 1 / (4 (out.z + in.z
// - out.z in.z)) (Neubelt and Pettineo 2013). r is the roughness within [0.25, 1], where it sends back no more light
// than falls on it.
double sheen(double roughness, const Vec3& out, const Vec3& in);

struct SheenLobe {
  Spectrum color;
  double roughness = 0.3;
  const LobeAlbedo* albedo = nullptr;  // sheen_albedo of it

  Spectrum evaluate(const Vec3& out, const Vec3& in, const Sides&) const;
  double density(const Vec3&, const Vec3& in, const Sides&) const { return in.z > 0 ? 1 / geometry::kTwoPi : 0; }
  LobeSample sample(const Vec3& out, const Vec2& choice, const Vec2& square, const Sides& sides) const;
  double importance(const Vec3& out, const Sides&) const { return color.largest() * albedo->at(out); }
};

}  // namespace lekalo::render
