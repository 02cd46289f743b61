// How light is turned in substances that scatter it (L. Henyey, J. Greenstein, "Diffuse radiation in the galaxy",
// 1941).
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/vectors.h"
#include "render/spectrum.h"

namespace lekalo::render {

// Density of directions, 1/sr, by the cosine of the angle that light is turned by; g: the mean of that cosine.
inline double phase(double cosine, double g) {
  const double width = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (4 * geometry::kPi * width * std::sqrt(width));
}

// A direction of that density about `along`.
inline Vec3 phase_direction(const Vec3& along, double g, const Vec2& square) {
  const double part = (1 - g * g) / (1 - g + 2 * g * square.x);
  const double cosine = std::fabs(g) < 1e-3 ? 1 - 2 * square.x : (1 + g * g - part * part) / (2 * g);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)), angle = geometry::kTwoPi * square.y;
  return geometry::frame_about(Vec3(0), along).direction({sine * std::cos(angle), sine * std::sin(angle), cosine});
}

}  // namespace lekalo::render
