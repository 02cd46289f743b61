// Nets of oriented points on surfaces.
#pragma once

#include <vector>

#include "geometry/surface.h"

namespace lekalo::geometry {

// A point of a surface with its unit normal.
struct Surfel {
  Vec3 point{0};
  Vec3 normal{0, 0, 1};
  double u = 0, v = 0;
};

// An (epsilon, gamma)-net (Zavyalov, Leus, Skorospelov 1985, III.3, VI.2): for each point of the surface there is a
// surfel within epsilon (> 0) whose normal is off by at most gamma (> 0, radians). The middles of cells of the
// parameter rectangle, which are halved until enclosures of the surface and of r_u x r_v say so; where the normal is
// none, at poles and tips, cells far smaller than epsilon are taken whatever gamma is. Throws FieldError (field
// epsilon) if it would take more than a million.
std::vector<Surfel> surfel_net(const Surface& surface, double epsilon, double gamma);

}  // namespace lekalo::geometry
