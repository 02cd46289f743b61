// The curves on an implicit surface where a second equation holds (implicit_equations.h), all of them, by the certified
// search of geometry/numerics/solution_curves.h, as piecewise polynomials whose nodes solve both equations.
//
// Between two nodes that the search found the point at t solves F = level, the second equation, and lies in the plane
// across the chord through the chord's point at t; t is the length of the polygon of nodes.
//
// Where the equations lose their rank (singular points of the surface, crossings of the curves) arcs end next to the
// place. They are led on to it, straight on: that is as far as 1e-6 of the region's size, on which they bend by the
// square of that.
#pragma once

#include <memory>
#include <vector>

#include "geometry/curves/polynomial_curve.h"
#include "geometry/queries/implicit_equations.h"
#include "geometry/shapes/implicit_surface.h"

namespace lekalo::geometry {

struct ImplicitArc {
  std::shared_ptr<const PolynomialCurve> curve;
  bool closed = false;
  Interval regular;  // of t: the rest leads straight on to a singular point
};
struct ImplicitArcs {
  std::vector<ImplicitArc> arcs;
  // False where something larger than 1e-3 of the region's size is not decided, an arc stops for no reason that was
  // found, or a curve is too crooked for polynomials.
  bool complete = true;
};

// In a box; what lies beyond the region may be left out.
ImplicitArcs implicit_arcs(const ImplicitSurface& surface, const ImplicitCondition& condition, const Box3& box);
// F = level on a plane: over a rectangle of the frame's x and y.
ImplicitArcs implicit_arcs(const ImplicitSurface& surface, const Frame& plane, const Interval& x, const Interval& y);

}  // namespace lekalo::geometry
