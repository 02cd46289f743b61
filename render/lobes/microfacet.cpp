#include "render/lobes/microfacet.h"

#include <algorithm>
#include <cmath>

namespace lekalo::render {

using geometry::kPi;

double Microfacets::facets(const Vec3& h) const {
  const double a = h.x / x_, b = h.y / y_, s = a * a + b * b + h.z * h.z;
  return 1 / (kPi * x_ * y_ * s * s);
}

double Microfacets::lambda(const Vec3& w) const {
  const double a = x_ * w.x, b = y_ * w.y, c = w.z * w.z;
  return c > 0 ? 0.5 * (std::sqrt(1 + (a * a + b * b) / c) - 1) : geometry::kInfinity;
}

double Microfacets::seen(const Vec3& out) const { return 1 / (1 + lambda(out)); }

double Microfacets::seen_and_lit(const Vec3& out, const Vec3& in) const { return 1 / (1 + lambda(out) + lambda(in)); }

double Microfacets::visible_facets(const Vec3& out, const Vec3& h) const {
  return seen(out) * std::max(0.0, glm::dot(out, h)) * facets(h) / out.z;
}

Vec3 Microfacets::visible_facet(const Vec3& out, const Vec2& square) const {
  const Vec3 stretched = glm::normalize(Vec3(x_ * out.x, y_ * out.y, out.z));
  const double angle = geometry::kTwoPi * square.x;
  const double z = (1 - square.y) * (1 + stretched.z) - stretched.z;
  const double sine = std::sqrt(std::clamp(1 - z * z, 0.0, 1.0));
  const Vec3 h = Vec3(sine * std::cos(angle), sine * std::sin(angle), z) + stretched;
  return glm::normalize(Vec3(x_ * h.x, y_ * h.y, std::max(1e-12, h.z)));
}

Microfacets microfacets(double roughness, double anisotropy) {
  const double across = 1 - anisotropy;
  const double along = roughness * roughness * std::sqrt(2 / (1 + across * across));
  // One of two slopes may be too small to be told from none, not zero.
  const double least = along < kSmoothSlope ? 0 : 1e-4;
  return {std::max(along, least), std::max(across * along, least)};
}

}  // namespace lekalo::render
