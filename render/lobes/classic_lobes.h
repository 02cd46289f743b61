// Lobes of the classic light model (Golovanov 2016, 8.4).
#pragma once

#include "render/lobes/lobe.h"

namespace lekalo::render {

// Phong's highlight: radiance height / pi times irradiance times cos(alpha)^exponent, alpha the angle from the mirror
// direction. As a lobe it has the factor in.z as well, f = height cos(alpha)^n / pi: it reflects at most
// 2 height / (n + 2) of the light (Lafortune and Willems 1994).
struct PhongLobe {
  Spectrum height;
  double exponent = 1;  // >= 1

  Spectrum evaluate(const Vec3& out, const Vec3& in, const Sides&) const;
  double density(const Vec3& out, const Vec3& in, const Sides&) const;
  LobeSample sample(const Vec3& out, const Vec2& choice, const Vec2& square, const Sides& sides) const;
  double importance(const Vec3&, const Sides&) const { return 2 * height.largest() / (exponent + 2); }
};

// A smooth boundary: the shares of the mirrored and of the refracted ray. With Fresnel's reflectance F of the two sides
// these are mirror + F transmission and (1 - F) transmission. Total reflection adds the transmission to the mirror.
struct BoundaryLobe {
  Spectrum mirror, transmission;
  bool fresnel = false;
  double spread = 0;  // of the classic model: exponent of the light of lamps behind, directed transmission; 0: none

  Spectrum evaluate(const Vec3&, const Vec3&, const Sides&) const { return {}; }
  double density(const Vec3&, const Vec3&, const Sides&) const { return 0; }
  LobeSample sample(const Vec3& out, const Vec2& choice, const Vec2& square, const Sides& sides) const;
  double importance(const Vec3&, const Sides&) const { return (mirror + transmission).largest(); }
  Spectrum straight_share(const Sides& sides) const { return sides.near == sides.behind ? transmission : Spectrum(); }
};

// Directions of a smooth boundary; none for total reflection.
inline Vec3 mirrored(const Vec3& out) { return {-out.x, -out.y, out.z}; }
std::optional<Vec3> refracted_behind(const Vec3& out, const Sides& sides);

}  // namespace lekalo::render
