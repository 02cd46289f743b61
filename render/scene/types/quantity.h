// A number that is measured of the scene's geometry, as the value of a parameter.
#pragma once

#include <string>

#include "geometry/body.h"
#include "geometry/expression/expression.h"

namespace lekalo::render {

// What a type of the category `quantity` builds: a plain number, or an angle in radians.
struct MeasuredQuantity {
  double value = 0;
  geometry::Measure measure = geometry::Measure::plain;
};

// What such a type builds where the number is an attribute of an element, or its mass, which the scene's attributes
// tell.
struct QuantityOfElement {
  std::string attribute;
  geometry::BodyPtr body;  // closed: its mass is asked for; null: the attribute
};

}  // namespace lekalo::render
