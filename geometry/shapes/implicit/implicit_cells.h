// The region of an implicit surface F = 0, cut into cells, for lines.
//
// Each cell that may hold a zero has a model: F's Taylor polynomial T of the third order about its middle, in the
// cell's own coordinates u (-1 to 1 along each axis). With bounds on the fourth derivatives over the cell, for all
// directions v, w of the cube [-1, 1]^3
//
//   error >= |D^4 F [w, w, w, w]| / 24,   slope_error >= |D^4 F [w, w, w, v]| / 6
//
// Taylor's formula gives |F(u) - T(u)| <= error and |D(F - T)(u) [v]| <= slope_error. They come from a majorant
// (numerics/majorant.h), mostly of a larger box: in one that is smaller by r they are smaller by r^4.
//
// A line goes through the cells in order, by a grid (Amanatides, Woo 1987). In most of them a straight function that
// is near F tells that there is no zero: T with each of its terms in Chebyshev's polynomials of the coordinates, cut
// off after the first degree. In the others the model is a cubic polynomial in Bernstein form: stretches where it
// exceeds the error have no zero; where its slope exceeds its own error F is monotone, and the signs at the ends tell
// whether there is a zero. A stretch that stays open is halved, or gets a model of its own, the jet of F along the line
// in the stretch's middle, whose error shrinks with the fourth power of the length. What is left at the size of the
// rounding (lines that graze, singular points), and formulas with kinks or jumps, are searched by interval arithmetic
// along the line (Moore, Kearfott, Cloud 2009, ch. 8). Zeros are those of F's own jets of the third order along the
// line: from where the model has its zero one mostly suffices, by the same bounds.
//
// The sign at a place is the model's where that is certain and else that of the computed F, zero counted as positive:
// neighbours agree on it, and crossings alternate.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <vector>

#include "geometry/queries/implicit_curves/implicit_formula.h"
#include "geometry/queries/rays/line_intersections.h"

namespace lekalo::geometry {

class SignChanges;

class ImplicitCells {
 public:
  // Cuts the region until the models are good, or there are `most` cells; without `models` only where_zero() is wanted.
  // `outside` is true for boxes that hold nothing of the region.
  ImplicitCells(ImplicitFormula formula, const Box3& region, const std::function<bool(const Box3&)>& outside, int most,
                bool models);

  // A box around all that may be zero; empty where F certainly has one sign.
  const Box3& where_zero() const { return where_zero_; }
  // A bound on the rounding of F where it may be zero.
  double rounding() const { return rounding_; }
  int count() const { return static_cast<int>(cells_.size()); }
  size_t memory() const {
    return cells_.size() * sizeof(Cell) + nodes_.size() * sizeof(Node) + grid_.boxes.size() * sizeof(int);
  }

  // Follows the sign of F along the line from t0 to t1, both in the region. The origin of the line lies near it.
  void follow(const Line& line, double t0, double t1, SignChanges& changes) const;

 private:
  struct Cell {
    // |F(p) - (offset + slope p)| <= bend for the places p of the cell: most lines ask for no more.
    double offset = 0;
    Vec3 slope{0};
    double bend = kInfinity;
    // All but the middle in the cell's own coordinates.
    Vec3 center{0}, scale{0};  // scale: one over half the sides
    double f = 0;
    Vec3 g{0};
    std::array<double, 6> second{};  // coefficients of xx, xy, xz, yy, yz, zz
    std::array<double, 10> third{};  // of xxx, xxy, xxz, xyy, xyz, xzz, yyy, ...
    double model_rounding = 0;       // of the model's values and Bernstein coefficients
    double error = kInfinity;        // infinite: there is no model
    double slope_error = 0;
    double rounding = 0;        // of F
    double slope_rounding = 0;  // of D F [v]
  };
  struct Node {
    double cut = 0;
    int axis = -1;   // of the cut; -1: a leaf
    int child = -1;  // the part below the cut, the one above follows; of a leaf its cell, -1: no zero there
  };
  // The region in equal boxes, halved as the nodes are, and what the node that holds each of them, or is as small, has
  // there: a cell by its number, kNothing where there is no zero, or, where the node is cut further, ~node.
  struct Grid {
    Vec3 lo{0}, side{0}, per_side{0};  // per_side: one over the sides
    std::array<int, 3> count{1, 1, 1};
    std::vector<int> boxes;  // x fastest
  };
  static constexpr int kNothing = std::numeric_limits<int>::min();
  // Bounds on the fourth derivatives over a box with these half sides.
  struct FourthDerivatives {
    Vec3 half{0};
    double error = kInfinity, slope_error = kInfinity;
    bool is_sharp = false;  // those of smaller boxes are hardly better than what follows from these
  };

  FourthDerivatives enclose_fourth(const Box3& box, const Vec3& half) const;
  // False where the box certainly holds no zero.
  bool may_be_zero(const Box3& box) const;
  // The same, with a model. `fourth` holds for a box around this one; better bounds are put there.
  bool make_cell(const Box3& box, FourthDerivatives& fourth, Cell& cell) const;
  // The straight function nearest to the model, which differs from F by at most the model's error, is put there.
  // False where it tells that there is no zero.
  bool straighten(double error, const Vec3& half, Cell& cell) const;
  // Of nodes whose parts are halved up to `rounds` times along all their long axes.
  void make_grid(const Box3& region, int rounds);
  void fill_grid(int node, const std::array<int, 3>& first, const std::array<int, 3>& count);
  void follow_node(int node, const Line& line, double t0, double t1, SignChanges& changes) const;
  void follow_cell(const Cell& cell, const Line& line, double t0, double t1, SignChanges& changes) const;
  void follow_model(const Cell& cell, const Line& line, double t0, double t1, SignChanges& changes) const;
  double zero_in(const Cell& cell, const Line& line, double speed, double t0, double t1, bool rising,
                 double share) const;

  ImplicitFormula formula_;
  std::vector<Node> nodes_;
  std::vector<Cell> cells_;
  Grid grid_;
  Box3 where_zero_;
  double size_ = 0;  // of the region
  double rounding_ = 0;
};

}  // namespace lekalo::geometry
