#include "render/lobes/observer.h"

#include <array>
#include <vector>

namespace lekalo::render {

namespace {

constexpr double kFirst = 380, kStep = 5;  // nanometres
const std::vector<std::array<double, 3>> kObserver = {
#include "render/integrators/data/cie1931.inc"
};

}  // namespace

Vec3 observed(const std::function<double(double)>& power) {
  Vec3 xyz(0);
  for (size_t i = 0; i < kObserver.size(); ++i)
    xyz += kStep * power(kFirst + kStep * static_cast<double>(i)) *
           Vec3(kObserver[i][0], kObserver[i][1], kObserver[i][2]);
  return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
          -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
          0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

}  // namespace lekalo::render
