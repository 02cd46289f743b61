// Whether a place where two elements are nearest to each other is a minimum of what they are parts of.
#pragma once

#include "geometry/queries/closest/distance_search.h"

namespace lekalo::geometry {

// True where the distance grows into the elements beside `a` and `b`. Level to first order, it is compared a little way
// off; where it stays the same there the minimum is set to be not isolated.
bool is_minimum_beside(const ElementPair& pair, const ElementPlace& a, const ElementPlace& b, double size,
                       DistanceMinimum& minimum);

}  // namespace lekalo::geometry
