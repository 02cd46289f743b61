// Rational cubic segments that go on with continuous tangent and curvature vector (G2) in space (Korotkij, Studenova
// 2024, problems 1 and 2).
//
// At a joint R with the unit tangent T and the curvature vector k N = K x T (K = k B) the next segment R, Q, P, R' has
//
//   Q = R + l T, l > 0;   P in the osculating plane, on the side of N;   I_0 = 3 k l^2 / (2 d), d = |T x (P - R)|.
//
// Problem 1: R' and the line of the tangent there are given: P is where that line meets the osculating plane. l is
// free; with l^2 = 2 d / (3 k), I_0 is 1, and with I_1 = 1 the segment is polynomial.
// Problem 2: both ends are given: Q is where the tangent at the first meets the osculating plane of the second, P the
// other way round; l > 0 at both, and both side tests. Where the planes are one (plane data) the lengths are free.
#pragma once

#include <optional>

#include "geometry/curves/splines/rational_cubic.h"

namespace lekalo::geometry {

// What a G2 joint hands on; `curvature` is along the binormal, 1/length.
struct G2End {
  Vec3 point{0}, tangent{0}, curvature{0};
};
// Of a curve at the beginning or the end of its domain. Throws FieldError (the field) at a singular point.
G2End g2_end(const Curve& curve, bool at_end, const std::string& field);
G2End g2_end(const RationalCubic& segment);  // at its last point

struct G2Continuation {
  Vec3 to{0};
  Vec3 line{0};                     // direction of the tangent's line there, of either sense
  std::optional<double> handle;     // l; without it that of I_0 = 1
  double end_invariant = 1;         // I_1
  std::optional<double> curvature;  // at the end, instead of I_1
  // From P to the end where the line lies in the osculating plane, and P could be anywhere on it; the curve then ends
  // in the direction of the line. Without it a third of the chord.
  std::optional<double> end_handle;
};
// Throws FieldError (field segments, naming the number) where there is none.
RationalCubic g2_continuation(const G2End& joint, const G2Continuation& wish, CubicWeights weights, int number);

// From one end to the other. `handles` are the lengths at both, for plane data alone; without them those of a
// polynomial cubic, the shortest of them. Throws FieldError (fields from, to, handles) saying which of the conditions
// fail.
RationalCubic g2_transition(const G2End& from, const G2End& to, const std::optional<std::array<double, 2>>& handles,
                            CubicWeights weights);

// The polynomial of degree five between any ends, with r' = c T and r'' = c^2 k N at both, c the length of the chord:
// always there, but without the fairness of the cubic. Throws FieldError (field to) where the ends coincide.
BezierSegment g2_quintic(const G2End& from, const G2End& to);

// Segments as one NURBS curve with knots of multiplicity two at the joints, whose points vanish from the control
// polygon: each segment is reparametrized (w_i -> m l^i w_i) and has a knot interval of its own, so that the
// homogeneous curve is C1. With r = |R Q'|/|P R|, a = w_2/w_3 on the left, b = w_1'/w_0' = 1/(1 - r (1 - a)/a) must be
// positive and the intervals are as h'/h = b r/a. Throws FieldError (field knots) where it is not.
NurbsCurveForm g2_chain_with_double_knots(std::span<const RationalCubic> segments);

}  // namespace lekalo::geometry
