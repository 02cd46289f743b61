// Curves that go from the end of one curve to an end of another (Golovanov 2016, 2.15, transition).
#pragma once

#include "geometry/curve.h"

namespace lekalo::geometry {

// Where a curve is left or entered, and how: the direction of travel is along the parameter, or against it.
struct CurveEnd {
  CurvePtr curve;
  bool at_start = false;
  bool against = false;
};

// The Bezier curve of degree 2 k + 1 whose ends have the point, and the derivatives by arc length up to the order k
// (1..3) of the given curves, times powers of `tension` times the distance between the ends: joints of continuity G1,
// G2 or G3. Throws FieldError (fields from, to) for ends at one point or without a tangent.
NurbsCurveForm transition(const CurveEnd& from, const CurveEnd& to, int continuity, double tension_from,
                          double tension_to);

}  // namespace lekalo::geometry
