// Nodes of an implicit surface, isolated singular points where it is nearly a cone, and what its silhouette is there.
//
// With p = o + t w from the node o, w on the faces of a cube, and H for the second derivatives, Taylor's formula gives
//
//   F = t^2/2 w A w,   grad F . s = t (s A' w),   A and A' means of H between o and p,
//
// two equations for the two coordinates of w. Where all matrices of H(X), X a cube about o, leave their roots isolated,
// each root is a branch of the silhouette that leads into the node, and X holds nothing else of it.
#pragma once

#include <vector>

#include "geometry/contour.h"
#include "geometry/queries/implicit_curves/implicit_formula.h"

namespace lekalo::geometry {

struct ImplicitNode {
  Vec3 point{0};
  double reach = 0;  // half a side of that cube
};

// Those in a box, of a region of that size, at which the silhouette is known so. Others are left out: where the second
// derivatives have no inverse, and where a line of sight touches the cone.
std::vector<ImplicitNode> implicit_nodes(const ImplicitFormula& formula, double size, const ViewOf& view,
                                         const Box3& box);

}  // namespace lekalo::geometry
