#include "render/lobes/matt_lobes.h"

#include <algorithm>
#include <cmath>

namespace lekalo::render {

using geometry::kPi;

namespace {

constexpr double kTail = 0.5 - 2 / (3 * kPi);        // of 1/A = 1 + kTail r
constexpr double kMean = 2.0 / 3 - 28 / (15 * kPi);  // E_mean = A (1 + kMean r)

float over_pi(double cosine) { return static_cast<float>(cosine / kPi); }

// E of RoughMattLobe, in closed form; s the sine of the angle from the normal:
//   E = A (1 + r G / pi),  G = s (acos(c) - s c) + 2/3 ((s/c) (1 - s^3) - s).
double reflectance_of_first_bounce(double cosine, double roughness) {
  const double c = std::clamp(cosine, 1e-7, 1.0), s = std::sqrt(1 - c * c);
  const double g = s * (std::acos(c) - s * c) + 2.0 / 3 * ((s / c) * (1 - s * s * s) - s);
  return (1 + roughness * g / kPi) / (1 + kTail * roughness);
}

}  // namespace

Vec3 cosine_direction(const Vec2& square) {
  const double radius = std::sqrt(square.x), angle = geometry::kTwoPi * square.y;
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(std::max(0.0, 1 - square.x))};
}

Spectrum LambertLobe::evaluate(const Vec3&, const Vec3& in, const Sides&) const {
  return in.z > 0 ? over_pi(in.z) * albedo : Spectrum();
}

LobeSample LambertLobe::sample(const Vec3& out, const Vec2&, const Vec2& square, const Sides& sides) const {
  const Vec3 in = cosine_direction(square);
  return {in, false, cosine_density(in), evaluate(out, in, sides)};
}

Spectrum RoughMattLobe::evaluate(const Vec3& out, const Vec3& in, const Sides&) const {
  if (in.z <= 0) return {};
  const double s = glm::dot(in, out) - in.z * out.z;
  const double t = s > 0 ? std::max(in.z, out.z) : 1;
  const double a = 1 / (1 + kTail * roughness);
  const double first = a * (1 + roughness * s / t);
  const double mean = a * (1 + kMean * roughness);
  const double lost = 1 - mean;
  const double further = lost > 1e-9 ? (1 - reflectance_of_first_bounce(out.z, roughness)) *
                                           (1 - reflectance_of_first_bounce(in.z, roughness)) / lost
                                     : 0;
  Spectrum value;
  for (int i = 0; i < 4; ++i) {
    const double k = albedo[i];
    value.set(i, static_cast<float>(in.z / kPi * (k * first + k * k * mean / (1 - k * lost) * further)));
  }
  return value;
}

LobeSample RoughMattLobe::sample(const Vec3& out, const Vec2&, const Vec2& square, const Sides& sides) const {
  const Vec3 in = cosine_direction(square);
  return {in, false, cosine_density(in), evaluate(out, in, sides)};
}

double SheetLobe::reflected_share() const {
  const double r = reflectance.largest(), t = transmittance.largest();
  return r + t > 0 ? r / (r + t) : 1;
}

Spectrum SheetLobe::evaluate(const Vec3&, const Vec3& in, const Sides&) const {
  return over_pi(std::fabs(in.z)) * (in.z > 0 ? reflectance : transmittance);
}

double SheetLobe::density(const Vec3&, const Vec3& in, const Sides&) const {
  return (in.z > 0 ? reflected_share() : 1 - reflected_share()) * std::fabs(in.z) / kPi;
}

LobeSample SheetLobe::sample(const Vec3& out, const Vec2& choice, const Vec2& square, const Sides& sides) const {
  Vec3 in = cosine_direction(square);
  if (choice.x >= reflected_share()) in.z = -in.z;
  return {in, false, density(out, in, sides), evaluate(out, in, sides)};
}

}  // namespace lekalo::render
