// Real roots of polynomials: certified for any degree, and fast closed-form quality for the quadratic and the quartic.
//
// Two words on rounding. Where a polynomial crosses zero its root is found to its own conditioning: |x - root| is about
// E / |p'(x)|, E the rounding error of evaluating p. Where it only touches zero, no rounded arithmetic can tell a
// double root from two close ones or from none; all of these, as long as |p| <= E there, are reported as one root with
// `tangent` set, placed at the extremum of p (which is well conditioned). So a grazing ray's hit is never lost, and the
// caller decides what it means. Two roots that can be told apart are reported as two.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/numerics/interval.h"

namespace lekalo::geometry {

struct PolynomialRoot {
  double x = 0;
  bool tangent = false;  // an even number of roots as close as rounding can tell; the sign does not change
};

// A root with the interval that is certain to hold it, or, for a cluster of roots that rounding cannot separate, all of
// it.
struct CertifiedRoot : PolynomialRoot {
  Interval within;
};

// All real roots in the finite, closed `domain` of the polynomial with the Bernstein coefficients b (degree = size - 1)
// over that domain, in increasing order. No root is lost: every part of the domain outside the `within` intervals is
// proved free of roots, and each `within` without `tangent` that ends inside the domain is proved to hold a change of
// sign. A root at an end of the domain counts. Coefficients given as intervals stand for every polynomial in them. A
// polynomial that cannot be told from zero on a stretch gives one root whose `within` is that stretch. No coefficients,
// or a coefficient or domain end that is not finite: no roots.
std::vector<CertifiedRoot> bernstein_roots(std::span<const double> b, const Interval& domain = {0, 1});
std::vector<CertifiedRoot> bernstein_roots(std::span<const Interval> b, const Interval& domain = {0, 1});

// The same for p(x) = c[0] + c[1] x + ... The change of basis is certified too, but loses about 2^degree ulps, and more
// on a domain whose distance from 0 is large against its width.
std::vector<CertifiedRoot> power_roots(std::span<const double> c, const Interval& domain);

// At most N roots in increasing order, without allocation.
template <int N>
struct Roots {
  std::array<PolynomialRoot, N> root{};
  int count = 0;

  void add(double x, bool tangent) { root[count++] = {x, tangent}; }
  const PolynomialRoot* begin() const { return root.data(); }
  const PolynomialRoot* end() const { return root.data() + count; }
  const PolynomialRoot& operator[](int i) const { return root[i]; }
  int size() const { return count; }
};

// Roots of c[0] + c[1] x + c[2] x^2. The discriminant is computed to two ulps and neither root suffers from
// cancellation. `relative_error` is the relative error that each coefficient carries: a discriminant within it of zero
// gives one tangent root. A zero leading coefficient means a line; a constant (also zero), or a coefficient that is not
// finite, has no roots.
Roots<2> quadratic_roots(const std::array<double, 3>& c, double relative_error = 0);

// Roots in the closed domain (which may be infinite) of c[0] + ... + c[4] x^4, each coefficient of which carries the
// relative error given. Found between the extrema of p, themselves found the same way; p(x) counts as zero where |p(x)|
// does not exceed the sum of its running rounding error (Higham 2002, 5.1) and that of its coefficients. Leading
// coefficients may be zero. A root within that error of an end of the domain is reported at the end. The zero
// polynomial, and one with a coefficient that is not finite, has no roots. Roots outside `wanted` may be left out; the
// others do not depend on it. For a caller who polishes the roots, Newton's iteration may end with a step no longer
// than `last_step`: the root is then wrong by about that step's square, divided by the distance of the next root.
Roots<4> quartic_roots(const std::array<double, 5>& c, const Interval& domain = Interval::entire(),
                       double relative_error = 0, const Interval& wanted = Interval::entire(), double last_step = 0);

}  // namespace lekalo::geometry
