// The way of light through a scene, for drawings of it.
#pragma once

#include <vector>

#include "render/trace/world.h"

namespace lekalo::render {

struct LightPath {
  Vec3 from{0}, direction{0, 0, 1};  // of unit length
  double wavelength = 589;           // nanometres
  int bounces = 16;                  // surfaces met before it ends
  bool reflection = false;           // at a surface of glass the mirror ray is followed, not the refracted one
  double length = 1;                 // of its last part, if it meets nothing more
};

// The corners of the way, the beginning first. Where light enters or leaves a substance it is refracted by Snell's law,
// beyond the critical angle and on mirrors reflected (Golovanov 2016, 8.4); on other surfaces it ends. It begins in
// air, or in what it leaves first.
std::vector<Vec3> light_path(const World& world, const LightPath& path);

}  // namespace lekalo::render
