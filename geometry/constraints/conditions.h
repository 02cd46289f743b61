// The conditions between points, segments and markers of bodies that make up a system of constraints (Golovanov 2016,
// 7.2 and 7.3).
#pragma once

#include <array>
#include <string>

#include "geometry/constraints/constraint_system.h"
#include "geometry/curve.h"
#include "geometry/expression/expression.h"

namespace lekalo::geometry {

// A rigid body's position: the numbers of six unknowns, a rotation vector w and a shift x. A point a of the body goes
// to o + R(w) (a - o) + x, where R turns by |w| about w.
struct UnknownPose {
  int first = -1;  // -1: the ground, which does not move
  Vec3 origin{0};
};

// A point of the model in terms of the unknowns: of a body, on a curve, or with coordinates of its own.
struct UnknownPoint {
  Vec3 at{0};                                  // in the start position of its body; where coordinates are no unknowns
  std::array<int, 3> coordinates{-1, -1, -1};  // numbers of unknowns
  UnknownPose pose;
  CurvePtr curve;
  int parameter = -1;  // number of the unknown t on the curve
  // Whether it stays in its plane z = const.
  bool is_plane() const { return coordinates[2] < 0 && pose.first < 0 && !curve; }
};

// A frame that is fixed in a body: a point, a unit normal (an axis, the normal of a plane), a unit direction across it.
struct Marker {
  UnknownPoint point;
  Vec3 normal{0, 0, 1};
  Vec3 direction{1, 0, 0};
};

Vec3 place_of(const UnknownPoint& point, std::span<const double> unknowns);
Affine map_of(const UnknownPose& pose, std::span<const double> unknowns);

// Distances and directions of these are those of the start where a sign or a branch is to be chosen.
using Start = std::span<const double>;

Constraint coincidence(std::string name, const UnknownPoint& a, const UnknownPoint& b);  // 3, in a plane 2
Constraint fixation(std::string name, const UnknownPoint& a, Start start);               // at its start
Constraint fixation(std::string name, const UnknownPose& pose);                          // 6
Constraint distance_between(std::string name, const UnknownPoint& a, const UnknownPoint& b, double d);  // d > 0
// Along x, y or z (0, 1, 2), with the sign of the start.
Constraint coordinate_distance(std::string name, const UnknownPoint& a, const UnknownPoint& b, int axis, double d,
                               Start start);
// Of the way from b to a towards that from b to c, in (0, pi).
Constraint angle_between(std::string name, const UnknownPoint& a, const UnknownPoint& b, const UnknownPoint& c,
                         double angle);
using Segment2 = std::array<UnknownPoint, 2>;
Constraint parallel(std::string name, const Segment2& a, const Segment2& b, Start start);  // 2, of level segments 1
Constraint perpendicular(std::string name, const Segment2& a, const Segment2& b, Start start);
Constraint equal_lengths(std::string name, const Segment2& a, const Segment2& b);

// Between markers (Golovanov 2016, 7.3, with the moved point of the plane and two equations for a point on an axis).
Constraint point_to_plane(std::string name, const Marker& point, const Marker& plane, double d);  // signed
Constraint point_on_axis(std::string name, const Marker& point, const Marker& axis);              // 2
Constraint axis_along_plane(std::string name, const Marker& axis, const Marker& plane);
Constraint plane_angle(std::string name, const Marker& a, const Marker& b, double angle);  // of normals, in (0, pi)
Constraint parallel_planes(std::string name, const Marker& a, const Marker& b);            // 2: of normals or axes
// The first one's direction in the plane of the second one's normal and direction: no turn about the normal.
Constraint aligned(std::string name, const Marker& a, const Marker& b);

// left - right = 0, or >= 0, of formulas whose variables are these unknowns, in the order of bind(); `used` are those
// that occur.
Constraint formula_constraint(std::string name, const Expression& difference, std::vector<int> variables,
                              std::vector<int> used, bool is_inequality);

}  // namespace lekalo::geometry
