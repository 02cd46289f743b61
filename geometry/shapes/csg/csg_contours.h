// Edges, outlines, sections and parameter lines of solids that are put together (shapes/csg.h), through their leaves
// (csg_leaves.h): lines of the leaves and those in which two leaves meet, as far as they lie on the boundary of the
// whole.
//
// A line changes between lying on the boundary and not only where it meets another leaf. In between the solid is asked
// about one place of it (csg_boundary.h).
#pragma once

#include <set>
#include <string>
#include <vector>

#include "geometry/contour.h"
#include "geometry/queries/contours/parameter_lines.h"
#include "geometry/shapes/csg/csg.h"

namespace lekalo::geometry {

struct CsgLine {
  enum class Kind { sharp, smooth, silhouette, section, parameter };
  CurvePtr curve;  // a whole edge or contour, or a part of one
  Kind kind = Kind::sharp;
  struct SupportingSurface {
    SurfacePtr surface;
    Curve2Ptr image;
  };
  std::vector<SupportingSurface>
      supporting_surfaces;  // the surfaces of the leaves on which it lies, as far as these have any
  // Of silhouettes where the picture has a cusp, of other lines where a leaf without surfaces turns away there.
  std::vector<double> turns;
  CurvePtr outward_offset;  // of silhouettes without supporting surfaces: a vector along which lines beside them miss
                            // the leaf
};

struct CsgLines {
  std::vector<CsgLine> lines;
  bool complete = true;            // false where a search was not
  std::set<std::string> left_out;  // lines that are not known at all, in words
  // Faces, as hits number them, that go on in one another without an edge: of leaves that have a surface in common.
  std::vector<std::set<int>> one_face;
};

// Edges first; what leaves that end flush have in common once; supporting surfaces of one leaf's face are one surface
// in all lines. `known`: the lines for another view. Edges of bodies and half-spaces are the same for all: they are
// taken from there.
CsgLines csg_lines(const Csg& solid, const ViewOf& view, const CsgLines* known = nullptr);

// Where a plane cuts the solid's boundary; `view` is that of the turns. The normal need not be a unit vector.
CsgLines csg_section(const Csg& solid, const Vec3& origin, const Vec3& normal, const ViewOf& view);

// Parameter lines of bodies' faces, of balls and of tubes, each as it has them alone; of planes and implicit surfaces
// nothing. `view` as above.
CsgLines csg_parameter_lines(const Csg& solid, const ParameterNet& net, const ViewOf& view);

}  // namespace lekalo::geometry
