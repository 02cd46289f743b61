// The formulas of the classic light model (Golovanov 2016, 8.4), one function each.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "render/spectrum.h"

namespace lekalo::render {

// Phong's cos(alpha)^n; 0 for a lobe seen from its other side.
inline double phong_lobe(double cos_alpha, double exponent) {
  return cos_alpha > 0 ? std::pow(std::min(cos_alpha, 1.0), exponent) : 0.0;
}

// Mirror image of the direction d (unit) of a ray at a plane of unit normal m: d - 2 (d.m) m.
inline Vec3 reflected(const Vec3& d, const Vec3& m) { return d - 2 * glm::dot(d, m) * m; }

// Snell: unit direction behind a boundary of unit normal m (against the unit direction d) between the indices n0 and n1
// behind; none beyond the critical angle (total internal reflection).
//   eta = n0/n1, c = -d.m, k = 1 - eta^2 (1 - c^2), t = eta d + (eta c - sqrt(k)) m
// t is as long as d and m are but for rounding, which a step of Newton's iteration for 1/sqrt(t.t) from 1 takes away.
inline std::optional<Vec3> refracted(const Vec3& d, const Vec3& m, double n0, double n1) {
  const double eta = n0 / n1, c = -glm::dot(d, m);
  const double k = 1 - eta * eta * (1 - c * c);
  if (k < 0) return std::nullopt;
  const Vec3 t = eta * d + (eta * c - std::sqrt(k)) * m;
  return (1.5 - 0.5 * glm::dot(t, t)) * t;
}

// Bouguer: e^(-mu l); without absorption light comes from infinity as well.
inline Spectrum transmittance(const Spectrum& mu, double length) {
  if (mu.is_zero()) return Spectrum(1.0f);
  constexpr double kFarthest = std::numeric_limits<float>::max();  // infinity times 0 is no number
  return exp(-static_cast<float>(std::min(length, kFarthest)) * mu);
}

// 1 / (1 + k_r (r - r_0)), not above 1 (8.4.3).
inline double depth_factor(double k_r, double r, double r0) { return 1 / (1 + k_r * std::max(0.0, r - r0)); }

}  // namespace lekalo::render
