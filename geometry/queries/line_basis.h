// A line with what every piece asks of it, computed once for a line.
#pragma once

#include <cmath>

#include "geometry/vectors.h"

namespace lekalo::geometry {

struct LineBasis {
  Line line;
  Vec3 n1{0}, n2{0};           // unit vectors across the line
  double inverse_length2 = 1;  // 1 / |direction|^2

  explicit LineBasis(const Line& l) : line(l) {
    const double length2 = glm::dot(l.direction, l.direction);
    inverse_length2 = 1 / length2;
    const Vec3 d = l.direction / std::sqrt(length2);
    // Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017.
    const double sign = std::copysign(1.0, d.z);
    const double a = -1 / (sign + d.z), b = d.x * d.y * a;
    n1 = {1 + sign * d.x * d.x * a, sign * b, -sign * d.x};
    n2 = {b, sign + d.y * d.y * a, -d.y};
  }

  // The line's parameter nearest to a point.
  double foot(const Vec3& point) const { return glm::dot(point - line.origin, line.direction) * inverse_length2; }

  // The same line measured from its own point at t, in coordinates relative to `center`.
  LineBasis moved(double t, const Vec3& center) const {
    LineBasis result = *this;
    result.line.origin = line.at(t) - center;
    return result;
  }
};

}  // namespace lekalo::geometry
