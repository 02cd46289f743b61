// Regions of a parameter plane bounded by closed loops of curves: which points a trimmed face keeps.
#pragma once

#include <memory>
#include <vector>

#include "geometry/body.h"
#include "geometry/curve.h"

namespace lekalo::geometry {

// The region that every line through it enters and leaves by turns at the loops (the outer ones and holes in any
// sense). Boundary points count as inside. Robust at vertices and tangencies: parity is counted on y-monotone arcs with
// half-open ends; an arc is decided by its box and halved until sure. A quadtree over the arcs knows for each of its
// cells the parity from what lies to the right of it, so that a point asks only the few arcs of its own cell.
class TrimRegion {
 public:
  // Each loop is a closed chain of parameter curves; `forward` tells which way the loop runs along each.
  struct Part {
    Curve2Ptr curve;
    bool forward;
  };
  // In a periodic direction points and loops may be whole periods apart.
  explicit TrimRegion(const std::vector<std::vector<Part>>& loops, const Periods& periods = {});

  // True for points inside or within `tolerance` (a distance in the parameter plane) of the border.
  bool contains(double u, double v, double tolerance = 0) const;
  Interval u_range() const { return u_; }
  Interval v_range() const { return v_; }

  // What of a rectangle is in the region, for certain; `mixed` where nothing is.
  enum class Coverage { outside, inside, mixed };
  Coverage coverage(const Rectangle& rectangle) const;

 private:
  // Monotone in y: control points of a rational Bezier arc (z unused), or a part of a curve without such a form.
  struct Arc {
    std::vector<Vec4> points;
    Curve2Ptr curve;
    Interval t{0, 1};
    double x_lo = kInfinity, x_hi = -kInfinity, y_lo = kInfinity, y_hi = -kInfinity;
    // Of its ends, where `forward` in the order of the loop. The end of each arc is exactly the begin of the next.
    double y_begin = 0, y_end = 0;
  };
  struct Cell {
    int children = -1;  // the first of four: lower left, lower right, upper left, upper right
    bool odd = false;   // parity of the crossings to the right that all its points share
    int first_arc = 0, arc_count = 0;
    int first_turn = 0, turn_count = 0;  // heights above which that parity changes
  };
  class Building;

  bool holds(double u, double v) const;
  bool holds_or_touches(double u, double v, double tolerance) const {
    return holds(u, v) || (tolerance > 0 && near_border(u, v, tolerance));
  }
  bool near_border(double u, double v, double tolerance) const;
  static bool is_right_of(const Arc& arc, double u, double v);
  // Calls visit(arc) for the arcs of all cells that meet the rectangle until it returns true, and returns that. An arc
  // may come more than once.
  template <class Visit>
  bool any_arc(const Rectangle& rectangle, Visit&& visit) const;
  Coverage coverage_unshifted(const Rectangle& rectangle) const;
  // Calls visit(shift) for the whole periods by which the range comes to the loops, until it returns true.
  template <class Visit>
  bool any_shift(const Rectangle& rectangle, Visit&& visit) const;

  std::vector<Arc> arcs_;
  std::vector<Cell> cells_;  // the root is the first
  std::vector<int> cell_arcs_;
  std::vector<double> turns_;  // of each cell, increasing
  Interval u_, v_;
  Periods periods_;
};

// The trim of one face of a body, or null where the face fills its surface's domain.
std::shared_ptr<const TrimRegion> trim_of(const Body& body, int face);

}  // namespace lekalo::geometry
