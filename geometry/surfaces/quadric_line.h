// Hits of a line with a quadric in its own, scaled coordinates.
#pragma once

#include "geometry/vectors.h"

namespace lekalo::geometry {

// F(p) = squares . p^2 + linear_z z + constant: with coefficients 0, 1, -1 every quadric after scaling its axes.
struct Quadric {
  Vec3 squares{1};
  double linear_z = 0;
  double constant = -1;

  double value(const Vec3& p) const { return glm::dot(squares * p, p) + linear_z * p.z + constant; }
  // Half the derivative of F along d.
  double half_slope(const Vec3& p, const Vec3& d) const { return glm::dot(squares * p, d) + 0.5 * linear_z * d.z; }
  double square(const Vec3& d) const { return glm::dot(squares * d, d); }
};

struct QuadricHits {
  int count = 0;
  std::array<double, 2> s{};    // increasing, in units of the direction
  std::array<Vec3, 2> point{};  // in scaled coordinates
  double square = 0;            // F's second-order part of the direction, zero where it is only rounding
};

// Roots of F(origin + s direction); none at a double root: a line that touches does not count. A line that lies in the
// surface has no hits. A cone (x^2 + y^2 - z^2 = 0) is hit twice by every line steeper than it, at its apex also.
QuadricHits quadric_hits(const Quadric& quadric, const Vec3& origin, const Vec3& direction);

}  // namespace lekalo::geometry
