// Recursive ray tracing with the classic light model (Golovanov 2016, 8.4 and 8.5).
#pragma once

#include "render/integrator.h"

namespace lekalo::render {

enum class ShadowMode {
  none,        // every light reaches every point
  opaque,      // everything in the way stops light
  transparent  // transmitting bodies let the share k_t e^(-mu l) through, straight on
};

struct ClassicOptions {
  int max_depth = 12;                // mirror reflections and refractions of one path, in [0, 100]
  double weight_cutoff = 1.0 / 512;  // paths that would bring less than this share of their light are left out
  ShadowMode shadows = ShadowMode::transparent;
  double depth_attenuation = 0;           // k_r, 1/length, >= 0; 0: off
  std::optional<double> reference_depth;  // r_0; none: the nearest point of the scene's bounding sphere
  bool attenuate_lights = false;          // the depth term acts on the light of lights as well as on the ambient light
};

IntegratorPtr make_classic_integrator(const ClassicOptions& options = {});

}  // namespace lekalo::render
