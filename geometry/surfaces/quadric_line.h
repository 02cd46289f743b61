// Hits of a line with a quadric in its own, scaled coordinates.
#pragma once

#include <array>
#include <cmath>

#include "geometry/surface.h"
#include "geometry/surfaces/local_line.h"

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

// Roots of F(origin + s direction) before the last Newton step.
struct QuadricRoots {
  int count = 0;
  std::array<double, 2> s{};  // increasing, in units of the direction, from start
  double start = 0;           // from the origin that was given to `origin`
  Vec3 origin{0};
  double square = 0;  // F's second-order part of the direction, zero where it is only rounding

  // False if the root will not lie in the range (which counts from the given origin) after the last step either; only
  // for not doing work.
  bool may_lie_in(const Interval& range, int i) const {
    const double slack = 2 * kLargestStep * (std::abs(s[i]) + std::abs(start)), at = start + s[i];
    return at >= range.lo - slack && at <= range.hi + slack;
  }
  static constexpr double kLargestStep = 1e-6;  // of a last step, as a part of the root
};

// A root after the last step, from the given origin, and its point in scaled coordinates.
struct QuadricHit {
  double s;
  Vec3 point;
};

// None at a double root: a line that touches does not count. A line that lies in the surface has no hits. A cone
// (x^2 + y^2 - z^2 = 0) is hit twice by every line steeper than it, at its apex also.
QuadricRoots quadric_roots(const Quadric& quadric, const Vec3& origin, const Vec3& direction);

QuadricHit quadric_hit(const Quadric& quadric, const Vec3& direction, const QuadricRoots& roots, int i);

// Calls visit(t, point) for the hits with t in the range, in the order of t, until `hits` has enough. `line` is in the
// quadric's frame, whose coordinates times `scale` are those of F.
template <class Visit>
void visit_quadric_hits(const Quadric& quadric, const MovedLine& line, const Vec3& scale, const Interval& range,
                        const LineHits& hits, Visit visit) {
  const Vec3 direction = line.direction * scale;
  const QuadricRoots roots = quadric_roots(quadric, line.origin * scale, direction);
  const Interval near{range.lo - line.start, range.hi - line.start};
  for (int i = 0; i < roots.count && !hits.is_enough(); ++i) {
    if (!roots.may_lie_in(near, i)) continue;
    const QuadricHit hit = quadric_hit(quadric, direction, roots, i);
    const double t = line.start + hit.s;
    if (range.contains(t)) visit(t, hit.point);
  }
}

}  // namespace lekalo::geometry
