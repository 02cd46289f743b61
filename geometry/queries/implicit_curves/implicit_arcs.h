// The curves on an implicit surface where a second equation holds (implicit_equations.h), all of them, by the certified
// search of geometry/numerics/solution_curves.h, as piecewise polynomials whose nodes solve both equations.
//
// Between two nodes that the search found the point at t solves F = level, the second equation, and lies in the plane
// across the chord through the chord's point at t; t is the length of the polygon of nodes.
//
// Where the equations lose their rank (singular points of the surface, crossings of the curves) arcs end next to the
// place and are led on to it. At nodes that are known (implicit_nodes.h) that is done some way before, where the curve
// is still told apart from others by its plane; elsewhere about 1e-5 of the region's size, where it is nearly straight.
//
// Formulas with kinks are searched branch by branch (implicit_branches.h), and what is found is cut where each ends.
#pragma once

#include <memory>
#include <vector>

#include "geometry/queries/implicit_curves/implicit_branches.h"
#include "geometry/queries/implicit_curves/implicit_equations.h"
#include "geometry/queries/implicit_curves/implicit_region.h"

namespace lekalo::geometry {

struct ImplicitArc {
  CurvePtr curve;
  bool closed = false;
  Interval regular;                                // of t: what is not next to a singular point
  std::shared_ptr<const ImplicitFormula> formula;  // the branch that holds along it
};
struct ImplicitArcs {
  std::vector<ImplicitArc> arcs;
  // False where something larger than 1e-3 of the region's size is not decided, an arc stops for no reason that was
  // found, or a curve is too crooked for polynomials.
  bool complete = true;
};

// In a box; what lies beyond the region may be left out. The formula must outlive them.
ImplicitArcs implicit_arcs(const ImplicitFormula& formula, const ImplicitRegion& region,
                           const ImplicitCondition& condition, const Box3& box);
// F = level on a plane: over a rectangle of the frame's x and y.
ImplicitArcs implicit_arcs(const ImplicitFormula& formula, const ImplicitRegion& region, const Frame& plane,
                           const Interval& x, const Interval& y);
// Of one branch, without the side of this number.
ImplicitArcs implicit_arcs(const ImplicitBranch& branch, const ImplicitRegion& region,
                           const ImplicitCondition& condition, const Box3& box, size_t but_side);

// The part of a curve over a range that lies in its domain; of a closed one it may go on beyond the end.
CurvePtr stretch(const CurvePtr& curve, const Interval& t);

}  // namespace lekalo::geometry
