// The axis of a milling tool that runs along a row on a surface (Zavyalov et al. 1985, VII.4).
#pragma once

#include <cmath>

#include "geometry/formula.h"

namespace lekalo::geometry {

// q = <t x n> cos(tilt) + n sin(tilt): t the unit tangent of the row, n the unit normal across it, tilt the angle
// between the axis and the tangent plane, in radians. Of length 1.
template <class T>
Triple<T> tool_axis(const Triple<T>& tangent, const Triple<T>& normal, const T& tilt) {
  using std::cos;
  using std::sin;
  return cos(tilt) * cross(tangent, normal) + sin(tilt) * normal;
}

// The tangent of any length.
inline Vec3 tool_axis(const Vec3& along_row, const Vec3& normal, double tilt) {
  const Triple<double> q = tool_axis(triple(glm::normalize(along_row)), triple(normal), tilt);
  return {q.x, q.y, q.z};
}

}  // namespace lekalo::geometry
