// The objects of a model where they are placed: those of a group once for each time that the group is shown.
#pragma once

#include <functional>
#include <vector>

#include "render/scene/model.h"

namespace lekalo::render {

// Which of its placements an object stands in, in their order.
using VisitPlaced = std::function<void(const Object& object, const geometry::Affine& to_world, int placement)>;

// Of the same numbers.
inline bool same_map(const geometry::Affine& a, const geometry::Affine& b) {
  return a.linear == b.linear && a.offset == b.offset;
}

// All that are no groups, in their order.
void each_placed(const std::vector<Object>& objects, const VisitPlaced& visit);

}  // namespace lekalo::render
