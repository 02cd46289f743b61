// What lobes have in common. A lobe is one way in which a surface passes light on: matt, a highlight, a mirror, a clear
// boundary. It is a plain value that a material fills in, and answers three questions in the surface's own frame, z the
// shading normal on the viewer's side, `out` (z > 0) the unit direction to the viewer, `in` the one where light comes
// from (z < 0: from behind):
//
//   evaluate  f |in.z|, f the bidirectional scattering distribution function, 1/sr: what a unit of radiance from `in`
//             adds to the radiance towards `out`; without the mirror directions of sharp lobes
//   density   of sample(), per unit of solid angle
//   sample    a direction `in` of about that density
//
// Radiance is that divided by the square of the refractive index of the place, which refraction does not change.
#pragma once

#include <optional>

#include "render/spectrum.h"

namespace lekalo::render {

// Refractive indices on the viewer's side of the surface and behind it.
struct Sides {
  double near = 1;
  double behind = 1;
};

struct LobeSample {
  Vec3 in{0, 0, 1};
  bool sharp = false;  // the only direction of a mirror or of smooth glass: `density` is the probability of the choice
  double density = 0;
  Spectrum value;  // evaluate(); of a sharp sample the share of the light from there
};

// Area-preserving map of the unit square to directions about z with the density cos / pi.
Vec3 cosine_direction(const Vec2& square);
inline double cosine_density(const Vec3& in) { return in.z > 0 ? in.z / geometry::kPi : 0; }

}  // namespace lekalo::render
