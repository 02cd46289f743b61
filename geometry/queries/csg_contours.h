// Edges and outlines of solids that are put together (shapes/csg.h), through their leaves: edges and silhouettes of the
// leaves and the lines where two leaves meet, as far as they lie on the boundary of the whole.
//
// A line changes between lying on the boundary and not only where it meets another leaf. In between the solid is asked
// at four places around a point of the line, p +- e n_1 +- e n_2 with the normals of the surfaces that meet there: it
// is an edge unless one of the two normals alone tells inside from outside, or none does.
#pragma once

#include <string>
#include <vector>

#include "geometry/queries/contours.h"
#include "geometry/shapes/csg.h"

namespace lekalo::geometry {

struct CsgLine {
  CurvePtr curve;    // a whole edge or contour, or a part of one
  bool edge = true;  // else a silhouette
  struct Host {
    SurfacePtr surface;
    Curve2Ptr image;
  };
  std::vector<Host> hosts;    // the surfaces of the leaves on which it lies
  std::vector<double> cusps;  // of silhouettes
};

struct CsgLines {
  std::vector<CsgLine> lines;
  bool complete = true;  // false with leaves that are no bodies (tubes, implicit surfaces), or where a search was not
};

// Edges first; hosts of one leaf's face are one surface in all lines.
CsgLines csg_lines(const Csg& solid, const ViewOf& view);

// Where a plane cuts the solid's boundary. The normal need not be a unit vector.
CsgLines csg_section(const Csg& solid, const Vec3& origin, const Vec3& normal);

}  // namespace lekalo::geometry
