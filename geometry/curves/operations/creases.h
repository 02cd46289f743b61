// Creases: parameter lines of one surface along which two of its smooth pieces meet at an angle, as at the knots of
// splines of degree 1, full knots, and corners of the curves that are moved to make a surface.
#pragma once

#include <vector>

#include "geometry/curves/operations/parameter_line.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// Faces, and pieces of one surface, meet smoothly where their normals differ by less than this: what a modeller means
// by it.
inline constexpr double kSmoothEdge = 1e-3;

struct Crease {
  IsoDirection held = IsoDirection::u;
  double at = 0;   // at a seam the lower end of the domain, where the surface meets its upper end
  Interval along;  // of the other parameter
  bool seam = false;
};

// Those along which the normals of both sides differ by more than `angle` (radians) somewhere between two crossings
// with borders of pieces; parts that go on in one another are one. None of an unbounded surface. Collapsed edges have
// none.
std::vector<Crease> creases(const Surface& surface, double angle = kSmoothEdge);

}  // namespace lekalo::geometry
