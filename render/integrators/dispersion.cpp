#include "render/integrators/dispersion.h"

#include <algorithm>
#include <array>
#include <vector>

namespace lekalo::render {

namespace {

constexpr double kFirst = 380, kStep = 5;  // nanometres
const std::vector<std::array<double, 3>> kObserver = {
#include "render/integrators/data/cie1931.inc"
};

// XYZ to linear Rec.709 (ITU-R BT.709-6, white D65).
std::array<double, 3> rec709(const std::array<double, 3>& xyz) {
  const auto [x, y, z] = xyz;
  return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
          0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

double sum(const std::array<double, 3>& xyz) { return xyz[0] + xyz[1] + xyz[2]; }

std::array<double, 3> joined(const std::array<double, 3>& a, const std::array<double, 3>& b, double share) {
  std::array<double, 3> value;
  for (size_t i = 0; i < 3; ++i) value[i] = (1 - share) * a[i] + share * b[i];
  return value;
}

// Between the table's entries its functions are straight lines; the choice is even within a step.
struct Table {
  std::vector<double> ends{0};       // integral of the sum up to each entry
  std::array<double, 3> integral{};  // of red, green and blue
  Table() {
    for (size_t i = 0; i + 1 < kObserver.size(); ++i) {
      const std::array<double, 3> middle = joined(kObserver[i], kObserver[i + 1], 0.5);
      ends.push_back(ends.back() + kStep * sum(middle));
      const std::array<double, 3> color = rec709(middle);
      for (size_t c = 0; c < 3; ++c) integral[c] += kStep * color[c];
    }
  }
};

}  // namespace

WavelengthSample sample_wavelength(double random) {
  static const Table table;
  const double place = random * table.ends.back();
  const auto after = std::upper_bound(table.ends.begin() + 1, table.ends.end() - 1, place);
  const size_t i = static_cast<size_t>(after - table.ends.begin()) - 1;
  const double width = table.ends[i + 1] - table.ends[i];
  const double share = std::clamp((place - table.ends[i]) / width, 0.0, 1.0);
  const double density = width / kStep / table.ends.back();
  const std::array<double, 3> color = rec709(joined(kObserver[i], kObserver[i + 1], share));
  WavelengthSample sample{static_cast<float>(kFirst + kStep * (static_cast<double>(i) + share)), {}};
  for (int c = 0; c < 3; ++c)
    sample.share.set(
        c, static_cast<float>(color[static_cast<size_t>(c)] / (table.integral[static_cast<size_t>(c)] * density)));
  return sample;
}

bool disperses(const Material& material) {
  if (!material.transmits()) return false;
  const auto violet = material.interior(Wavelengths{{400, 400, 400, 400}});
  const auto red = material.interior(Wavelengths{{700, 700, 700, 700}});
  return violet && red && violet->index != red->index;
}

}  // namespace lekalo::render
