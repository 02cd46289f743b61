// What lights share: intensity, decay, sampling of areas.
#include <algorithm>
#include <cmath>

#include "render/lights/lights.h"
#include "render/spectra/hero_wavelengths.h"
#include "render/spectra/upsampling.h"

namespace lekalo::render {

using namespace geometry;

Irradiance::Irradiance(const Lamp& lamp)
    : at_one_(rgb(kPi * lamp.intensity * lamp.color)), inverse_square_(lamp.inverse_square) {}

Vec2 area_sample(const AreaSampling& sampling, int index, double r1, double r2) {
  const int i = index % sampling.n, j = index / sampling.n;
  if (!sampling.grid) return {(i + r1) / sampling.n, (j + r2) / sampling.n};
  if (sampling.n == 1) return {0.5, 0.5};
  return {i / (sampling.n - 1.0), j / (sampling.n - 1.0)};
}

Vec2 concentric_disc(const Vec2& square) {
  const double a = 2 * square.x - 1, b = 2 * square.y - 1;
  if (a == 0 && b == 0) return {0, 0};
  if (std::fabs(a) > std::fabs(b)) {
    const double angle = kPi / 4 * (b / a);
    return {a * std::cos(angle), a * std::sin(angle)};
  }
  const double angle = kPi / 2 - kPi / 4 * (a / b);
  return {b * std::cos(angle), b * std::sin(angle)};
}

RoundIrradiance::RoundIrradiance(const Lamp& lamp, const AreaSampling& sampling)
    : irradiance_(lamp), mean_square_(0.5) {
  if (!sampling.grid) return;
  mean_square_ = 0;
  const int count = sampling.n * sampling.n;
  for (int i = 0; i < count; ++i) {
    const Vec2 place = concentric_disc(area_sample(sampling, i, 0, 0));
    mean_square_ += glm::dot(place, place) / count;
  }
}

Spectrum light_of(const Light& light, const Spectrum& color, const Wavelengths& wavelengths) {
  if (!is_spectral(wavelengths)) return color;
  const auto* known = dynamic_cast<const SpectralLight*>(&light);
  return known && known->spectrum() ? known->spectrum()->at(color, wavelengths) : upsampled_light(color, wavelengths);
}

void declare_lamp(TypeDeclaration& type, bool with_decay) {
  type.field("color", color().non_negative(), "of the light", "white");
  declare_lamp_spectrum(type);
  type.field("intensity", number().non_negative(),
             with_decay ? "radiance of a white matt surface that faces the light (at distance 1 with inverse_square)"
                        : "radiance of a white matt surface that faces the light",
             "1");
  if (with_decay) type.field("decay", choice({"none", "inverse_square"}), "how the light falls with distance", "none");
  type.field("shadows", boolean(), "false: the light passes through everything", "true");
}

Lamp lamp(const Fields& fields) {
  Lamp lamp;
  lamp.color = fields.vec3("color");
  lamp.spectrum = lamp_spectrum(fields);
  if (lamp.spectrum) lamp.color = lamp.spectrum->color();
  lamp.intensity = fields.number("intensity");
  lamp.inverse_square = fields.has("decay") && fields.text("decay") == "inverse_square";
  lamp.shadows = fields.boolean("shadows");
  return lamp;
}

void declare_area_sampling(TypeDeclaration& type) {
  type.field("samples", integer().between(1, 256), "n: the light is seen from each point at n x n places", "4")
      .field("sampling", choice({"stratified", "grid"}),
             "stratified: a random place in each of n x n parts; grid: fixed places, evenly from edge to edge",
             "stratified");
}

AreaSampling area_sampling(const Fields& fields) {
  return {fields.integer("samples"), fields.text("sampling") == "grid"};
}

double ConeLight::mean_cosine(double axis_cosine) const {
  const double c = std::clamp(axis_cosine, -1.0, 1.0), cone_sine = this->sine;
  if (c <= -cone_sine) return 0;  // all of the cone below the horizon
  if (cone_sine == 0) return c;
  const double square = cone_sine * cone_sine;
  const double cone_cosine = std::sqrt(1 - square);
  const double solid_angle = 2 * kPi * square / (1 + cone_cosine);
  if (c >= cone_sine) return kPi * square * c / solid_angle;  // all of it above
  const double sine = std::sqrt(1 - c * c);
  const double gamma = std::asin(std::min(1.0, cone_cosine / sine));
  const double cos_gamma = std::cos(gamma), sin_gamma = std::sin(gamma);
  const double g = -2 * sine * cone_cosine * cos_gamma + 0.5 * kPi - gamma + sin_gamma * cos_gamma;
  const double h = c * (cos_gamma * std::sqrt(std::max(0.0, square - cos_gamma * cos_gamma)) +
                        square * std::asin(std::min(1.0, cos_gamma / cone_sine)));
  return std::max(0.0, (c >= 0 ? kPi * c * square + g - h : g + h) / solid_angle);
}

Vec3 ConeLight::direction(const Vec3& normal, int index, SampleStream& random) const {
  const Vec2 jitter = random.next_pair();
  SampleStream others = random;  // a copy, so that each sample takes one pair
  const double height = glm::dot(axis, normal);
  Vec3 along = axis - height * normal;  // from the normal towards the axis, in the surface's plane
  const double slant = glm::length(along);
  along = slant > 1e-9 ? along / slant : frame_about(Vec3(0), normal).x;
  const Vec3 across = glm::cross(normal, along);
  const auto at = [&](double x, double y) {
    return x * along + y * across + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * normal;
  };
  Vec2 square = area_sample({parts, false}, index, jitter.x, jitter.y);
  const double cosine = std::sqrt(1 - sine * sine);
  if (height >= sine) {
    const Vec2 disc = concentric_disc(square);
    return at(cosine * slant + height * sine * disc.x, sine * disc.y);
  }
  // Half the angle about the normal under which the part above the horizon is seen, and its least distance from it.
  const double half =
      height > 0 ? (sine < slant ? std::asin(sine / slant) : kPi) : std::acos(std::min(1.0, cosine / slant));
  const double least = height > 0 && sine >= slant ? 0 : slant * cosine - height * sine, inner = least * least;
  constexpr int kMaxTries = 100;  // half of them succeed
  Vec3 direction = axis;
  for (int i = 0; i < kMaxTries; ++i, square = others.next_pair()) {
    const double angle = (2 * square.x - 1) * half, radius = std::sqrt(inner + square.y * (1 - inner));
    direction = at(radius * std::cos(angle), radius * std::sin(angle));
    if (glm::dot(direction, axis) >= cosine) break;
  }
  return direction;
}

double ConeLight::distance_along(const Vec3& direction) const {
  if (distance == kInfinity) return kInfinity;
  const double along = distance * glm::dot(axis, direction), radius = sine * distance;
  return along - std::sqrt(std::max(0.0, radius * radius - (distance * distance - along * along)));
}

}  // namespace lekalo::render
