// Hits of a line with a quadric in its own, scaled coordinates.
//
// F(o + s d) = A s^2 + 2 B s + C without cancellation:
//   - where A is not small, o moves to s = -B/A first, so that B is only rounding and the discriminant is -A C;
//   - the discriminant B^2 - A C is formed with fused multiply-adds (Kahan), exact to two ulps of its own terms;
//   - q = -(B + sign(B) sqrt(B^2 - A C)), the roots are q/A and C/q (Haines et al. 2019);
//   - one Newton step on F at each root takes away what is left.
//
// All of it is inline: who calls it is LEKALO_FUSED.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "geometry/surface.h"
#include "geometry/surfaces/analytic/local_line.h"

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

// b^2 - a c (Kahan; Jeannerod, Louvet, Muller 2013).
inline double discriminant(double a, double b, double c) {
  const double ac = a * c;
  const double error = std::fma(-a, c, ac);
  return std::fma(b, b, -ac) + error;
}

// None at a double root: a line that touches does not count. A line that lies in the surface has no hits. A cone
// (x^2 + y^2 - z^2 = 0) is hit twice by every line steeper than it, at its apex also.
inline QuadricRoots quadric_roots(const Quadric& quadric, const Vec3& origin, const Vec3& direction) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  QuadricRoots roots;
  Vec3 o = origin;
  const Vec3& d = direction;
  const double dd = glm::dot(d, d);
  double a = quadric.square(d);
  if (std::abs(a) <= 4 * kEpsilon * dd) a = 0;
  double b = quadric.half_slope(o, d);
  const double per_a = 1 / a;
  if (std::abs(a) > 0.25 * dd) {
    roots.start = -b * per_a;
    o += roots.start * d;
    b = quadric.half_slope(o, d);
  }
  const double c = quadric.value(o);
  if (a == 0) {
    const double size = glm::length(o) + std::abs(quadric.constant) + std::abs(quadric.linear_z);
    if (std::abs(b) <= 4 * kEpsilon * std::sqrt(dd) * size) return roots;
    roots.count = 1;
    roots.s[0] = -0.5 * c / b;
  } else {
    double root = discriminant(a, b, c);
    if (!(root > 0)) {
      // A line inside a cone's opening crosses both nappes, through the apex as well; rounding must not lose that.
      const bool cone = quadric.squares.z < 0 && quadric.constant == 0 && quadric.linear_z == 0;
      if (!(cone && a < 0)) return roots;
      root = 0;
    }
    const double q = -(b + std::copysign(std::sqrt(root), b));
    roots.count = 2;
    roots.s = {q * per_a, q == 0 ? 0.0 : c / q};
    if (roots.s[0] > roots.s[1]) std::swap(roots.s[0], roots.s[1]);
  }
  roots.square = a;
  roots.origin = o;
  return roots;
}

inline QuadricHit quadric_hit(const Quadric& quadric, const Vec3& direction, const QuadricRoots& roots, int i) {
  double s = roots.s[i];
  Vec3 p = roots.origin + s * direction;
  const double step = -0.5 * quadric.value(p) / quadric.half_slope(p, direction);
  if (std::abs(step) <= QuadricRoots::kLargestStep * std::abs(s)) {
    s += step;
    p = roots.origin + s * direction;
  }
  return {roots.start + s, p};
}

// Calls visit(t, point) for the hits with t in the range, in the order of t, until `hits` has enough. `line` is in the
// quadric's frame, whose coordinates times `scale` are those of F.
template <class Visit>
__attribute__((always_inline)) inline void visit_quadric_hits(const Quadric& quadric, const MovedLine& line,
                                                              const Vec3& scale, const Interval& range,
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
