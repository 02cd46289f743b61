// Every tolerance of the program, each with its reason. All are relative: lengths to the size of the operands (the
// diameter of their box), parameters to the width of the domain.
#pragma once

namespace lekalo::geometry {

// Solvers: a root this far outside a piece in its local parameter still belongs to it, so that a line through a shared
// border is found by at least one neighbour whatever the rounding; it is clamped to the border.
inline constexpr double kBorderSlack = 1e-11;

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

}  // namespace lekalo::geometry
