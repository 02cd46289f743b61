// Where halving a range must end.
#pragma once

#include "geometry/numerics/interval.h"

namespace lekalo::geometry {

// False where no number lies between the ends: far from zero that is wider than any part of a small range.
inline bool can_be_halved(const Interval& t) { return t.lo < t.middle() && t.middle() < t.hi; }

}  // namespace lekalo::geometry
