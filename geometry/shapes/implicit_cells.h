// The region of an implicit surface F = 0, cut into cells, for lines.
//
// Cells whose enclosure of F by interval arithmetic excludes zero are dropped. Each of the others has a model, the
// Taylor polynomial of the second order about its middle c, with bounds on what it leaves out:
//
//   |F(c + q) - (f + g q + q H q / 2)| <= error,   |dF/dx_i - (g + H q)_i| <= slope_error_i
//
// They come from enclosures of the second derivatives over the cell (jets of intervals), and hold the rounding. A line
// goes through the cells in order. In each the model is a quadratic polynomial in Bernstein form: stretches where it
// exceeds the error have no zero; where its slope exceeds its own error F is monotone, and the signs at the ends tell
// whether there is a zero, which Newton's iteration on F itself finds. A stretch that stays open gets a model of its
// own, F and its slope in the stretch's middle with the cell's second derivatives, whose error shrinks with the square
// of the length. What is left at the size of the rounding (lines that graze, singular points), and formulas with kinks
// or jumps, are searched by interval arithmetic along the line (Moore, Kearfott, Cloud 2009, ch. 8).
//
// The sign at a place is the model's where that is certain and else that of the computed F, zero counted as positive:
// neighbours agree on it, and crossings alternate.
#pragma once

#include <functional>
#include <vector>

#include "geometry/queries/line_intersections.h"
#include "geometry/shapes/implicit_formula.h"

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
  size_t memory() const { return cells_.size() * sizeof(Cell) + nodes_.size() * sizeof(Node); }

  // Follows the sign of F along the line from t0 to t1, both in the region. The origin of the line lies near it.
  void follow(const Line& line, double t0, double t1, SignChanges& changes) const;

 private:
  struct Cell {
    Vec3 center{0};
    double f = 0;
    Vec3 g{0};
    double bend = kInfinity;   // bounds |F(c + q) - (f + g q)|
    double error = kInfinity;  // infinite: there is no model
    Mat3 h{0}, h_error{0};
    Vec3 slope_error{0};
    double rounding = 0;  // of F
    Vec3 slope_rounding{0};
  };
  struct Node {
    int axis = -1;  // of the cut; -1: a leaf
    double cut = 0;
    int child = -1;  // the part below the cut, the one above follows; of a leaf its cell, -1: no zero there
  };

  // False where the box certainly holds no zero.
  bool make_cell(const Box3& box, bool with_model, Cell& cell) const;
  void follow_cell(const Cell& cell, const Line& line, double t0, double t1, SignChanges& changes) const;

  ImplicitFormula formula_;
  std::vector<Node> nodes_;
  std::vector<Cell> cells_;
  Box3 where_zero_;
  double size_ = 0;  // of the region
  double rounding_ = 0;
};

}  // namespace lekalo::geometry
