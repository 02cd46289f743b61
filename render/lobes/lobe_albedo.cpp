#include "render/lobes/lobe_albedo.h"

#include <algorithm>
#include <cmath>

#include "render/lobes/fresnel.h"
#include "render/lobes/microfacet.h"
#include "render/lobes/sheen_lobe.h"

namespace lekalo::render {

using geometry::kPi;

namespace {

// Of the quadrature over the facets that are seen, or over directions.
constexpr int kSlopes = 64, kAngles = 32;

// Mean of G(out, in) / G(out) F(in.h) over the facets seen. Those of steep slopes, few as they are, send all of the
// light down that smooth surfaces lose: the places s of the unit square are denser there, s = 1 - (1 - t)^3.
double facet_albedo(const Microfacets& facets, const Vec3& out, const std::function<double(double)>& reflectance) {
  double sum = 0;
  for (int i = 0; i < kSlopes; ++i) {
    const double rest = 1 - (i + 0.5) / kSlopes, weight = 3 * rest * rest / kSlopes;
    for (int j = 0; j < kAngles; ++j) {
      const Vec3 h = facets.visible_facet(out, {(j + 0.5) / kAngles, 1 - rest * rest * rest});
      const double along = glm::dot(out, h);
      const Vec3 in = 2 * along * h - out;
      if (in.z > 0) sum += weight / kAngles * facets.seen_and_lit(out, in) / facets.seen(out) * reflectance(along);
    }
  }
  return std::min(1.0, sum);
}

Vec3 direction(double cosine, double turn) {
  const double c = std::clamp(cosine, 1e-4, 1.0), s = std::sqrt(1 - c * c);
  return {s * std::cos(turn), s * std::sin(turn), c};
}

}  // namespace

double LobeAlbedo::between(int turn, double root) const {
  const double place = std::clamp(root, 0.0, 1.0) * (kHeights - 1);
  const int i = std::min(static_cast<int>(place), kHeights - 2);
  const double share = place - i;
  const float* row = &table_[static_cast<size_t>(turn) * kHeights];
  return (1 - share) * row[i] + share * row[i + 1];
}

void LobeAlbedo::fill() const {
  const int n = turns();
  for (int turn = 0; turn < n; ++turn)
    for (int i = 0; i < kHeights; ++i) {
      const double root = i / (kHeights - 1.0), angle = n > 1 ? 0.5 * kPi * turn / (n - 1) : 0;
      table_.push_back(static_cast<float>(exact_(direction(root * root, angle))));
    }
  // With cos = x^2 the mean is the integral of 4 E x^3 dx, by Simpson's rule; over the turns by trapezoids, as at()
  // joins them by lines.
  constexpr int kParts = 8 * (kHeights - 1);
  for (int turn = 0; turn < n; ++turn) {
    const double weight = n == 1 ? 1 : (turn == 0 || turn == n - 1 ? 0.5 : 1.0) / (n - 1);
    const auto integrand = [&](double x) { return 4 * between(turn, x) * x * x * x; };
    for (int i = 0; i < kParts; ++i) {
      const double a = static_cast<double>(i) / kParts, b = static_cast<double>(i + 1) / kParts;
      mean_ += weight * (b - a) / 6 * (integrand(a) + 4 * integrand(0.5 * (a + b)) + integrand(b));
    }
  }
}

double LobeAlbedo::at(const Vec3& out) const {
  std::call_once(filled_, [this] { fill(); });
  const double root = std::sqrt(std::clamp(out.z, 0.0, 1.0));
  if (round_) return between(0, root);
  const double place = std::atan2(std::fabs(out.y), std::fabs(out.x)) / (0.5 * kPi) * (kTurns - 1);
  const int turn = std::clamp(static_cast<int>(place), 0, kTurns - 2);
  return (1 - (place - turn)) * between(turn, root) + (place - turn) * between(turn + 1, root);
}

double LobeAlbedo::mean() const {
  std::call_once(filled_, [this] { fill(); });
  return mean_;
}

LobeAlbedoPtr mirror_albedo(double roughness, double anisotropy) {
  const auto at = [facets = microfacets(roughness, anisotropy)](const Vec3& out) {
    return facets.smooth() ? 1.0 : facet_albedo(facets, out, [](double) { return 1.0; });
  };
  return std::make_shared<LobeAlbedo>(at, anisotropy == 0);
}

LobeAlbedoPtr coat_albedo(double roughness, double index) {
  const auto at = [facets = microfacets(roughness, 0), index](const Vec3& out) {
    const auto reflectance = [index](double c) { return fresnel_dielectric(c, 1, index); };
    return facets.smooth() ? reflectance(out.z) : facet_albedo(facets, out, reflectance);
  };
  return std::make_shared<LobeAlbedo>(at, true);
}

LobeAlbedoPtr sheen_albedo(double roughness) {
  // Midpoints of in.z = x^2 and of the angle about the normal.
  const auto at = [roughness](const Vec3& out) {
    double sum = 0;
    for (int i = 0; i < kSlopes; ++i)
      for (int j = 0; j < kAngles; ++j) {
        const double x = (i + 0.5) / kSlopes;
        sum += 2 * x * x * x * sheen(roughness, out, direction(x * x, kPi * (j + 0.5) / kAngles));
      }
    return std::min(1.0, geometry::kTwoPi * sum / (kAngles * kSlopes));
  };
  return std::make_shared<LobeAlbedo>(at, true);
}

AlbedoLevels::AlbedoLevels(const std::function<LobeAlbedoPtr(double)>& make) {
  for (int i = 0; i <= kLevels; ++i) levels_[i] = make(static_cast<double>(i) / kLevels);
}

double AlbedoLevels::rounded(double roughness) {
  return std::round(std::clamp(roughness, 0.0, 1.0) * kLevels) / kLevels;
}

const LobeAlbedo& AlbedoLevels::operator[](double rounded_roughness) const {
  return *levels_[static_cast<size_t>(std::lround(rounded_roughness * kLevels))];
}

}  // namespace lekalo::render
