// Numerical integration: Gauss-Legendre rules of any size, and adaptive Gauss-Kronrod integration of several integrands
// at a time over an interval or a rectangle (Piessens et al. 1983, QUADPACK).
//
// Several integrands share their evaluation points: the eleven integrals of mass properties (area, volume, first and
// second moments) need the surface's point and normal once. Integrands should be smooth on every piece: pass the
// breaks.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "geometry/numerics/interval.h"

namespace lekalo::geometry {

// Nodes in (-1, 1) in increasing order and their weights, which sum to 2; exact for polynomials up to degree 2n - 1.
struct GaussRule {
  std::vector<double> nodes, weights;
};

// n >= 1; nodes and weights are correct to about an ulp for n up to some thousands.
GaussRule gauss_legendre(int n);

// When to stop. Integrand i is done when its estimated error is at most
// max(absolute, relative * integral of |f_i|, noise * integral of |f_0|); against |f_i|, so that an integral which is
// zero by symmetry has an end too, and against the first integrand for those that are its multiples by something whose
// rounding is known: what is nothing but that rounding never gets better.
struct IntegrationGoal {
  double absolute = 0;
  double relative = 1e-11;    // not below about 1e-14, which rounding cannot reach
  int evaluations = 1000000;  // of the integrand, at most (about: a last cell is finished)
  double noise = 0;
};

// `error` estimates the absolute error of `value`, integrand by integrand. The estimate compares the 7-point Gauss with
// the 15-point Kronrod rule; for smooth integrands it is usually far too large, for integrands with unseen spikes it
// means nothing.
struct Integral {
  std::vector<double> value, error;
  int evaluations = 0;
  // False: the evaluations ran out, or an integrand is not finite at more than places between which it could be
  // integrated (all values are then NaN).
  bool converged = false;
};

// Writes the values of all integrands at the point; the span has `count` elements.
using Integrand = std::function<void(double x, std::span<double> values)>;
using Integrand2 = std::function<void(double u, double v, std::span<double> values)>;

// The integrals of `count` >= 1 integrands over [breaks.front(), breaks.back()]; breaks increase, at least two, all
// finite.
Integral integrate(const Integrand& f, int count, std::span<const double> breaks, const IntegrationGoal& goal = {});
Integral integrate(const Integrand& f, int count, const Interval& range, const IntegrationGoal& goal = {});

// The same over a rectangle, with breaks in both directions. Cells are split across the direction that errs more.
Integral integrate(const Integrand2& f, int count, std::span<const double> u_breaks, std::span<const double> v_breaks,
                   const IntegrationGoal& goal = {});
Integral integrate(const Integrand2& f, int count, const Interval& u, const Interval& v,
                   const IntegrationGoal& goal = {});

}  // namespace lekalo::geometry
