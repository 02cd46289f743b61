// All intersections of a line with a rational Bezier patch, in the plane across the line.
//
// With n1, n2 the unit vectors across the line and o its origin, the homogeneous functions
//
//   f(s, t) = n1 . (X - w o),  g(s, t) = n2 . (X - w o),  X, w the patch's numerators and denominator,
//
// are polynomials in Bernstein form whose common zeros are the intersections: two numbers a control point, whatever the
// weights. A cell x, y in [-1, 1] of parameters is treated by F = J^-1 (f, g), J the derivatives at its centre, for
// which the differences of the coefficients bound E = dF/d(x, y) - I over the cell:
//
//   - no coefficient of f, or of g, changes sign: no root (convex hull). The same of the combination of both that does
//   not change along the longer column of J, which is what sets a line beside an outline apart;
//   - a root lies within -F(0) +- |E|(1, 1): the cell is clipped to that (mean value theorem), and without overlap
//   there
//     is no root;
//   - the rows of |E| sum to at most 1/4: there is at most one root, and Newton's iteration projected to the cell
//     converges to it, or to a point of the border, and then there is none (contraction);
//   - otherwise the cell is halved.
//
// The bounds hold for the line as it lies: what curvature does along the line does not count. Cells smaller than
// kSmallestCell are singular points of the surface, reported once, or tangencies, reported not at all.
#pragma once

#include "geometry/queries/rays/bezier_patch.h"
#include "geometry/queries/rays/line_cells.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

// A surface that a patch stands for, over the same x, y.
class NearSurface {
 public:
  virtual ~NearSurface() = default;
  double off = 0, off_x = 0, off_y = 0, rounding = 0;  // as of ProxyPatch
  // How far outside of the border a root still counts, in x, in y and as a length.
  double slack_x = kBorderSlack, slack_y = kBorderSlack, slack = 0;
  // Its own point and derivatives by x and y.
  virtual PatchPoint at(double x, double y) const = 0;
  // Takes a cell, [x - hx, x + hx] times [y - hy, y + hy], in which the bounds are too wide to tell.
  virtual void undecided(double x, double y, double hx, double hy) = 0;
};

// Adds the roots in a cell of the patch, in the cell's coordinates. `reach_x`, `reach_y` bound its extent in space
// along x and y from its centre.
void search_net(const PatchView& patch, const CellPlace& place, double reach_x, double reach_y, const LineBasis& line,
                CellHits& hits);

// The same for the surface near to the patch: cells are treated with the bounds added, and Newton's iteration runs on
// the surface itself.
void search_net(const PatchView& patch, NearSurface& near, const LineBasis& line, CellHits& hits);

}  // namespace lekalo::geometry
