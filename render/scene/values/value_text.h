// What a field accepts, in words.
#pragma once

#include <string>

#include "geometry/describe.h"

namespace lekalo::render {

// "length greater than 0", "angle in degrees", "one of box, gaussian", "a curve: name or map".
std::string value_text(const geometry::FieldType& type);

}  // namespace lekalo::render
