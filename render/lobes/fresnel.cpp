#include "render/lobes/fresnel.h"

#include <algorithm>
#include <cmath>

namespace lekalo::render {

double fresnel_dielectric(double cos_incident, double n0, double n1) {
  const double c0 = std::clamp(cos_incident, 0.0, 1.0);
  const double sine = n0 / n1 * std::sqrt(1 - c0 * c0);
  if (sine >= 1) return 1;
  const double c1 = std::sqrt(1 - sine * sine);
  const double parallel = (n1 * c0 - n0 * c1) / (n1 * c0 + n0 * c1);
  const double perpendicular = (n0 * c0 - n1 * c1) / (n0 * c0 + n1 * c1);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

double fresnel_conductor(double cos_incident, double n, double k) {
  const double c = std::clamp(cos_incident, 0.0, 1.0);
  const double c2 = c * c, s2 = 1 - c2;
  const double difference = n * n - k * k - s2;
  const double root = std::sqrt(difference * difference + 4 * n * n * k * k);  // a^2 + b^2
  const double a = std::sqrt(std::max(0.0, 0.5 * (root + difference)));
  const double perpendicular = (root - 2 * a * c + c2) / (root + 2 * a * c + c2);
  const double parallel =
      perpendicular * (c2 * root - 2 * a * c * s2 + s2 * s2) / (c2 * root + 2 * a * c * s2 + s2 * s2);
  return 0.5 * (parallel + perpendicular);
}

Spectrum fresnel_dielectric(double cos_incident, const Spectrum& n1) {
  Spectrum result;
  for (int i = 0; i < 4; ++i) result.set(i, static_cast<float>(fresnel_dielectric(cos_incident, 1.0, n1[i])));
  return result;
}

Spectrum fresnel_conductor(double cos_incident, const Spectrum& n, const Spectrum& k) {
  Spectrum result;
  for (int i = 0; i < 4; ++i) result.set(i, static_cast<float>(fresnel_conductor(cos_incident, n[i], k[i])));
  return result;
}

}  // namespace lekalo::render
