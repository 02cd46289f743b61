// Points of bodies, surfaces and curves that drawings speak of: the farthest one in a direction, one well inside of a
// face, those at which a dimension may begin.
#pragma once

#include <vector>

#include "geometry/queries/closest/distance.h"

namespace lekalo::geometry {

// A point that lies as far in the direction as any; where more than one does, one of them. Certified, as distances
// are. Throws std::invalid_argument for what is unbounded.
Vec3 extreme_point(const Distant& of, const Box3& box, const Vec3& way);

// Points of a curve, so many steps over each smooth piece, both ends. A multiple of 4 has the farthest points of a
// circle among them.
std::vector<Vec3> points_along(const Curve& curve, int steps);

// A point well inside of a face: of those of a grid of its parameters that are about farthest from its edges the one
// nearest to their middle.
Vec3 inner_point(const Body& body, int face);

// Half of the way along an edge.
Vec3 middle_of(const Curve& curve);

// Points along the edges of a face, or of those parts of a body's edges that lie as far in the direction as any.
std::vector<Vec3> points_of_border(const Body& body, int face, int steps = 64);
std::vector<Vec3> points_at_end(const Body& body, const Vec3& way);

}  // namespace lekalo::geometry
