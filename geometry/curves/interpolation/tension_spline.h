// Interpolating splines between the cubic and the polyline (Zavyalov et al. 1985, I.6; Spath 1969).
#pragma once

#include <optional>

#include "geometry/curves/interpolation/tangent_estimates.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

// Tangents at the ends of an open curve (dr/dt); an end without is natural, r'' = 0. A closed curve has none.
struct TensionEnds {
  std::optional<Vec3> start, end;
};

// Of a span of length 1: what r'' at an end adds to r' there, and takes from it at the other. Of a cubic 1/3 and 1/6.
struct SpanFlexibility {
  double near = 1.0 / 3, far = 1.0 / 6;
};

// r'' at the points with which r' is continuous, of a spline with these spans.
std::vector<Vec3> second_derivatives(const PointSequence& data, std::span<const SpanFlexibility> spans,
                                     const TensionEnds& ends);

// What the types of such splines have in common: points, knots, closed, tension, and tangents at the ends.
void declare_tension(TypeDeclaration& type);
struct TensionData {
  std::vector<Vec3> points;
  std::vector<double> parameters, tensions;  // a tension for each span
  TensionEnds ends;
  bool closed = false;
  PointSequence sequence() const { return {points, parameters, closed}; }
};
TensionData read_tension(const Fields& f);

// The rational C2 spline through points with a tension >= 0 for each span: all 0 the cubic spline, large ones near to
// the sides of the polygon. Ends without a tangent (dr/dt) are natural, r'' = 0; a closed curve has none. Throws
// FieldError (field tension).
NurbsCurve tension_spline(const PointSequence& data, std::span<const double> tensions,
                          const std::optional<Vec3>& start_tangent = {}, const std::optional<Vec3>& end_tangent = {});

// Tensions, at least those given, with which each coordinate is convex over spans where its data are (second
// differences of one sign at both ends) and monotone where a span and those beside it, or the given tangent, are.
std::vector<double> shape_keeping_tensions(const PointSequence& data, std::vector<double> tensions,
                                           const std::optional<Vec3>& start_tangent = {},
                                           const std::optional<Vec3>& end_tangent = {});

}  // namespace lekalo::geometry
