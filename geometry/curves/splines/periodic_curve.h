// Closed NURBS curves without a seam: periodic knots and unrepeated points (Golovanov 2016, 2.9).
#pragma once

#include <functional>

#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

// Whether the curve is periodic over the whole of its domain, which begins in a knot.
bool is_whole_period(const NurbsCurve& curve);

// The periodic curve with a knot of multiplicity `degree` at its seam, from a clamped form whose end points are one; a
// circle of nine points becomes one of eight (2.14). Throws std::invalid_argument where the ends do not meet.
NurbsCurve periodic_curve(const NurbsCurveForm& clamped);

// What `operation` makes of a periodic curve: it is given three periods, the middle one being the curve's, and must do
// the same to each. The result is periodic again.
NurbsCurve in_every_period(const NurbsCurve& curve,
                           const std::function<NurbsCurveForm(const NurbsCurveForm& three_periods)>& operation);

}  // namespace lekalo::geometry
