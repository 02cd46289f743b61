#include "render/lobes/sheen_lobe.h"

#include <algorithm>
#include <cmath>

namespace lekalo::render {

double sheen(double roughness, const Vec3& out, const Vec3& in) {
  if (in.z <= 0 || out.z <= 0) return 0;
  const double r = std::clamp(roughness, 0.25, 1.0);
  const Vec3 h = glm::normalize(out + in);
  const double sine = std::sqrt(std::max(0.0, 1 - h.z * h.z));
  const double fibres = (2 + 1 / r) * std::pow(sine, 1 / r) / geometry::kTwoPi;
  return fibres / (4 * (out.z + in.z - out.z * in.z));
}

Spectrum SheenLobe::evaluate(const Vec3& out, const Vec3& in, const Sides&) const {
  return static_cast<float>(sheen(roughness, out, in) * std::max(0.0, in.z)) * color;
}

LobeSample SheenLobe::sample(const Vec3& out, const Vec2&, const Vec2& square, const Sides& sides) const {
  const double z = square.x, radius = std::sqrt(std::max(0.0, 1 - z * z)), angle = geometry::kTwoPi * square.y;
  const Vec3 in(radius * std::cos(angle), radius * std::sin(angle), z);
  return {in, false, density(out, in, sides), evaluate(out, in, sides)};
}

}  // namespace lekalo::render
