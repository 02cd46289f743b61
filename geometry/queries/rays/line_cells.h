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

#include <vector>

#include "geometry/queries/rays/bezier_patch.h"
#include "geometry/queries/rays/cell_model.h"
#include "geometry/queries/rays/line_basis.h"
#include "geometry/queries/rays/proxy_patch.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

enum class Verdict { none, one, unsure };

// Where the linear model of a cell has the root, and how far from there it may lie.
struct Guess {
  double x, y, ex, ey;
};

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

// All intersections of the line with a cell of a patch, but for some with a t certainly outside the interval.
void intersect(const PatchView& patch, const PatchCell& cell, const LineBasis& line, const Interval& t, CellHits& hits);

// The same for a rectangle of any surface. `proxy` is proxy_of(surface, box), kept by the caller; `hull` holds its
// points.
void intersect(const Surface& surface, const Rectangle& box, const CellModel& model, const ProxyPatch& proxy,
               const Box3& hull, const LineBasis& line, CellHits& hits);

// True if no line of that direction meets the cell twice.
bool meets_once(const CellModel& model, const Vec3& direction);
bool meets_once(const PatchCell& cell, const Vec3& direction);

}  // namespace lekalo::geometry
