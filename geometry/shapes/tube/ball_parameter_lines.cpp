#include "geometry/shapes/tube/ball_parameter_lines.h"

#include <cmath>

#include "geometry/curves/analytic/circle.h"
#include "geometry/shapes/tube/ball_circles.h"

namespace lekalo::geometry {

ShapeOutlines parameter_lines(const Balls& balls, const ParameterNet& net, const ViewOf& view) {
  ShapeOutlines result;
  constexpr Interval kLatitudes{-0.5 * kPi, 0.5 * kPi};
  const Condition half{1, 0, 0};  // of a great circle, from pole to pole
  for (size_t i = 0; i < balls.balls().size(); ++i) {
    const Balls::Ball& ball = balls.balls()[i];
    const auto add = [&](const Frame& frame, double radius, const std::vector<Condition>& conditions) {
      const Circle circle(frame, radius);
      const auto point = [&](double x) { return circle.point(x); };
      for (const Interval& arc : arcs_outside(balls, {i, i}, point, conditions)) {
        ShapeOutline line{std::make_shared<Circle>(frame, radius, arc), true, nullptr, {}};
        add_turns([&](double x) { return (point(x) - ball.center) / ball.radius; }, point, view, arc, line.turns);
        result.lines.push_back(std::move(line));
      }
    };
    for (const double u : values_in(net.u, {0, kTwoPi}, net.u.count > 1)) {
      const Vec3 x(std::cos(u), std::sin(u), 0);
      add({ball.center, x, {0, 0, 1}, {x.y, -x.x, 0}}, ball.radius, {half});
    }
    for (const double v : values_in(net.v, kLatitudes, false))
      if (std::abs(v) < kLatitudes.hi)
        add(frame_from(ball.center + Vec3(0, 0, ball.radius * std::sin(v)), {0, 0, 1}, {1, 0, 0}),
            ball.radius * std::cos(v), {});
  }
  return result;
}

}  // namespace lekalo::geometry
