#include "render/spectra/observer.h"

namespace lekalo::render {

const std::vector<Vec3>& observer() {
  static const std::vector<Vec3> table = {
#include "render/spectra/data/cie1931.inc"
  };
  return table;
}

Vec3 rec709(const Vec3& xyz) {
  return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
          -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
          0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

Vec3 observed(const std::function<double(double)>& power) {
  Vec3 xyz(0);
  for (int i = 0; i < kSpectrumEntries; ++i) {
    const double nanometres = entry_nanometres(i);
    xyz += kNanometreStep * power(nanometres) * observer()[static_cast<size_t>(i)];
  }
  return rec709(xyz);
}

}  // namespace lekalo::render
