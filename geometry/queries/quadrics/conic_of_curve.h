// Which conic a curve lies on, from its exact quadratic form (Golovanov 2016, 2.5).
#pragma once

#include <optional>

#include "geometry/curves/analytic/conic_equation.h"

namespace lekalo::geometry {

// None where the curve has no rational form of the second degree, or its pieces lie on different conics or on lines.
std::optional<CanonicalConic> conic_of(const Curve& curve);

}  // namespace lekalo::geometry
