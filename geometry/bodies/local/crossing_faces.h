// Faces of a body that run through each other away from their edges.
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "geometry/body.h"

namespace lekalo::geometry {

// The first two faces without a common vertex that meet along a line; only pairs with a face that `is_new` are looked
// at. Pairs whose surfaces cannot be intersected count as apart.
std::optional<std::pair<int, int>> crossing_faces(const Body& body, const std::function<bool(int)>& is_new);

}  // namespace lekalo::geometry
