// Exact rational quadratics of circle and hyperbola arcs over their natural parameters (Golovanov 2016, 2.5, 2.14).
//
// An arc over [m - d/2, m + d/2] is the rational Bezier curve with the end points of the arc, the middle point
// (cos m, sin m)/cos(d/2) and the middle weight cos(d/2); the hyperbola likewise with cosh and sinh. Its own parameter
// is not the angle: the forms come with half-angle (hyperbolic) maps.
#pragma once

#include "geometry/curve.h"

namespace lekalo::geometry {

// (cos t, sin t, 0): equal spans of at most a quarter turn, so that weights stay above 0.7; knots in radians. The range
// is at most one turn; the last point of a full turn is exactly the first. Coordinates at multiples of a right angle
// are exact.
NurbsCurveForm circle_form(const Interval& t);

// (cosh t, sinh t, 0): equal spans of a width of at most 2.
NurbsCurveForm hyperbola_form(const Interval& t);

// The polynomial a + b t + c t^2, one span. Degree 1 where c is zero.
NurbsCurveForm parabola_form(const Interval& t, const Vec3& a, const Vec3& b, const Vec3& c = Vec3(0));

}  // namespace lekalo::geometry
