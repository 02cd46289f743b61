// A region of the plane in trapezoids: upright lines from every corner into the region, to the next rim (Zavyalov et
// al. 1985, V.2).
#pragma once

#include "geometry/machining/pocket_region.h"

namespace lekalo::geometry {

// Between x.lo and x.hi, from y lower at both ends to y upper. A triangle has one end of length 0.
struct Trapezoid {
  Interval x;
  double lower[2] = {0, 0}, upper[2] = {0, 0};  // at x.lo and x.hi
  double lower_at(double at) const;
  double upper_at(double at) const;
  // The mean of the four corners: the apex of a triangle counts twice.
  Vec2 center() const;
  double area() const;
};

// Two trapezoids that have a part of an upright side in common: b begins where a ends.
struct TrapezoidContact {
  int a = 0, b = 0;
  double x = 0;
  Interval y;
};

struct TrapezoidSplit {
  std::vector<Trapezoid> trapezoids;  // by their centers from left to right
  std::vector<TrapezoidContact> contacts;
};
TrapezoidSplit trapezoid_split(const PocketRegion& region);

}  // namespace lekalo::geometry
