// A number that is measured of the scene's geometry, as the value of a parameter.
#pragma once

#include "geometry/expression/expression.h"

namespace lekalo::render {

// What a type of the category `quantity` builds: a plain number, or an angle in radians.
struct MeasuredQuantity {
  double value = 0;
  geometry::Measure measure = geometry::Measure::plain;
};

}  // namespace lekalo::render
