// Circles on balls, and stretches of curves on tubes: what outlines and sections of shapes made of balls share
// (ball_outlines.h, tube_section.cpp).
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "geometry/curves/analytic/circle.h"
#include "geometry/shapes/tube/ball_outlines.h"

namespace lekalo::geometry {

// How far outside of the shape a point of it is asked about, of the size.
inline constexpr double kBesideBalls = 1e-7;
// Directions of a curve that differ by less go on smoothly.
inline constexpr double kCorner = 1e-6;
inline constexpr double kAgreeOnBalls = 1e-13;  // of the size: lines that are fitted
inline constexpr double kSameOnBalls = 1e-12;   // of parameters: parts as short are none

// The circle of the points c + R n of a ball with n = k axis + s (cos x + sin y).
struct BallCircle {
  Vec3 center;
  double radius;  // of the ball
  Frame frame;    // origin 0, z the axis
  double k, s;

  Vec3 normal(double t) const { return k * frame.z + s * (std::cos(t) * frame.x + std::sin(t) * frame.y); }
  Vec3 point(double t) const { return center + radius * normal(t); }
  CurvePtr curve(const Interval& t) const;
  // The normal, by the same parameter.
  CurvePtr outward_offset(const Interval& t) const;
};
// Where the line of sight touches the ball; nothing for an eye inside.
std::optional<BallCircle> circle_of(const Vec3& center, double radius, const ViewOf& view);
// In the plane of a unit normal; nothing if it misses the ball.
std::optional<BallCircle> circle_of(const Vec3& center, double radius, const Vec3& origin, const Vec3& normal);

// What is kept of a circle: where a cos t + b sin t + c >= 0.
struct Condition {
  double a, b, c;
  double at(double t) const { return a * std::cos(t) + b * std::sin(t) + c; }
  // Adds where it is zero, in one turn.
  void add_roots(std::vector<double>& roots) const;
};
// `value` is linear in the point of the circle, or in the normal.
Condition condition(const std::function<double(double)>& value);
// Where all of them hold: within two turns from 0.
std::vector<Interval> kept(const std::vector<Condition>& conditions);

// Whether a curve turns from one piece to the next, which meet at `before` (the last place of the one) and `after`.
bool is_corner(const BallSweep& sweep, double before, double after);
// Whether both pieces are straight there, with one radius: the walls meet in half an ellipse.
bool is_straight_corner(const BallSweep& sweep, double before, double after);
// What of a circle on the ball between two pieces of a tube's curve neither the balls before it (nothing: it is the
// first) nor those after it hide, n . c' >= -R' before and n . c' <= -R' after, nor flat ends cut off.
std::vector<Interval> arcs_between(const Tube& tube, const BallCircle& circle, std::optional<double> before,
                                   std::optional<double> after);
// What of a circle on two balls, which may be the same, lies outside of all others and where the conditions hold.
std::vector<Interval> arcs_outside(const Balls& balls, const std::array<size_t, 2>& on,
                                   const std::function<Vec3(double)>& point, std::vector<Condition> conditions = {});
// Whether the balls next to a flat end (side 0 or 1), whose ball is given, reach farther into its plane than that does.
bool grows_inward(const BallJet& ball, int side);
// The edge of such an end: where its plane cuts the wall of the balls behind. `view` is that of the turns.
ShapeOutlines edge_of_end(const Tube& tube, int side, const ViewOf& view);

// Adds the parameters in a range at which a surface with these unit normals along an edge turns away from the viewer,
// where all points of the edge are as far from the surface's centre or axis: n . (p - e) is linear in cos t and sin t.
void add_turns(const std::function<Vec3(double)>& normal, const std::function<Vec3(double)>& point, const ViewOf& view,
               const Interval& range, std::vector<double>& turns);

// The zero of a monotone function between two places, or the nearer of them where it has one sign: the secant's in a
// bracket.
double zero_between(const std::function<double(double)>& value, double a, double b);

// Lines on the wall of a tube that are found circle by circle, across the axis e: points with u . f = k, |f| = 1 across
// e, are u = k f + side e x f with side = -+ sqrt(1 - k^2). Over a stretch of t there are two; at an end with |k| = 1
// they join, and rounding of t moves them along the line there: up to |k| = 0.7 they are told by the angle from the
// end.
struct WallPlace {
  double t, k, side;
};
struct WallPath {
  Interval range;
  std::function<WallPlace(double)> at;
};
// `share` is k by t.
std::vector<WallPath> wall_paths(const Interval& t, bool joins_lo, bool joins_hi,
                                 const std::function<double(double)>& share);

// A line on a tube as a polynomial curve that agrees to 1e-13 of the size. Where the two points of a circle nearly meet
// rounding moves them along the line: there the curve goes on at a pace of its own, as long as its points are on the
// line as exactly, by is_on_line(parameter, point); where they are not, and where there is no such curve (null),
// `complete` is set to false.
CurvePtr fitted_line(const Interval& range, double size, const std::function<Vec3(double)>& point_at,
                     const std::function<bool(double, const Vec3&)>& is_on_line, bool& complete);

// Calls put(stretch, state) for the stretches of a range on which the state is the same, as seen at so many places;
// ends of stretches by halving. Places are asked side by side.
template <class State, class Put>
void each_stretch(const Interval& range, int places, const State& state, const Put& put) {
  constexpr double kInside = 1e-9;  // of the range: its ends themselves are on borders
  const auto place = [&](int k) {
    return range.lo + range.width() * std::clamp(static_cast<double>(k) / places, kInside, 1 - kInside);
  };
  struct Seen {
    decltype(state(0.0)) value{};
    double end = 0;  // of the stretch before, where the state is another there
  };
  std::vector<Seen> seen(static_cast<size_t>(places) + 1);
  const auto each = [&](const auto& visit) {
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(tbb::blocked_range<int>(0, places + 1, 4), [&](const tbb::blocked_range<int>& some) {
        for (int k = some.begin(); k < some.end(); ++k) visit(k, seen[static_cast<size_t>(k)]);
      });
    });
  };
  each([&](int k, Seen& here) { here.value = state(place(k)); });
  each([&](int k, Seen& here) {
    if (k == 0) return;
    const auto before = seen[static_cast<size_t>(k) - 1].value;
    if (here.value == before) return;
    double lo = place(k - 1), hi = place(k);
    for (double middle = 0.5 * (lo + hi); lo < middle && middle < hi; middle = 0.5 * (lo + hi))
      (state(middle) == before ? lo : hi) = middle;
    here.end = hi;
  });
  double from = range.lo;
  for (size_t k = 1; k < seen.size(); ++k) {
    const auto before = seen[k - 1].value;
    if (seen[k].value == before) continue;
    if (seen[k].end - from > kSameOnBalls * range.width()) put(Interval{from, seen[k].end}, before);
    from = seen[k].end;
  }
  if (range.hi - from > kSameOnBalls * range.width()) put(Interval{from, range.hi}, seen.back().value);
}

}  // namespace lekalo::geometry
