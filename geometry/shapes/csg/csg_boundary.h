// What the boundary of a solid is about a point of a line on it. Along the four sides of a small square about the
// point, across the line, the solid is crossed once on each side where the boundary is smooth, with normals that agree
// but for its bending; at a sharp edge the normals differ; nothing is crossed off the boundary.
//
// Two faces that go on smoothly in one another differ in how they bend across the line: heights over the tangent at the
// distances h and 2h on both sides give the second derivatives.
#pragma once

#include <set>
#include <vector>

#include "geometry/shapes/csg/csg.h"

namespace lekalo::geometry {

enum class CsgBoundary { none, face, smooth_edge, sharp_edge };

struct CsgBoundaryQuestion {
  Vec3 point{0};
  Vec3 tangent{0};        // of the line; of any length but zero
  double reach = 1;       // the length along which lines and surfaces about the point hardly bend, or less
  double sine = 1;        // of the angle at which the line's surfaces meet; 1 where it is not known
  bool touching = false;  // surfaces touch along the line: as far as they are one crossing, the square is larger
  bool smooth = false;    // whether faces and smooth edges need to be told apart
};

struct CsgPlace {
  CsgBoundary boundary = CsgBoundary::none;
  std::set<int> faces;        // that the solid has about the point, as its hits number them
  std::vector<Vec3> normals;  // of the boundary where the square crosses it
};

// `size`: the diameter of the solid's box.
CsgPlace boundary_at(const Csg& solid, double size, const CsgBoundaryQuestion& question);

}  // namespace lekalo::geometry
