// What a scene's reader should know of shapes whose points code outside the program computes.
#pragma once

#include <string>
#include <vector>

#include "render/scene/values/source.h"

namespace lekalo::render {

// One such curve or surface, as it was found to be (geometry::FitReport).
struct ExternalNote {
  Place place;                      // of the entity
  std::string text;                 // how rays meet it, and how near that is
  std::vector<std::string> doubts;  // derivatives that contradict the points
};

}  // namespace lekalo::render
