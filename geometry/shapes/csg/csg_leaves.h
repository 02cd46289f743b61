// The leaves of solids that are put together of others, in the solid's coordinates: bodies, half-spaces, and what only
// lines are known to meet. Balls are as many bodies; straight tubes and rings are cylinders, balls and tori: whatever
// of their surfaces is no part of the tube lies inside of it.
#pragma once

#include <memory>
#include <vector>

#include "geometry/body.h"
#include "geometry/shapes/csg/csg.h"
#include "geometry/shapes/implicit/implicit_surface.h"
#include "geometry/shapes/tube/tube.h"
#include "geometry/surfaces/analytic/plane.h"

namespace lekalo::geometry {

struct CsgLeaf {
  // One of these: a body, the half-space behind a plane, or a shape without parametric surfaces.
  BodyPtr body;
  std::shared_ptr<const Plane> plane;
  ShapePtr shape;
  // What the shape is, in coordinates of its own that the map leads from.
  std::shared_ptr<const ImplicitSurface> implicit;
  std::shared_ptr<const Tube> tube;
  Affine map;
  int region = -1;         // of an implicit leaf: the leaf that is its region
  bool is_region = false;  // a body whose own lines are those of the implicit leaf
  std::vector<int> ends;   // of a straight piece of a tube: the balls in which it goes on, which hold its rims
  Box3 box = Box3::everything();
};

// Each once, however often it is an operand.
std::vector<CsgLeaf> csg_leaves(const Csg& solid);

// The tubes among the operands, each with the leaves that it became.
struct CsgTube {
  std::shared_ptr<const Tube> tube;
  Affine map;  // into the solid's coordinates
  std::vector<int> leaves;
};
std::vector<CsgTube> csg_tubes(const Csg& solid);

}  // namespace lekalo::geometry
