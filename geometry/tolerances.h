// Every tolerance of the program, each with its reason. All are relative: lengths to the size of the operands (the
// diameter of their box), parameters to the width of the domain.
#pragma once

namespace lekalo::geometry {

// Solvers: a root this far outside a piece in its local parameter still belongs to it, so that a line through a shared
// border is found by at least one neighbour whatever the rounding; it is clamped to the border.
inline constexpr double kBorderSlack = 1e-11;

// The same for closed forms, relative to the width of a range of parameters: the hit is moved onto the border, and so
// much may lie between it and the line.
inline constexpr double kHitSlack = 5e-13;

// What rounding moves a line by, relative to the coordinates at its hit: two units of their last place. A face counts a
// hit beyond its border if the line comes that near to the border in space, however far a small angle takes the hit
// along the line, at most the reach, relative to the width of the range (planes: without a limit). Faces at a common
// edge measure the same distance, so that they agree.
inline constexpr double kShallowSlack = 4.5e-16;
inline constexpr double kShallowReach = 1e-7;

// Rounding of the place where a line meets a surface, relative to the coordinates and lengths that went into it, 64
// epsilon: surfaces of several objects that differ by less on a line lie on one another there.
inline constexpr double kHitRounding = 0x1p-46;

// Two hits of one surface or closed body closer than this, crossing in the same direction, are one crossing reported by
// two neighbours: the border slack seen from the line, with a factor for the angle.
inline constexpr double kSameHit = 1e-10;

// Parameter rectangles narrower than this part of a piece are not divided further: what is left is a tangency or a
// singular point, and the doubles of the piece's own evaluation no longer tell its sides apart.
inline constexpr double kSmallestCell = 1e-12;

// Points this near the border of a trim count as inside, so that a line through an edge meets at least one of the two
// faces; merging by kSameHit makes it one. Relative to the parameter range of the loops.
inline constexpr double kTrimSlack = 1e-11;

// Edge curves and their images on the faces agree to this (of the body's size) in a body that we made.
inline constexpr double kEdgeTolerance = 1e-12;

// A curve whose end points agree to this is closed: what is left after chains of operations, and far below what can be
// seen or what a modeller calls a gap.
inline constexpr double kClosedCurve = 1e-9;

// An edge of a control net whose points agree to this shrinks to one point: rounding of coordinates given in decimals
// and moved by a few transformations.
inline constexpr double kCollapsedEdge = 1e-12;

// Knots closer than this part of their range are meant to be equal.
inline constexpr double kSameKnot = 1e-10;

// The knots of a closed spline repeat to this part of the period (then they are made to repeat exactly).
inline constexpr double kKnotPeriod = 1e-9;

// A domain that exceeds another by this part of its width agrees with it: multiples of pi written in decimals. Parts of
// spans narrower than this are not worth a piece of their own.
inline constexpr double kDomainSlack = 1e-12;

// Normals by their limit: at the distance delta (of the domain) from a singular point r_u x r_v loses eps/delta of its
// direction and the limit is off by delta; they are equal here.
inline constexpr double kNormalLimit = 1e-8;

// Taylor coefficients of r_u x r_v below this part of their largest possible terms are rounding errors.
inline constexpr double kNormalNoise = 1e-15;

// Points nearer than this part of the operands' size are one, where nothing else is asked for: what is left of decimals
// in a file after a few operations.
inline constexpr double kSamePoint = 1e-9;

}  // namespace lekalo::geometry
