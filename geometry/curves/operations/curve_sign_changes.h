// Where a function of the place changes its sign along a curve.
#pragma once

#include <functional>
#include <vector>

#include "geometry/curve.h"

namespace lekalo::geometry {

// By t, in order; the beginning stands for both ends of a closed curve. `range` bounds the function over boxes, `value`
// is the function. Everywhere else the bounds show that the function has one sign; but of two changes within 1e-7 of
// the domain both are lost, and where it keeps to zero nothing is known. The domain must be finite.
std::vector<double> sign_changes(const Curve& curve, bool closed, const std::function<Interval(const Box3&)>& range,
                                 const std::function<double(const Vec3&)>& value);

}  // namespace lekalo::geometry
