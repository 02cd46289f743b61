// The section `constraints`: unknown points, numbers and poses, and the conditions that they are to meet (Golovanov
// 2016, chapter 7).
#pragma once

#include <vector>

#include "geometry/describe.h"

namespace lekalo::render {

std::vector<geometry::Field> constraint_fields();

}  // namespace lekalo::render
