// By how much a map between two surfaces stretches (Zavyalov, Leus, Skorospelov 1985, IV.4): points of equal parameters
// belong together, as those of a surface and of its development.
#pragma once

#include "geometry/surface.h"

namespace lekalo::geometry {

struct Stretch {
  double value = 1;  // length on the other surface for a length of 1
  double u = 0, v = 0;
  double strain() const { return 0.5 * (value * value - 1); }  // of Green and Lagrange, relative change for small ones
};

struct Stretches {
  Stretch least, greatest;
};

// The principal stretches at a place: lambda^2 are the roots of |B - lambda^2 A| = 0, A and B the first fundamental
// forms. NaN where `from` has no tangent plane.
std::pair<double, double> principal_stretches(const Surface& from, const Surface& to, double u, double v);

// The least and the greatest of them, searched from the best of `samples` places each way. Throws
// std::invalid_argument for unbounded surfaces, of different domains, or without tangent planes.
Stretches stretches(const Surface& from, const Surface& to, int samples);

}  // namespace lekalo::geometry
