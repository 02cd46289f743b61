// Where curves may pass through surfaces: no passage is lost, a few places may be none.
//
// Both are cut into cells: chords of a curve and four corners of a surface, with how far the true thing is from these
// at most: with f the component along a direction, by -f'' h^2 / 8 for some f'' of the cell. Two cells are apart if one
// of a few directions parts them; they meet once if no Jacobian of r(t) - s(u, v) between the bounds of its columns is
// singular, and then Newton's iteration finds the place. A curve that ends on the surface's border and leaves it there,
// perhaps along its tangent plane (as lines of the next patch do), meets it nowhere else near that end
// (leaving_border.h). Cells are made when they are first asked for and kept: a picture asks for many curves against the
// same surface. That is some hundred times faster than intersect() (curve_intersections.h), which isolates all
// intersections with their kinds.
#pragma once

#include <deque>
#include <vector>

#include "geometry/curve.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// A box of vectors by its middle.
struct VectorRange {
  Vec3 middle{0}, half{kInfinity};
  double largest = kInfinity;  // length
};

class CurveCells {
 public:
  // Without the ends, which are `end_share` of the domain long: there a curve may touch a surface that begins at it.
  // The curve must stay.
  explicit CurveCells(const Curve& curve, double end_share = 1e-6);

  struct Cell {
    Interval t;
    Vec3 begin{0}, end{0};
    VectorRange first, second;  // r', r''
    double rounding = 0;        // of the points
    double bulge = 0;           // of the distance from the chord
    Box3 box;
    int depth = 0;
    int children = -1;  // the first of two
  };
  const Curve& curve() const { return curve_; }
  int roots() const { return roots_; }
  const Cell& cell(int index) const { return cells_[index]; }
  int children(int index);  // of the cell: this and the next

  // One of the curve's own ends, which no cell holds.
  struct End {
    double way;  // 1: the curve begins there; -1: it ends there
    Vec3 point;
    double left_out;  // so much of the domain is no cell's
  };
  // That next to a cell, if there is one. `second` of the cell bounds |r''| up to it.
  const End* end_at(const Cell& cell) const;

 private:
  // Bounds are found anew, or are those of the cell above.
  Cell make(const Interval& t, const Vec3& begin, const Vec3& end, const Cell* above) const;
  const Curve& curve_;
  Interval inner_;
  End ends_[2];
  int roots_ = 0;
  std::deque<Cell> cells_;  // references stay
};

class SurfaceCells {
 public:
  // Of a bounded surface, which must stay.
  explicit SurfaceCells(const Surface& surface);

  struct Cell {
    Rectangle domain;
    Vec3 corners[4];                                                // at (lo, lo), (hi, lo), (lo, hi), (hi, hi)
    VectorRange first_u, first_v, second_uu, second_uv, second_vv;  // derivatives
    double rounding = 0;                                            // of the corners
    double bulge = 0;                                               // of the distance from the corners' bilinear patch
    Box3 box;
    int depth = 0;
    int children = -1;
  };
  const Surface& surface() const { return surface_; }
  int roots() const { return roots_; }
  const Cell& cell(int index) const { return cells_[index]; }
  int children(int index);
  // Whether a point of the surface is found this near.
  bool holds(const Vec3& point, double tolerance);

 private:
  bool is_foot_near(const Cell& cell, const Vec3& point, double tolerance) const;
  void complete(Cell& cell) const;
  const Surface& surface_;
  int roots_ = 0;
  std::deque<Cell> cells_;  // references stay
};

// Adds the parameters of the curve where it may pass through the surface to `places`. Where it is nearer to the surface
// than `touch`, a length, along a stretch, it touches it: the stretch's ends are places. False if there are more
// than `max_touches` of them or `max_pairs` pairs of cells: the curve runs along the surface, or nearly; `places` is
// then as before.
bool add_crossing_candidates(CurveCells& curve, SurfaceCells& surface, double touch, int max_touches, int max_pairs,
                             std::vector<double>& places);

}  // namespace lekalo::geometry
