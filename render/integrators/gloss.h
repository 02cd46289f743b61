// From roughness to the Phong lobe and the mirror of the classic model.
//
// With alpha = roughness^2 (the usual perceptual scale of microfacet models) the half-vector lobe of a GGX surface has
// the exponent 2 / alpha^2 - 2, and Phong's lobe about the mirror direction a quarter of it (Walter et al. 2007;
// Golovanov 2016, 8.4 has n between 1 and about 200; here between 1 and 1000).
#pragma once

#include <algorithm>

namespace lekalo::render {

inline float phong_exponent(double roughness) {
  const double alpha = roughness * roughness;
  return alpha <= 0 ? 1000.0f : static_cast<float>(std::clamp((2 / (alpha * alpha) - 2) / 4, 1.0, 1000.0));
}

// Height of the lobe of a surface that reflects the share `reflectance` of the light into it: the factor (n + 2) / 2 of
// the energy-conserving lobe (Lafortune and Willems 1994), but never more than a mirror image of the lamp would give.
inline double phong_height(double exponent, double reflectance) {
  return std::min(1.0, reflectance * (exponent + 2) / 2);
}

// Share of the reflection that is traced as a sharp mirror image; the rest goes into the lobe. None from roughness 0.5.
inline double mirror_share(double roughness) {
  const double sharpness = std::max(0.0, 1 - 4 * roughness * roughness);
  return sharpness * sharpness;
}

}  // namespace lekalo::render
