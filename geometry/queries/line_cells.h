// The certified solver of a line against one smooth piece of a surface.
//
// A cell is a rectangle of a piece's local parameters, mapped to x, y in [-1, 1]. With S the surface over the cell, S0,
// Sx, Sy its value and derivatives at the centre, and a bound r on how far the derivatives stray from Sx, Sy anywhere
// in the cell, the two plane equations of the line, f(x, y) = (n1, n2) . (S(x, y) - o), obey
//
//   f(x, y) = f0 + (J + E)(x, y),  |E_k| <= r:
//
//   - a root can only lie within  -J^-1 f0 +- |J^-1| r: if that misses the cell there is none (mean value theorem);
//   - E is bounded in the cell's own directions: its parts along dx and dy move a root by so much of the cell whatever
//     the line; the part along the normal, which is what curvature makes, counts only as far as the line sees it, not
//     at all for a line along the normal;
//   - if |J^-1| r <= 1/4 there is at most one, and Newton's iteration projected to the cell converges to it, or to a
//     point of the border with f != 0, and then there is none (contraction);
//   - otherwise the cell is halved (patches: in the plane across the line, line_net.h). Cells of parts of surfaces that
//     a hull test excludes are dropped first.
//
// A cell smaller than kSmallestCell that is still undecided is a singular point of the surface (a pole), reported once,
// or a tangency of the line, reported not at all: a tangent line has two hits or none.
#pragma once

#include <array>
#include <vector>

#include "geometry/queries/bezier_patch.h"
#include "geometry/queries/line_basis.h"
#include "geometry/queries/proxy_patch.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// First-order model of a cell.
struct CellModel {
  Vec3 point{0};
  Vec3 dx{0};
  Vec3 dy{0};
  Vec3 normal{0};  // unit, across dx and dy; zero where they are parallel
  // Bounds over the cell on |S_x - dx| + |S_y - dy|, both taken apart as (shift_x dx + shift_y dy + bend normal):
  // shares of dx and of dy, and a length. Infinite where dx and dy are parallel.
  double shift_x = 0;
  double shift_y = 0;
  double bend = 0;
  double variation_x = 0;  // bounds on the lengths of the differences
  double variation_y = 0;
  // Bounds on the extent in space along x, and along y, from the centre.
  double reach_x() const { return glm::length(dx) + variation_x; }
  double reach_y() const { return glm::length(dy) + variation_y; }
};

// The model of a rational Bezier patch over its whole square, x = 2 s - 1, y = 2 t - 1. All bounds are infinite where a
// weight is not positive.
CellModel model_of(const PatchView& patch);

// A root in local coordinates x, y in [-1, 1] of the cell that was asked.
struct CellHit {
  double t, x, y;
};

// Roots found in one cell: the usual few without allocation.
class CellHits {
 public:
  void add(const CellHit& hit) {
    if (count_ < kInline)
      few_[count_] = hit;
    else
      more_.push_back(hit);
    ++count_;
  }
  int size() const { return count_; }
  CellHit& operator[](int i) { return i < kInline ? few_[i] : more_[i - kInline]; }
  const CellHit& operator[](int i) const { return i < kInline ? few_[i] : more_[i - kInline]; }

 private:
  static constexpr int kInline = 8;
  CellHit few_[kInline];  // not initialised: one of these is made for each candidate of each ray
  int count_ = 0;
  std::vector<CellHit> more_;
};

// A cell's place in the square of a patch: [x - hx, x + hx] times [y - hy, y + hy].
struct CellPlace {
  double x = 0, y = 0, hx = 1, hy = 1;
};

// A cell of a rational Bezier patch for many lines, small because every line that comes near reads it: in floats whose
// rounding is part of the bounds. Its frame measures a vector in shares of dx and dy and by its part along the normal.
struct PatchCell {
  using Four = std::array<float, 4>;
  std::array<Four, 3> frame;  // columns: the parts of (1, 0, 0), (0, 1, 0), (0, 0, 1); fourth, the middle's x, y, z
  Four lo, hi;                // box of the cell in its frame, about the middle; fourth, shift_x and shift_y
  float bend;
  float reach_x, reach_y;  // bounds on the extent in space along x and y from the middle
  float x, y, hx, hy;      // its place, exactly

  // `part`: the patch restricted to the place; `model`: of the part.
  PatchCell(const PatchView& part, const CellModel& model, const CellPlace& place);
  CellPlace place() const { return {x, y, hx, hy}; }
};

// All meetings of the line with a cell of a patch, but for some with a t certainly outside the interval.
void intersect(const PatchView& patch, const PatchCell& cell, const LineBasis& line, const Interval& t, CellHits& hits);

// The same for a rectangle of any surface, from evaluate and enclose.
CellModel model_of(const Surface& surface, const Rectangle& box);
// `proxy` is proxy_of(surface, box), kept by the caller.
void intersect(const Surface& surface, const Rectangle& box, const CellModel& model, const ProxyPatch& proxy,
               const LineBasis& line, CellHits& hits);

// True if no line of that direction meets the cell twice.
bool meets_once(const CellModel& model, const Vec3& direction);
bool meets_once(const PatchCell& cell, const Vec3& direction);

// How far from the linear guess a root may lie, as a share of the cell, for a line at 45 degrees to it; lines that do
// not graze a cell of roughness below 1/4 are decided without halving.
double roughness(const CellModel& model);

// Cells up to this roughness are not cut further when a target is built: few enough to be found quickly, flat enough
// that most lines are decided without halving.
inline constexpr double kFlat = 0.2;

// The cut that flattens more, judged by the second differences of the control points: across the direction in which the
// patch bends more, or, where twist is most of it, across the longer of the cell's extents x and y.
bool flattens_across_u(const PatchView& patch, double x, double y);

}  // namespace lekalo::geometry
