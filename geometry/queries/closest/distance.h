// Distances between points, curves, surfaces and bodies: the places where they are nearest to each other and all other
// local minima (Golovanov 2016, 4.1 and 4.2; Zavyalov 2006, IV.2).
//
// Each operand is taken apart into elements: points (ends, corners, kinks, poles, vertices), lines (smooth pieces of
// curves, edges and creases) and smooth patches. On each pair of elements the places with (r_a - r_b) . dr_a =
// (r_a - r_b) . dr_b = 0 are isolated by interval arithmetic (geometry/numerics/root_search.h), one to four unknowns,
// and those kept where the distance has a minimum: among the elements beside them too. None is lost.
#pragma once

#include <array>
#include <variant>
#include <vector>

#include "geometry/body.h"
#include "geometry/curve.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// Things nearer than this part of their size meet: rounding after a few operations, as of the edges of our bodies.
inline constexpr double kIntersection = 1e-12;

// What distances are measured between. The pointers must outlive the call.
using Distant = std::variant<Vec3, const Curve*, const Surface*, const Body*>;

// A place on a curve (`t`), a surface (`u`, `v`) or a body: its vertex, edge (`t`) or face (`u`, `v`) of that index.
struct DistancePlace {
  enum class Kind { point, curve, surface, vertex, edge, face };
  Kind kind = Kind::point;
  int index = -1;  // of bodies
  double t = 0, u = 0, v = 0;
  Vec3 point{0};
};

struct DistanceMinimum {
  DistancePlace a, b;
  double distance = 0;
  // False where places beside these are as near: parallel lines, coaxial circles, concentric spheres. These reach
  // within the ranges of t, or of u and v, on each (one place: a range of no width; the ranges of a point are not set;
  // of unbounded surfaces they may be without end).
  bool isolated = true;
  std::array<Interval, 2> range_a{}, range_b{};
};

struct Distance {
  double distance = 0;  // of the first minimum, 0 where they meet
  // What the distance is not below for certain: the distance but for rounding, except where a minimum is not isolated.
  double bound = 0;
  bool meet = false;
  std::vector<DistanceMinimum> minima;  // by distance
};

// All local minima, or those that are as near as the nearest (which takes less time). Two surfaces or bodies that meet
// have one minimum, a place where they do: it is the only one listed; so has a curve that lies on curved surfaces. A
// body is its surface: a thing in its inside has a distance from it. Of unbounded surfaces planes, cylinders and cones
// have distances from what is bounded, and whole planes and circular cylinders from each other: throws
// std::invalid_argument for others.
enum class DistanceMinima { all, nearest };
Distance distance(const Distant& a, const Distant& b, DistanceMinima wanted = DistanceMinima::all);

}  // namespace lekalo::geometry
