// The region of a pocket in its plane, as polygons near an offset of its contours (Zavyalov et al. 1985, V.2).
#pragma once

#include <vector>

#include "geometry/curve.h"

namespace lekalo::geometry {

using Polygon2 = std::vector<Vec2>;  // closed, the last corner is not repeated

// Polygons with the region on their left: outer ones counterclockwise, holes clockwise.
struct PocketRegion {
  std::vector<Polygon2> rims;
};

double signed_area(const Polygon2& polygon);
double area(const PocketRegion& region);

// What lies at least so far inside of `outer` and outside of all islands: rims in the band between nearest and
// farthest from the contours. Chords of curves and of the arcs about corners take up half of the band. The curves are
// closed, in one plane of constant z, in any direction, and none crosses itself; islands may meet each other and
// reach over the outer contour, but none lies outside of it. Throws FieldError (fields outer, islands, allowance) where
// that is not so, and (the field of the distance) where nothing is left.
PocketRegion inset_region(const Curve& outer, const std::vector<CurvePtr>& islands, double nearest, double farthest,
                          const char* field_of_distance = "allowance");

}  // namespace lekalo::geometry
