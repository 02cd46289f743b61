#include "render/lobes/metal_lobe.h"

#include <algorithm>
#include <cmath>

#include "render/lobes/classic_lobes.h"
#include "render/lobes/fresnel.h"

namespace lekalo::render {

using geometry::kPi;

Spectrum MetalReflectance::at(double cosine, double near) const {
  const double c = std::clamp(cosine, 0.0, 1.0);
  if (film) return film->reflectance(thickness, c, wavelengths);
  if (measured()) return fresnel_conductor(c, static_cast<float>(1 / near) * n, static_cast<float>(1 / near) * k);
  const double x = 1 - c, x5 = x * x * x * x * x;
  return tinted(x5, c * x5 * x);
}

// F for given values, or means, of (1 - c)^5 and c (1 - c)^6.
Spectrum MetalReflectance::tinted(double schlick, double dip) const {
  const double at_edge = std::pow(6.0 / 7, 5), scale = std::pow(6.0 / 7, 6) / 7;
  Spectrum f;
  for (int i = 0; i < 4; ++i) {
    const double f0 = color[i], edge = f0 + (1 - f0) * at_edge;
    const double value = f0 + (1 - f0) * schlick - dip * edge * (1 - edge_tint[i]) / scale;
    f.set(i, static_cast<float>(std::clamp(value, 0.0, 1.0)));
  }
  return f;
}

Spectrum MetalReflectance::mean() const {
  // Euler's B(2, 6) = 1/42 and B(3, 7) = 1/252.
  if (!measured() && !film) return tinted(1.0 / 21, 1.0 / 126);
  constexpr int kParts = 16;
  Spectrum sum;
  for (int i = 0; i < kParts; ++i) {
    const double c = (i + 0.5) / kParts;
    sum += static_cast<float>(2 * c / kParts) * at(c);
  }
  return sum;
}

Vec3 MetalLobe::turned(const Vec3& w, double angle) const {
  if (angle == 0) return w;
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * w.x - s * w.y, s * w.x + c * w.y, w.z};
}

// `w` in the directions of the lobe.
double MetalLobe::further_share(const Vec3& w) const { return albedo ? 1 - albedo->at(w) : 0; }

Spectrum MetalLobe::evaluate(const Vec3& out, const Vec3& in, const Sides& sides) const {
  const Microfacets facets = microfacets(roughness, anisotropy);
  if (in.z <= 0 || facets.smooth()) return {};
  const Vec3 o = turned(out, -rotation), i = turned(in, -rotation);
  const Vec3 h = glm::normalize(o + i);
  const double first = facets.facets(h) * facets.seen_and_lit(o, i) / (4 * out.z);
  Spectrum value = static_cast<float>(first) * reflectance.at(glm::dot(o, h), sides.near);
  if (!albedo) return value;
  const double e = albedo->mean();
  if (e > 1 - 1e-6) return value;
  const double further = further_share(o) * further_share(i) * in.z / (kPi * (1 - e));
  for (int lane = 0; lane < 4; ++lane) {
    const double f = mean[lane];
    const double more = f * f * e / (1 - f * (1 - e));
    value.set(lane, static_cast<float>(value[lane] + more * further));
  }
  return value;
}

double MetalLobe::density(const Vec3& out, const Vec3& in, const Sides&) const {
  const Microfacets facets = microfacets(roughness, anisotropy);
  if (in.z <= 0 || facets.smooth()) return 0;
  const Vec3 o = turned(out, -rotation), i = turned(in, -rotation);
  const double further = further_share(o);
  const Vec3 h = glm::normalize(o + i);
  return (1 - further) * facets.seen(o) * facets.facets(h) / (4 * out.z) + further * cosine_density(in);
}

LobeSample MetalLobe::sample(const Vec3& out, const Vec2& choice, const Vec2& square, const Sides& sides) const {
  const Microfacets facets = microfacets(roughness, anisotropy);
  if (facets.smooth()) return {mirrored(out), true, 1, reflectance.at(out.z, sides.near)};
  const Vec3 o = turned(out, -rotation);
  Vec3 in = cosine_direction(square);
  if (choice.x >= further_share(o)) {
    const Vec3 h = facets.visible_facet(o, square);
    in = turned(2 * glm::dot(o, h) * h - o, rotation);
    if (in.z <= 0) return {};
  }
  return {in, false, density(out, in, sides), evaluate(out, in, sides)};
}

}  // namespace lekalo::render
