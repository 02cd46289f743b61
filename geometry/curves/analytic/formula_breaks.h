// Where a curve of formulas breaks: kinks, steps and poles of its formulas.
#pragma once

#include <vector>

#include "geometry/curve.h"
#include "geometry/point_formulas.h"

namespace lekalo::geometry {

// The stretches of a domain in which the point is smooth and bounded, in order; at least one. They follow one another
// but at poles, whose neighbourhood, where the point is beyond 1e6 of its usual distances, is left out. The formulas
// are of one variable. At a step the end of the stretch before has the value of the one after, or its own: the limits
// are those of the next parameters inside. Breaks of atan2 stay inside of stretches, and those of formulas with more
// than 256 branches.
std::vector<Interval> smooth_stretches(const PointFormulas& point, const Interval& domain);

}  // namespace lekalo::geometry
