// Curves that are slow to evaluate and to enclose (contours that solve their equations anew at every point) as
// piecewise polynomials that agree with them to rounding: for whoever asks thousands of questions of one curve.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "geometry/curves/splines/polynomial_curve.h"

namespace lekalo::geometry {

// Interpolates in Chebyshev's points and halves until points between them agree within `tolerance` (a length), checked,
// not proven. Null where the curve is not smooth enough for that in a reasonable number of parts. The domain must be
// finite; the parameter is the curve's. `joins_pieces`: one polynomial for several of the curve's pieces where it
// serves; its derivatives then agree less well.
std::shared_ptr<const PolynomialCurve> polynomial_approximation(const Curve& curve, double tolerance,
                                                                bool joins_pieces = false);

// The same to a share of the curve's largest coordinate (from some places); the curve itself where there is none.
CurvePtr as_polynomials(const CurvePtr& curve, double share);

// Of functions whose rounding moves points along a line more than across it.
struct OwnPace {
  double tolerance;  // how far along the line a point may be from the function's
  std::function<bool(double t, const Vec3& point)> is_on_line;
};

// The same of a function over smooth stretches that follow one another. With a pace, points agree too if they are on
// the line, and near.
std::shared_ptr<const PolynomialCurve> polynomial_approximation(const std::function<Vec3(double)>& point,
                                                                std::span<const Interval> pieces, double tolerance,
                                                                const OwnPace* pace = nullptr);

}  // namespace lekalo::geometry
