// F(o + s d) = A s^2 + 2 B s + C without cancellation:
//   - where A is not small, o moves to s = -B/A first, so that B is only rounding and the discriminant is -A C;
//   - the discriminant B^2 - A C is formed with fused multiply-adds (Kahan), exact to two ulps of its own terms;
//   - q = -(B + sign(B) sqrt(B^2 - A C)), the roots are q/A and C/q (Haines et al. 2019);
//   - one Newton step on F at each root takes away what is left.
#include "geometry/surfaces/quadric_line.h"

#include <cmath>

#include "geometry/numerics/instruction_sets.h"
#include "geometry/surfaces/local_line.h"

namespace lekalo::geometry {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// b^2 - a c (Kahan; Jeannerod, Louvet, Muller 2013).
inline double discriminant(double a, double b, double c) {
  const double ac = a * c;
  const double error = std::fma(-a, c, ac);
  return std::fma(b, b, -ac) + error;
}

}  // namespace

LEKALO_FUSED QuadricRoots quadric_roots(const Quadric& quadric, const Vec3& origin, const Vec3& direction) {
  QuadricRoots roots;
  Vec3 o = origin;
  const Vec3& d = direction;
  const double dd = glm::dot(d, d);
  double a = quadric.square(d);
  if (std::abs(a) <= 4 * kEpsilon * dd) a = 0;
  double b = quadric.half_slope(o, d);
  if (std::abs(a) > 0.25 * dd) {
    roots.start = -b / a;
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
    roots.s = {q / a, q == 0 ? 0.0 : c / q};
    if (roots.s[0] > roots.s[1]) std::swap(roots.s[0], roots.s[1]);
  }
  roots.square = a;
  roots.origin = o;
  return roots;
}

QuadricHit quadric_hit(const Quadric& quadric, const Vec3& direction, const QuadricRoots& roots, int i) {
  double s = roots.s[i];
  Vec3 p = roots.origin + s * direction;
  const double step = -0.5 * quadric.value(p) / quadric.half_slope(p, direction);
  if (std::abs(step) <= QuadricRoots::kLargestStep * std::abs(s)) {
    s += step;
    p = roots.origin + s * direction;
  }
  return {roots.start + s, p};
}

}  // namespace lekalo::geometry
