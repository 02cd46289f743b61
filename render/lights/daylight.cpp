#include "render/lights/daylight.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "render/spectra/observer.h"

namespace lekalo::render {

using geometry::kPi;

namespace {

constexpr double kMinCosine = 1e-3;     // of the zenith angle, at the horizon
constexpr double kSolarConstant = 128;  // klx
constexpr double kSunKelvin = 5778;

double angle(const Vec3& a, const Vec3& b) { return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)); }

// Planck's law, in any unit.
double black_body(double nanometres) {
  return 1e15 / (std::pow(nanometres, 5) * std::expm1(1.438777e7 / (nanometres * kSunKelvin)));
}

// Absorption of ozone, 1/cm (table 2 of the paper, every 20 nm), linear between its wavelengths.
double ozone(double nanometres) {
  constexpr double kFirst = 440, kStep = 20;
  constexpr double kValues[] = {0.003, 0.006, 0.014, 0.030, 0.048, 0.075, 0.103, 0.120,
                                0.125, 0.105, 0.079, 0.057, 0.036, 0.023, 0.014};
  constexpr int kLast = std::size(kValues) - 1;
  const double place = std::clamp((nanometres - kFirst) / kStep, 0.0, kLast + 0.0);
  const int i = std::min(static_cast<int>(place), kLast - 1);
  return nanometres < kFirst ? 0 : kValues[i] + (place - i) * (kValues[i + 1] - kValues[i]);
}

}  // namespace

double Daylight::Perez::at(double cos_zenith, double gamma) const {
  const double cosine = std::cos(gamma);
  return (1 + a * std::exp(b / std::max(cos_zenith, kMinCosine))) * (1 + c * std::exp(d * gamma) + e * cosine * cosine);
}

Daylight::Daylight(const Vec3& to_sun, double turbidity)
    : to_sun_(to_sun),
      turbidity_(turbidity),
      sun_zenith_(angle(to_sun, {0, 0, 1})),
      luminance_{0.1787 * turbidity - 1.4630, -0.3554 * turbidity + 0.4275, -0.0227 * turbidity + 5.3251,
                 0.1206 * turbidity - 2.5771, -0.0670 * turbidity + 0.3703},
      x_{-0.0193 * turbidity - 0.2592, -0.0665 * turbidity + 0.0008, -0.0004 * turbidity + 0.2125,
         -0.0641 * turbidity - 0.8989, -0.0033 * turbidity + 0.0452},
      y_{-0.0167 * turbidity - 0.2608, -0.0950 * turbidity + 0.0092, -0.0079 * turbidity + 0.2102,
         -0.0441 * turbidity - 1.6537, -0.0109 * turbidity + 0.0529} {
  const double t = turbidity, s = std::min(sun_zenith_, 0.5 * kPi);
  const double chi = (4.0 / 9 - t / 120) * (kPi - 2 * s);
  zenith_luminance_ = std::max(0.0, (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192);
  const auto cubic = [s](double p3, double p2, double p1, double p0) { return ((p3 * s + p2) * s + p1) * s + p0; };
  zenith_x_ = t * t * cubic(0.00166, -0.00375, 0.00209, 0) + t * cubic(-0.02903, 0.06377, -0.03202, 0.00394) +
              cubic(0.11693, -0.21196, 0.06052, 0.25886);
  zenith_y_ = t * t * cubic(0.00275, -0.00610, 0.00317, 0) + t * cubic(-0.04214, 0.08970, -0.04153, 0.00516) +
              cubic(0.15346, -0.26756, 0.06670, 0.26688);
}

double Daylight::quantity(const Perez& f, double zenith, double cos_zenith, double gamma) const {
  return zenith * f.at(cos_zenith, gamma) / f.at(1, sun_zenith_);
}

Daylight::Look Daylight::look(const Vec3& direction) const {
  const Vec3 w = direction.z >= kMinCosine
                     ? direction
                     : glm::normalize(Vec3(direction.x, direction.y, kMinCosine * (1 + std::fabs(direction.z))));
  const double gamma = angle(w, to_sun_);
  return {quantity(luminance_, zenith_luminance_, w.z, gamma), quantity(x_, zenith_x_, w.z, gamma),
          quantity(y_, zenith_y_, w.z, gamma)};
}

Vec3 Daylight::radiance(const Vec3& direction) const {
  const Look seen = look(direction);
  const double y = seen.luminance, x = y * seen.x / seen.y, z = y * (1 - seen.x - seen.y) / seen.y;
  return glm::max(Vec3(0), rec709({x, y, z}));
}

double Daylight::sun_power(double nanometres) const {
  const double degrees = sun_zenith_ * 180 / kPi;
  // Way through the air in units of that from the zenith (Kasten 1966).
  const double mass = 1 / (std::max(0.0, std::cos(sun_zenith_)) + 0.15 * std::pow(93.885 - degrees, -1.253));
  const double haze = 0.04608 * turbidity_ - 0.04586;
  const double micrometres = nanometres / 1000;
  const double loss = 0.008735 * std::pow(micrometres, -4.08) + haze * std::pow(micrometres, -1.3) +
                      0.35 * ozone(nanometres);  // 0.35 cm of it
  return black_body(nanometres) * std::exp(-loss * mass);
}

Vec3 Daylight::sun() const {
  if (sun_zenith_ * 180 / kPi >= 93) return Vec3(0);
  const auto arriving = [this](double nanometres) { return sun_power(nanometres); };
  const Vec3 outside = observed(black_body);
  return cut_to_rec709(kSolarConstant / luminance(outside) * observed(arriving));
}

}  // namespace lekalo::render
