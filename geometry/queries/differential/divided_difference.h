// Divided differences of a curve over nodes, simple and multiple (Golovanov 2016, 2.7.1 to 2.7.5).
//
//   r[t_i] = r(t_i),  r[t_0 .. t_m] = (r[t_1 .. t_m] - r[t_0 .. t_(m-1)])/(t_m - t_0),  r[t .. t] = r^(m)(t)/m!
//
// They are the coefficients of Newton's polynomial r[t_0] + r[t_0, t_1] (t - t_0) + .. through the points. The order of
// the nodes does not matter to the last of them. Nearly equal nodes lose digits.
#pragma once

#include <span>
#include <vector>

#include "geometry/curve.h"

namespace lekalo::geometry {

struct DividedDifferences {
  std::vector<double> nodes;      // as given, equal ones put together
  std::vector<Vec3> differences;  // r[t_0], r[t_0, t_1], .., r[t_0 .. t_m]
};
// Throws std::invalid_argument for no node, and for one that stands more than kMaxCurveOrder + 1 times.
DividedDifferences divided_differences(const Curve& curve, std::span<const double> nodes);

}  // namespace lekalo::geometry
