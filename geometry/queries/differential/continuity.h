// How smoothly curves and surfaces join: the jump of each geometric order across a joint, G0 to G3 (Golovanov
// 2016, 2.1, 3.1; geometric continuity as in Farin, Curves and Surfaces for CAGD, chapters 11 and 21).
//
// Of curves: gap, angle of the tangents, difference of the curvature vectors r_ss and of their derivatives r_sss by arc
// length. Of surfaces along a common edge, in the frame (T, D, N) of the edge's tangent and the direction across it:
// gap, angle of the normals, difference of the normal curvatures across, h_DD, and of their derivatives, h_DDD, h being
// the height over the tangent plane. Where the surfaces share the edge and the orders below agree along it, these are
// the only terms in which they can differ.
#pragma once

#include <array>
#include <vector>

#include "geometry/body.h"
#include "geometry/curves/operations/parameter_line.h"

namespace lekalo::geometry {

// What passes of each order. The gap is a part of the size of both; angles are in radians; curvature and its derivative
// are parts of the larger of both, or of 1/size and 1/size^2 where these are larger.
struct ContinuityTolerances {
  std::array<double, 4> of_order{1e-6, 1e-6, 1e-6, 1e-6};
};

// The largest difference of one order and where it is.
struct ContinuityJump {
  double largest = 0;   // length, radians, 1/length, 1/length^2
  double relative = 0;  // as the tolerances ask for it
  double t = 0;         // parameter of the edge; of curves that of the first one's end
  Vec3 point{0};        // on the first
};

struct Continuity {
  std::array<ContinuityJump, 4> jumps;
  int order = -1;  // the highest G order that holds with all below; -1 for a gap
};

// At the ends that are nearest to each other: `a_end`, `b_end` tell which, the last (true) or the first.
struct CurveJoint {
  bool a_end = true, b_end = false;
  Continuity continuity;
};
// Throws std::invalid_argument for a closed curve, which has no ends, or a cusp at a joint.
CurveJoint joint(const Curve& a, const Curve& b, const ContinuityTolerances& tolerances = {});

// Where smooth pieces of one curve follow one another, in the order of the parameter; of a closed curve also where it
// closes, first. Throws std::invalid_argument for an unbounded curve, or a cusp at a joint.
struct CurveOwnJoint {
  double t = 0;
  Continuity continuity;
};
std::vector<CurveOwnJoint> joints(const Curve& curve, const ContinuityTolerances& tolerances = {});

// A part of an edge of a surface's domain.
struct DomainEdge {
  IsoDirection held = IsoDirection::u;
  double at = 0;
  Interval range;  // of the other parameter
};
struct SurfaceJoint {
  DomainEdge a, b;
  Continuity continuity;  // t along the first one's edge
};
// Edges of the domains, or parts of them, that are nowhere farther from each other than `gap` times the size of both.
// None for surfaces that only touch or cross. The largest jumps are those of 65 places along the edge, made larger by
// searching beside them. Throws std::invalid_argument for unbounded surfaces.
std::vector<SurfaceJoint> joints(const Surface& a, const Surface& b, const ContinuityTolerances& tolerances = {},
                                 double gap = 1e-4);

// Across an edge with two uses, poles excepted; throws std::invalid_argument for others.
Continuity continuity(const Body& body, int edge, const ContinuityTolerances& tolerances = {});

}  // namespace lekalo::geometry
