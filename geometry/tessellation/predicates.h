// Orientation tests in the plane that planar triangulation decides by.
#pragma once

#include "geometry/vectors.h"

namespace lekalo::geometry {

// Positive when a, b, c turn left, negative when they turn right, zero exactly when they are collinear: the sign of
// the determinant |b - a, c - a| is exact (rounding analysis first, exact expansions where it is not sure).
double orient2d(const Vec2& a, const Vec2& b, const Vec2& c);

// True when d is certainly inside the circle through a, b, c (which turn left). Where a rounding of twice the bits of a
// double leaves a doubt (the corners of a grid's rectangles lie on one circle) the answer is no, so that flips which
// ask this always end.
bool surely_in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

}  // namespace lekalo::geometry
