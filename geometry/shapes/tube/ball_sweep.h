// Lines against the balls of radius R(t) about the points r(t) of a curve, all of them together.
//
// Along a line o + s d, |d| = 1, with a = (r - o) . d and f = r - o - a d the point's part across it, the ball at t is
//
//   a(t) - sqrt(g(t)) <= s <= a(t) + sqrt(g(t)),   g = R^2 - f . f,   where g >= 0.
//
// These intervals change with t without jumps. So the balls of each stretch of t on which g >= 0 fill ONE interval of
// the line, from the minimum of a - sqrt(g) to the maximum of a + sqrt(g), and the line's part inside all balls is the
// union of as many intervals as there are stretches. Everything is a question about the two functions a and g of one
// variable; kinks, cusps, and places where the curve bends more than the tube need nothing of their own.
//
// The curve is cut into cells. On a cell there is one stretch if g'' <= 0, g' != 0 or g > 0 throughout; and the minimum
// (maximum) is the only place where N = a' sqrt(g) - g'/2 (with -a for a) is zero, or an end, if
//
//   D = a'^2 - g''/2 + a'' sqrt(g) > 0   where N = 0,   or N has one sign.
//
// D = r'^2 - R'^2 - R R'' - (p - r) . r'' at the meeting p does not depend on the line's direction: where the radius of
// curvature is larger than the tube's, cells are found out at build on which it is positive for every line. What is
// not certain on a cell is halved.
//
// Lines are searched on a polynomial model of each cell that agrees with the curve to rounding, where there is one (it
// is some ten times as fast as a formula); every end that is left of the union takes its last step on the curve itself.
#pragma once

#include "geometry/queries/rays/line_spans.h"
#include "geometry/shapes/tube/radius_law.h"

namespace lekalo::geometry {

// Center and radius of a ball with their derivatives up to order 2.
struct BallJet {
  std::array<Vec3, 3> center;
  std::array<double, 3> radius;
};

// What a line is cut to, and the faces that cut it.
struct SpanLimit {
  double lo = -kInfinity, hi = kInfinity;
  int face_lo = 0, face_hi = 0;
};

class BallSweep {
 public:
  static constexpr int kModelTerms = 10;
  struct Cell {
    Interval t;
    BallJet middle;
    // r and R as polynomials of (t - middle)/half the width: what lines are searched on.
    std::array<Vec4, kModelTerms> model;
    bool is_modelled = false;           // else on the curve itself
    double variation_bound = 0;         // r'' is this near to that of the middle
    double radius_variation_bound = 0;  // the same of R''
    bool regular = false;               // D > 0 for every line
    bool is_place = false;              // its balls are all one but for rounding
    Box3 box;                           // of its balls
    double min_radius = 0;
  };

  // Throws FieldError (field of) for an unbounded curve or one without length, (field radius) for a radius that is not
  // positive.
  BallSweep(CurvePtr curve, RadiusLaw law);

  const Curve& curve() const { return *curve_; }
  const std::vector<Cell>& cells() const { return cells_; }
  double size() const { return size_; }
  BallJet ball(double t) const;
  BallJet ball(const Cell& cell, double t) const;  // of the cell's model
  // The range from and to where the curve moves: an end at which it rests (a retracted handle) has no direction of its
  // own, but a limit; 1e-11 of the range is left out there.
  Interval moving(Interval range) const;

  // Adds what the balls of a cell fill of the line, whose direction is a unit vector and whose origin is near; u of the
  // ends is the parameter t of the ball, their piece the cell.
  void add_spans(int cell, const Line& line, const SpanLimit& limit, LineSpans& spans) const;
  // Moves an end of a span that is left of the union onto the curve's own balls.
  void finish(SpanEnd& end, bool is_in, const Line& line) const;

 private:
  void cut(const Interval& t);
  void add_model(Cell& cell) const;

  CurvePtr curve_;
  RadiusLaw law_;
  std::vector<Cell> cells_;
  double size_ = 0;
  double narrowest_ = 0;  // cells of this width are not divided
};

}  // namespace lekalo::geometry
