// The axis of a milling tool that runs along a row on a surface (Zavyalov et al. 1985, VII.4).
#pragma once

#include <cmath>

#include "geometry/vectors.h"

namespace lekalo::geometry {

// q = <t x n> cos(tilt) + n sin(tilt): t the tangent of the row, n the unit normal across it, tilt the angle between
// the axis and the tangent plane, in radians. Of length 1.
inline Vec3 tool_axis(const Vec3& along_row, const Vec3& normal, double tilt) {
  return std::cos(tilt) * glm::normalize(glm::cross(along_row, normal)) + std::sin(tilt) * normal;
}

}  // namespace lekalo::geometry
