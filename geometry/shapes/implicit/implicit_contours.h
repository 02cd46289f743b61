// Lines of an implicit surface F = level in its region: silhouettes (Golovanov 2016, 4.6), the border at which the
// region cuts it off or closes it, the creases of a formula with kinks, sections by planes.
//
// A point of the surface is on its silhouette if the line of sight s touches it there, grad F . s = 0. With the second
// derivatives H of F the picture has a cusp where s . H s = 0, and beside the contour the line of sight passes on the
// side on which F has the sign of s . H s.
#pragma once

#include <vector>

#include "geometry/contour.h"
#include "geometry/queries/contours/plane_section.h"
#include "geometry/queries/contours/silhouette.h"
#include "geometry/shapes/implicit/implicit_surface.h"

namespace lekalo::geometry {

struct ImplicitContour {
  CurvePtr curve;  // to 1e-13 of the region's size (1e-9 where the formula's rounding leaves no more)
  bool closed = false;
  // By t. Of silhouettes: where the curve runs along the line of sight, so that its picture has a cusp. Of other lines:
  // where the surface, or the ball that is its region, turns away from the viewer.
  std::vector<double> turns;
  // Of silhouettes: a vector, by the same parameter, along which lines beside the curve miss the surface there. It
  // changes sides at cusps.
  CurvePtr outward_offset;
};

struct ImplicitContours {
  std::vector<ImplicitContour> lines;
  // False where something may be missing: the formula has jumps, or too many branches (expression/branches.h), the
  // surface meets itself along a curve, the
  // contour is no curve (a cone seen from its tip), or where its equations are nearly singular over more than 1e-3 of
  // the region's size. Lines through isolated singular points lead up to these.
  bool complete = true;
};

// All of these throw std::invalid_argument for a direction or normal of no length, or what is not finite.

// Of the surface, and of the ball as far as it bounds a closed solid. None of a surface that is seen edge-on all over,
// such as a cylinder along its axis.
ImplicitContours silhouette(const ImplicitSurface& surface, const ViewOf& view);
// Where the surface ends at the border of its region; of a closed solid the edges there, and the edges of the box as
// far as they bound the solid. `view` is that of the turns.
ImplicitContours border(const ImplicitSurface& surface, const ViewOf& view);
// Where branches of the formula meet and the normals of both sides differ by kSmoothEdge somewhere.
ImplicitContours creases(const ImplicitSurface& surface, const ViewOf& view);
// Of a closed solid with the lines in which the plane meets the region's border.
ImplicitContours plane_section(const ImplicitSurface& surface, const Vec3& origin, const Vec3& normal,
                               const ViewOf& view);

}  // namespace lekalo::geometry
