// Splines by least squares (Zavyalov et al. 1985, I.1, II.5; Piegl, Tiller 1997, 9.4).
#pragma once

#include <optional>

#include "geometry/curves/interpolation/tangent_estimates.h"
#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

struct FitOptions {
  int degree = 3;
  std::vector<double> weights{};  // of squared distances, > 0; none: all 1
  double stiffness = 0;           // of the integral of |r''|^2 beside them
  int passes = 0;                 // of moving parameters to the feet of the points, each followed by another fit
  // Of cubics: pieces of class C1, and these weights >= 0 of squared jumps of r'' where they meet, beside the sum: one
  // for all, or one for each knot. None: a spline of class C2.
  std::vector<double> jump_weights{};
};

// The spline with these inner knots (closed: all knots of a period, the first one the seam) that makes the sum of
// squared distances from the points at their parameters smallest. Throws FieldError (field points) where the points do
// not determine it, (fields weights, jump_weights) for wrong weights.
NurbsCurve fit_curve(const PointSequence& data, const std::vector<double>& knots, const FitOptions& options);

// Inner knots that leave about as many points to each of so many spans.
std::vector<double> even_knots(const PointSequence& data, int spans);

// The same with knots put in where points are farther away than the tolerance, until none is. Throws FieldError (field
// tolerance) where that cannot be.
NurbsCurve fit_within(const PointSequence& data, double tolerance, const FitOptions& options);

}  // namespace lekalo::geometry
