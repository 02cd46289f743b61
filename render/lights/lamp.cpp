// What lights share: intensity, decay, sampling of areas.
#include <algorithm>
#include <cmath>

#include "render/lights/lights.h"

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

void declare_lamp(TypeDeclaration& type, bool with_decay) {
  type.field("color", color().non_negative(), "of the light", "white")
      .field("intensity", number().non_negative(),
             with_decay ? "radiance of a white matt surface that faces the light (at distance 1 with inverse_square)"
                        : "radiance of a white matt surface that faces the light",
             "1");
  if (with_decay) type.field("decay", choice({"none", "inverse_square"}), "how the light falls with distance", "none");
  type.field("shadows", boolean(), "false: the light passes through everything", "true");
}

Lamp lamp(const Fields& fields) {
  Lamp lamp;
  lamp.color = fields.vec3("color");
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

}  // namespace lekalo::render
