#include "render/spectra/observer.h"

#include <algorithm>

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

double luminance(const Vec3& rgb) { return glm::dot(rgb, Vec3(0.2126729, 0.7151522, 0.0721750)); }

Vec3 cut_to_rec709(const Vec3& rgb) {
  if (std::min({rgb.x, rgb.y, rgb.z}) >= 0) return rgb;
  const Vec3 cut = glm::max(Vec3(0), rgb);
  return luminance(rgb) / luminance(cut) * cut;
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
