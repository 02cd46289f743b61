#include "render/spectra/illuminants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "render/spectra/observer.h"

namespace lekalo::render {

const std::vector<std::string>& illuminant_names() {
  static const std::vector<std::string> names = {"D65", "D50", "A", "F2", "F7", "F11"};
  return names;
}

double illuminant_power(std::string_view name, double nanometres) {
  static const std::vector<std::array<double, 6>> table = {
#include "render/spectra/data/illuminants.inc"
  };
  const auto found = std::find(illuminant_names().begin(), illuminant_names().end(), name);
  if (found == illuminant_names().end()) throw std::invalid_argument("no illuminant '" + std::string(name) + "'");
  const auto column = static_cast<size_t>(found - illuminant_names().begin());
  return entry_at(nanometres, [column](size_t i) { return table[i][column]; });
}

double black_body_power(double kelvin, double nanometres) {
  constexpr double kSecondConstant = 1.438777e7;  // nm K
  const auto radiance = [&](double l) { return std::pow(l / 560, -5) / std::expm1(kSecondConstant / (l * kelvin)); };
  return radiance(nanometres) / radiance(560);
}

}  // namespace lekalo::render
