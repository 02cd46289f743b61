// NURBS curves of lower degree and with fewer knots, with a bound of what that changes.
//
// The result takes the curve's points at Greville's abscissae of its knots, in homogeneous coordinates: a curve that
// can be written so is found exactly, any other is met there and at its ends. (Piegl, Tiller 1997, 5.4, 5.6 remove
// knots and degrees one by one; de Boor 2001, XIII on interpolation at these places.)
#pragma once

#include <span>

#include "geometry/curve.h"

namespace lekalo::geometry {

struct ReducedCurve {
  NurbsCurveForm form;
  double bound = 0;  // no point is farther than that from the curve's at the same parameter
};

// A bound of |a(t) - b(t)| over the domain, which both share, by Bezier coefficients of the difference on each common
// span; infinite unless all weights are positive. Both affine.
double deviation_bound(const NurbsCurveForm& a, const NurbsCurveForm& b);

// All of these take a form that is clamped and affine. Of lower degree, 1 <= degree <= form.degree; inner knots keep as
// much smoothness as they had, if the degree allows.
ReducedCurve reduced_degree(const NurbsCurveForm& form, int degree);

// Without these inner knots, each taken out once for each time it stands in the list. Throws std::invalid_argument for
// a number that is none.
ReducedCurve without_knots(const NurbsCurveForm& form, std::span<const double> knots);

// Without as many inner knots as can be taken out one after the other within the tolerance.
ReducedCurve with_fewest_knots(const NurbsCurveForm& form, double tolerance);

}  // namespace lekalo::geometry
