// Newton's iteration of a line in a cell (line_cells.h), for the functions that are compiled for several processors: of
// one line, or of four at once. Both are the same operations in the same order, so they have the same bits.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/numerics/lanes.h"
#include "geometry/queries/rays/bezier_sums.h"
#include "geometry/queries/rays/line_cells.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

// Contraction factor up to which Newton's iteration is sure to converge: with |J^-1| r = q the derivative matrices of
// two places of the cell differ by at most 2 q / (1 - q) of either, which is 2/3 < 1 for q = 1/4.
inline constexpr double kContraction = 0.25;

// Row sums of |J^-1| r below 1 make the two functions one-to-one on the cell: a root that Newton's iteration finds
// there is the only one. Where it finds none, nothing is known.
inline constexpr double kInjective = 0.9;

// What the guess tells alone; unsure: Newton's iteration has to say.
inline Verdict judge(const Guess& guess, double slack_x, double slack_y) {
  return std::abs(guess.x) > 1 + slack_x + guess.ex || std::abs(guess.y) > 1 + slack_y + guess.ey ? Verdict::none
                                                                                                  : Verdict::unsure;
}

inline bool is_certain(const Guess& guess) { return guess.ex <= kInjective && guess.ey <= kInjective; }

// A vector's parts along a line's n1, n2 and the line.
template <class Parts, class Number>
inline void see(const Parts (&axes)[3], const Number& x, const Number& y, const Number& z, Parts& parts) {
  parts = x * axes[0] + y * axes[1] + z * axes[2];
}

// A place of a cell as its line sees it: the parts of the vector from the line's origin and of its derivatives by the
// cell's x and y, all times the same positive scale.
template <class Number, class Parts>
struct SeenPlace {
  Parts from_origin, dx, dy;
  Number scale;
};

// The place (x, y) of a cell of a rational patch. `axes`: of the line's basis; `origin`: the line's, as it sees it.
// The derivative of a ratio A / w is (w A' - A w') / w^2: without a division, times w^2.
template <int kP, int kQ, class Number, class Point, class Parts>
inline void see_patch(const PatchView& patch, const Number& cell_x, const Number& cell_y, const Number& half_x,
                      const Number& half_y, const Parts (&axes)[3], const Parts& origin, const Number& x,
                      const Number& y, SeenPlace<Number, Parts>& p) {
  const Number hx = 0.5 * half_x, hy = 0.5 * half_y;
  const PatchSums<Point> at =
      sums<kP, kQ, Number, Point>(patch, 0.5 * (cell_x + 1.0) + hx * x, 0.5 * (cell_y + 1.0) + hy * y);
  const Number w = at.point[3];
  Parts a, by_s, by_t;
  see(axes, Number(at.point[0]), Number(at.point[1]), Number(at.point[2]), a);
  see(axes, Number(at.ds[0]), Number(at.ds[1]), Number(at.ds[2]), by_s);
  see(axes, Number(at.dt[0]), Number(at.dt[1]), Number(at.dt[2]), by_t);
  p.from_origin = w * (a - w * origin);
  p.dx = hx * (w * by_s - at.ds[3] * a);
  p.dy = hy * (w * by_t - at.dt[3] * a);
  p.scale = w * w;
}

// A step of the iteration to (to_x, to_y), and from there back into the cell.
template <class Number>
struct NewtonStep {
  Number determinant, to_x, to_y, next_x, next_y;
};

template <class Number, class Parts>
inline void step_from(const Number& x, const Number& y, const SeenPlace<Number, Parts>& p, NewtonStep<Number>& step) {
  Number one;
  set_all(one, 1);
  step.determinant = p.dx[0] * p.dy[1] - p.dy[0] * p.dx[1];
  const Number inverse = 1 / step.determinant;
  const Number sx = (p.dy[0] * p.from_origin[1] - p.dy[1] * p.from_origin[0]) * inverse,
               sy = (p.dx[1] * p.from_origin[0] - p.dx[0] * p.from_origin[1]) * inverse;
  step.to_x = x + sx;
  step.to_y = y + sy;
  step.next_x = step.to_x < -one ? -one : one < step.to_x ? one : step.to_x;
  step.next_y = step.to_y < -one ? -one : one < step.to_y ? one : step.to_y;
}

// How far along the line the step's end is, as a length, from its origin.
template <class Number, class Parts>
inline void way_to(const Number& x, const Number& y, const SeenPlace<Number, Parts>& p, const NewtonStep<Number>& step,
                   Number& way) {
  way = (p.from_origin[2] + (step.next_x - x) * p.dx[2] + (step.next_y - y) * p.dy[2]) / p.scale;
}

// What one line's steps tell.
class NewtonProgress {
 public:
  enum class State { goes_on, none, one, unsure };

  NewtonProgress() = default;
  explicit NewtonProgress(const Guess& guess)
      : contracts_(guess.ex <= kContraction && guess.ey <= kContraction), left_(contracts_ ? 40 : 8) {}

  // After a step from (x, y). One: the root is the step's end.
  State after(double x, double y, const NewtonStep<double>& step, double slack_x, double slack_y) {
    if (step.determinant == 0) return State::unsure;
    // A root lies within the contraction factor times the way still to go, at most the cell's width 2, of the step's
    // end: a step that ends farther outside means none.
    constexpr double farthest = 1 + 2 * (2 * kContraction / (1 - kContraction));
    if (std::abs(step.to_x) > farthest + slack_x || std::abs(step.to_y) > farthest + slack_y)
      return contracts_ ? State::none : State::unsure;
    const double moved = std::max(std::abs(step.next_x - x), std::abs(step.next_y - y));
    if (moved < 1e-7) {
      // The remaining error is of the order of the square of the step. What the projection cut off must be rounding,
      // or, where it is known that the cell itself has no root then, the slack.
      const double off_x = std::abs(step.to_x - step.next_x), off_y = std::abs(step.to_y - step.next_y);
      if (!contracts_ && std::max(off_x, off_y) > kBorderSlack) return State::unsure;
      if (!(off_x > slack_x || off_y > slack_y)) return State::one;
      if (settled_) return State::none;
      settled_ = true;
    }
    return --left_ > 0 ? State::goes_on : State::unsure;
  }

 private:
  bool contracts_ = false, settled_ = false;
  int left_ = 0;
};

}  // namespace lekalo::geometry
