// Interpolating splines of any degree (Golovanov 2016, 2.3, 2.14; Zavyalov et al. 1985, I.6, I.8).
#pragma once

#include <optional>

#include "geometry/curves/splines/nurbs_curve.h"

namespace lekalo::geometry {

// What holds at an end of an open spline where less is given than its degree p leaves free (p / 2 conditions):
//   natural      r^(p-k) = 0 where r^(k) is not given, k = 1 .. (p - 1) / 2; of odd degrees. Cubic: r'' = 0
//   parabolic    r''' = 0: the end span is a parabola; cubic only
//   not_a_knot   the points next to the end are no knots
enum class EndRule { natural, parabolic, not_a_knot };

struct SplineEnd {
  EndRule rule = EndRule::not_a_knot;
  std::optional<Vec3> tangent;  // dr/dt
  std::optional<Vec3> second;   // d2r/dt2
};

struct PointTangent {
  int point = 0;
  Vec3 tangent{0};  // dr/dt
};

// Throws FieldError unless tangents belong to points 0 .. points - 1, one for each at most.
void check_tangents(std::span<const PointTangent> tangents, int points, const std::string& field = "tangents");
// A field of such tangents, and what it holds: nothing where it was left out.
FieldType point_tangents();
std::vector<PointTangent> point_tangents(const Fields& f, std::string_view field);

// The spline of class C^(degree - 1) through points at increasing parameters. Knots are the inner parameters (odd
// degree) or their midpoints (even); at a point with a tangent two knots a third of the spans beside it.
// Throws FieldError (fields degree, ends, tangents, points).
NurbsCurve spline_curve(std::span<const Vec3> points, std::span<const double> parameters, int degree,
                        const SplineEnd& start, const SplineEnd& end, std::span<const PointTangent> tangents = {});

// The same, periodic; `parameters` has one more entry, the end of the period.
NurbsCurve closed_spline_curve(std::span<const Vec3> points, std::span<const double> parameters, int degree,
                               std::span<const PointTangent> tangents = {});

}  // namespace lekalo::geometry
