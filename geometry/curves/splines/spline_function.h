// Real functions that are splines: sums of B-splines with numbers as coefficients, f(t) = sum c_i N_i^p(t), their
// derivatives and integrals (Golovanov 2016, 2.8.15, 2.8.16; de Boor 2001, X), and their graphs.
#pragma once

#include <span>
#include <vector>

#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

// The end knots stand degree + 1 times, so that the knots' range is the function's domain; a knot inside stands at most
// degree + 1 times. degree >= 0: constant between knots when 0.
struct SplineFunction {
  int degree = 0;
  std::vector<double> knots;
  std::vector<double> coefficients;  // knots.size() - degree - 1
};

// The derivative, one degree lower; of a function of degree 0 there is none (std::invalid_argument).
SplineFunction derivative(const SplineFunction& f);

// The integral from the first knot on, one degree higher.
SplineFunction integral(const SplineFunction& f);

// The polynomial scale * (t - roots[0]) (t - roots[1]) .. over a domain.
SplineFunction product_of_roots(std::span<const double> roots, double scale, const Interval& domain);

// The plane curve (t, f(t)) over the domain. t is a spline with Greville's abscissae as coefficients, so that the graph
// is a spline exactly. Where a function jumps so does its graph.
NurbsCurve graph(const SplineFunction& f);

}  // namespace lekalo::geometry
