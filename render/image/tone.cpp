#include "render/image/tone.h"

#include <algorithm>
#include <cmath>

namespace lekalo::render {

namespace {

using Color = std::array<double, 3>;

// Rows of a matrix times a colour.
Color times(const std::array<Color, 3>& rows, const Color& c) {
  Color result;
  for (size_t i = 0; i < 3; ++i) result[i] = rows[i][0] * c[0] + rows[i][1] * c[1] + rows[i][2] * c[2];
  return result;
}

// Of the place x in [0, 1] of a logarithm; the power 2.2 of it is light.
double agx_polynomial(double x) {
  const double x2 = x * x, x4 = x2 * x2;
  return 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
}

Color agx(const Color& color) {
  static constexpr std::array<Color, 3> kDrawTogether{{{0.842479062253094, 0.0784335999999992, 0.0792237451477643},
                                                       {0.0423282422610123, 0.878468636469772, 0.0791661274605434},
                                                       {0.0423756549057051, 0.0784336, 0.879142973793104}}};
  static constexpr std::array<Color, 3> kSpread{{{1.19687900512017, -0.0980208811401368, -0.0990297440797205},
                                                 {-0.0528968517574562, 1.15190312990417, -0.0989611768448433},
                                                 {-0.0529716355144438, -0.0980434501171241, 1.15107367264116}}};
  constexpr double kMinStops = -12.47393, kMaxStops = 4.026069;  // stops
  Color value = times(kDrawTogether, color);
  for (double& v : value) {
    const double stops = v > 0 ? std::log2(v) : kMinStops;
    v = agx_polynomial((std::clamp(stops, kMinStops, kMaxStops) - kMinStops) / (kMaxStops - kMinStops));
  }
  value = times(kSpread, value);
  for (double& v : value) v = std::pow(std::max(v, 0.0), 2.2);
  return value;
}

Color pbr_neutral(Color color) {
  constexpr double kStart = 0.8 - 0.04, kDesaturation = 0.15;
  const double least = *std::min_element(color.begin(), color.end());
  const double offset = least < 0.08 ? least - 6.25 * least * least : 0.04;
  for (double& c : color) c -= offset;
  const double peak = *std::max_element(color.begin(), color.end());
  if (peak < kStart) return color;
  const double room = 1 - kStart, pressed = 1 - room * room / (peak + room - kStart);
  const double white = 1 - 1 / (kDesaturation * (peak - pressed) + 1);
  for (double& c : color) c = (1 - white) * (c * pressed / peak) + white * pressed;
  return color;
}

}  // namespace

double filmic(double linear) {
  const double x = 0.6 * linear;
  return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

std::array<double, 3> toned(ToneCurve curve, const std::array<double, 3>& color) {
  switch (curve) {
    case ToneCurve::none:
      return color;
    case ToneCurve::filmic:
      return {filmic(color[0]), filmic(color[1]), filmic(color[2])};
    case ToneCurve::agx:
      return agx(color);
    case ToneCurve::pbr_neutral:
      return pbr_neutral(color);
  }
  return color;
}

}  // namespace lekalo::render
