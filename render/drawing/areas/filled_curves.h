// Closed plane curves that have a `fill` of their own: in drawings with `ground: fill` the region inside each is a
// surface, so that what it hides and what hides it are found as of all surfaces.
#pragma once

#include <string>
#include <vector>

#include "render/model/model.h"

namespace lekalo::render {

// The objects with those regions behind the curves that bound them. `left_out`: of curves that bound none, why.
std::vector<Object> with_filled_curves(const std::vector<Object>& objects, std::vector<std::string>& left_out);

}  // namespace lekalo::render
