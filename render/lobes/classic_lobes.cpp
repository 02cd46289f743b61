#include "render/lobes/classic_lobes.h"

#include <algorithm>
#include <cmath>

#include "render/lobes/fresnel.h"

namespace lekalo::render {

using geometry::kPi;

namespace {

double cosine_from_mirror(const Vec3& out, const Vec3& in) { return std::clamp(glm::dot(mirrored(out), in), 0.0, 1.0); }

}  // namespace

Spectrum PhongLobe::evaluate(const Vec3& out, const Vec3& in, const Sides&) const {
  if (in.z <= 0) return {};
  return static_cast<float>(std::pow(cosine_from_mirror(out, in), exponent) * in.z / kPi) * height;
}

double PhongLobe::density(const Vec3& out, const Vec3& in, const Sides&) const {
  if (in.z <= 0) return 0;
  return (exponent + 1) / geometry::kTwoPi * std::pow(cosine_from_mirror(out, in), exponent);
}

LobeSample PhongLobe::sample(const Vec3& out, const Vec2&, const Vec2& square, const Sides& sides) const {
  const double cosine = std::pow(1 - square.x, 1 / (exponent + 1));
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)), angle = geometry::kTwoPi * square.y;
  const Vec3 in =
      geometry::frame_about(Vec3(0), mirrored(out)).direction({sine * std::cos(angle), sine * std::sin(angle), cosine});
  return {in, false, density(out, in, sides), evaluate(out, in, sides)};
}

std::optional<Vec3> refracted_behind(const Vec3& out, const Sides& sides) {
  const double eta = sides.near / sides.behind;
  const double square = 1 - eta * eta * (1 - out.z * out.z);
  if (square <= 0) return std::nullopt;
  return Vec3(-eta * out.x, -eta * out.y, -std::sqrt(square));
}

LobeSample BoundaryLobe::sample(const Vec3& out, const Vec2& choice, const Vec2&, const Sides& sides) const {
  Spectrum reflects = mirror, passes = transmission;
  const std::optional<Vec3> behind = refracted_behind(out, sides);
  if (!behind) {
    reflects += passes;
    passes = {};
  } else if (fresnel) {
    const auto f = static_cast<float>(fresnel_dielectric(out.z, sides.near, sides.behind));
    reflects += f * passes;
    passes *= 1 - f;
  }
  const double all = static_cast<double>(reflects.largest()) + passes.largest();
  if (all <= 0) return {};
  const double probability = reflects.largest() / all;
  if (choice.x < probability) return {mirrored(out), true, probability, reflects};
  return {*behind, true, 1 - probability, passes};
}

}  // namespace lekalo::render
