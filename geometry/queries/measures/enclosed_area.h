// The area that a closed plane curve runs around.
#pragma once

#include <optional>

#include "geometry/queries/measures/mass_properties.h"

namespace lekalo::geometry {

// |1/2 closed integral of r x r'|: parts that the curve runs around twice count twice, those on its other side are
// subtracted. None where the curve is not closed or lies in no plane.
std::optional<Measured> enclosed_area(const Curve& curve);

}  // namespace lekalo::geometry
