#include "render/integrators/dispersion.h"

namespace lekalo::render {

bool disperses(const Material& material) {
  if (!material.transmits()) return false;
  const auto violet = material.interior(Wavelengths{{400, 400, 400, 400}});
  const auto red = material.interior(Wavelengths{{700, 700, 700, 700}});
  return violet && red && violet->index != red->index;
}

}  // namespace lekalo::render
