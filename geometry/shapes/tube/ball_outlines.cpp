#include "geometry/shapes/tube/ball_outlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/splines/polynomial_approximation.h"
#include "geometry/numerics/interval.h"
#include "geometry/shapes/tube/ball_circles.h"

namespace lekalo::geometry {

namespace {

constexpr double kAgreeAside = 1e-4;
// Of h, relative: less is the end-on view, where n is not determined.
constexpr double kEndOn = 1e-13;
constexpr int kPlacesOfRim = 96;
class TubeOutlines {
 public:
  TubeOutlines(const Tube& tube, const ViewOf& view) : tube_(tube), sweep_(tube.sweep()), view_(view) {
    size_ = tube.bounds().diameter();
  }

  ShapeOutlines find() {
    const Curve& curve = sweep_.curve();
    const std::vector<CurvePiece> pieces = curve.pieces();
    for (const CurvePiece& piece : pieces) add_walls(sweep_.moving(intersect(piece.domain, curve.domain())));
    // Balls between pieces, and at the ends.
    for (size_t k = 0; k < pieces.size(); ++k) {
      const bool first = k == 0;
      if (first && !curve.is_closed()) continue;
      const double before = pieces[first ? pieces.size() - 1 : k - 1].domain.hi, after = pieces[k].domain.lo;
      add_ball(before_end(before), after);
      add_crease(before_end(before), after);
    }
    if (!curve.is_closed()) {
      add_ball(std::nullopt, curve.domain().lo);
      add_ball(before_end(curve.domain().hi), std::nullopt);
      if (tube_.caps() != Caps::round) add_ends();
    }
    return std::move(result_);
  }

 private:
  static double before_end(double t) { return next_down(t); }

  // n = p e + sqrt(1 - p^2) u with u across e; n . b = beta makes u . f = k.
  struct Balance {
    Vec3 e, f;
    double p, k, h;  // h: (1 - p^2) (1 - k^2) times the square of the sine between e and b, negative for no outline
  };
  Balance balance(double t) const {
    const BallJet ball = sweep_.ball(t);
    const Vec3 b = view_.central ? ball.center[0] - view_.direction_or_eye : view_.direction_or_eye;
    const double beta = view_.central ? -ball.radius[0] : 0, speed = glm::length(ball.center[1]);
    Balance result;
    result.e = ball.center[1] / speed;
    result.p = -ball.radius[1] / speed;
    // Twice: what is left of b is small where the tube is seen end-on.
    Vec3 across = b - glm::dot(b, result.e) * result.e;
    across -= glm::dot(across, result.e) * result.e;
    const double length = glm::length(across), rest = 1 - result.p * result.p;
    const double needed = beta - result.p * glm::dot(b, result.e);
    result.f = across / length;
    result.k = needed / (std::sqrt(std::max(rest, 0.0)) * length);
    result.h = (rest * length * length - needed * needed) / glm::dot(b, b);
    return result;
  }
  double h(double t) const { return balance(t).h; }
  Vec3 normal(const WallPlace& place) const {
    const Balance at = balance(place.t);
    const Vec3 u = place.k * at.f + place.side * glm::cross(at.e, at.f);
    return at.p * at.e + std::sqrt(std::max(1 - at.p * at.p, 0.0)) * u;
  }
  Vec3 point(double t, const Vec3& n) const {
    const BallJet ball = sweep_.ball(t);
    return ball.center[0] + ball.radius[0] * n;
  }
  // How the wall bends along the line of sight: below 0 away from it.
  double bend(double t, const Vec3& n) const {
    const BallJet ball = sweep_.ball(t);
    const double R = ball.radius[0], way = glm::dot(n, ball.center[1]);
    Vec3 sight = view_.central ? point(t, n) - view_.direction_or_eye : view_.direction_or_eye;
    sight = glm::normalize(sight);
    const double second =
        ball.radius[2] + glm::dot(n, ball.center[2]) - (glm::dot(ball.center[1], ball.center[1]) - way * way) / R;
    const double mixed = glm::dot(ball.center[1], sight) / R;
    return -1 / R - mixed * mixed / second;
  }

  // A stretch of t between two ends, each of which is one of its own or one where the branches join.
  void add_walls(const Interval& all) {
    if (!(all.width() > 0)) return;
    const double last = before_end(all.hi);
    const auto at = [&](double t) { return std::min(t, last); };
    constexpr int kPlaces = 256;
    struct Cut {
      double t;
      bool end_on;
    };
    std::vector<Cut> cuts;
    // Between two places on whose sides h differs.
    const auto add_change = [&](double lo, double hi) {
      const bool negative = h(lo) < 0;
      for (double middle = 0.5 * (lo + hi); lo < middle && middle < hi; middle = 0.5 * (lo + hi))
        ((h(middle) < 0) == negative ? lo : hi) = middle;
      cuts.push_back({negative ? hi : lo, false});
    };
    const auto place = [&](int i) { return at(all.lo + all.width() * i / kPlaces); };
    double before = h(all.lo), before_that = before;
    for (int k = 1; k <= kPlaces; ++k) {
      const double here = h(place(k));
      const double side = before < 0 ? -1 : 1;
      if ((here < 0) != (before < 0)) {
        add_change(place(k - 1), place(k));
      } else if (k > 1 && (before_that < 0) == (before < 0) && side * before <= side * before_that &&
                 side * before <= side * here) {
        // Nearest to zero between its neighbours: perhaps it touches zero, or goes beyond for a short stretch.
        double lo = place(k - 2), hi = place(k);
        for (int step = 0; step < 100; ++step) {
          const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
          const bool nearer_a = side * h(a) < side * h(b);
          (nearer_a ? hi : lo) = nearer_a ? b : a;
        }
        const double nearest = 0.5 * (lo + hi), least = side * h(nearest);
        if (least < -kEndOn) {
          add_change(place(k - 2), nearest);
          add_change(nearest, place(k));
        } else if (least < kEndOn && side > 0) {
          cuts.push_back({nearest, true});
        }
      }
      before_that = before, before = here;
    }
    // A curve that begins or ends along the line of sight.
    const auto is_end_on = [&](double t) { return std::abs(h(t)) < kEndOn; };
    std::vector<Cut> ends{{all.lo, is_end_on(all.lo)}};
    for (const Cut& cut : cuts)
      if (cut.t > ends.back().t && cut.t < last) ends.push_back(cut);
    ends.push_back({last, is_end_on(last)});
    for (size_t k = 0; k < ends.size(); ++k) {
      if (ends[k].end_on) add_ball(ends[k].t, ends[k].t);
      if (k + 1 == ends.size() || !(h(0.5 * (ends[k].t + ends[k + 1].t)) > 0)) continue;
      const bool joins_lo = k > 0 && !ends[k].end_on, joins_hi = k + 2 < ends.size() && !ends[k + 1].end_on;
      Interval t{ends[k].t, ends[k + 1].t};
      // There the directions have no limit that rounding leaves.
      const double inset = 1e-7 * t.width();
      if (ends[k].end_on) t.lo += inset;
      if (ends[k + 1].end_on) t.hi -= inset;
      add_wall(t, joins_lo, joins_hi);
    }
  }

  // Both branches over t.
  void add_wall(const Interval& t, bool joins_lo, bool joins_hi) {
    for (const WallPath& path : wall_paths(t, joins_lo, joins_hi, [this](double x) { return balance(x).k; }))
      add_path(path.range, path.at);
  }

  void add_path(const Interval& range, const std::function<WallPlace(double)>& place) {
    const auto t_at = [&](double s) { return place(s).t; };
    const auto normal_at = [&](double s) { return normal(place(s)); };
    const auto point_at = [&](double s) {
      const WallPlace at = place(s);
      return point(at.t, normal(at));
    };
    const auto bends_away = [&](double s) {
      const WallPlace at = place(s);
      return bend(at.t, normal(at)) < 0;
    };
    const auto is_outside = [&](double s) {
      const Vec3 p = point_at(s);
      if (tube_.is_cut_off(p, place(s).t)) return false;
      return !tube_.holds(p + kBesideBalls * size_ * normal_at(s));
    };
    // Cut at cusps, and where it enters or leaves the tube itself or what its ends cut away.
    constexpr int kCuspPlaces = 1024;
    const int places = std::max(64, static_cast<int>(sweep_.cells().size()));
    each_stretch(range, kCuspPlaces, bends_away, [&](const Interval& smooth, bool away) {
      const int share = static_cast<int>(std::ceil(places * smooth.width() / range.width()));
      each_stretch(smooth, std::max(8, share), is_outside, [&](const Interval& part, bool outside) {
        if (outside) put(part, t_at, point_at, normal_at, away ? 1 : -1);
      });
    });
  }

  // The ball that touches the wall at a point of it, (p - c) . c' = -R R', near t.
  BallJet touching_ball(const Vec3& p, double t) const {
    constexpr int kSteps = 3;
    const Interval domain = sweep_.curve().domain();
    for (int step = 0; step < kSteps; ++step) {
      const BallJet at = sweep_.ball(t);
      const Vec3 off = p - at.center[0];
      const double value = glm::dot(off, at.center[1]) + at.radius[0] * at.radius[1];
      const double slope = glm::dot(off, at.center[2]) - glm::dot(at.center[1], at.center[1]) +
                           at.radius[1] * at.radius[1] + at.radius[0] * at.radius[2];
      if (slope != 0) t = std::clamp(t - value / slope, domain.lo, before_end(domain.hi));
    }
    return sweep_.ball(t);
  }

  void put(const Interval& range, const std::function<double(double)>& t_at,
           const std::function<Vec3(double)>& point_at, const std::function<Vec3(double)>& normal_at, double side) {
    const std::array<Interval, 1> whole{range};
    // Off the outline by d, along the wall, the line of sight is off the tangent plane by d/R.
    const auto is_on_outline = [&](double s, const Vec3& p) {
      const BallJet ball = touching_ball(p, t_at(s));
      const Vec3 n = (p - ball.center[0]) / ball.radius[0];
      const Vec3 sight = glm::normalize(view_.central ? p - view_.direction_or_eye : view_.direction_or_eye);
      return std::abs(glm::length(n) - 1) * ball.radius[0] <= kAgreeOnBalls * size_ &&
             std::abs(glm::dot(n, sight)) * ball.radius[0] <= kAgreeOnBalls * size_;
    };
    const CurvePtr curve = fitted_line(range, size_, point_at, is_on_outline, result_.complete);
    const CurvePtr outward_offset =
        polynomial_approximation([&](double s) { return side * normal_at(s); }, whole, kAgreeAside);
    if (!curve || !outward_offset) {
      result_.complete = false;
      return;
    }
    result_.lines.push_back({curve, false, outward_offset, {}});
  }

  // The circle of one ball, as far as neither the balls before it (the curve ends there at `before`) nor those after it
  // hide it.
  void add_ball(std::optional<double> before, std::optional<double> after) {
    if (before && after && *before != *after && !is_corner(sweep_, *before, *after)) return;  // the wall goes on
    const BallJet ball = sweep_.ball(before ? *before : *after);
    const auto circle = circle_of(ball.center[0], ball.radius[0], view_);
    if (!circle) return;
    for (const Interval& arc : arcs_between(tube_, *circle, before, after)) add_arc(*circle, arc);
  }

  // On the inner side of a corner two straight tubes of one radius meet in half an ellipse, in the plane half way
  // between them.
  void add_crease(double before, double after) {
    const BallJet a = sweep_.ball(before), b = sweep_.ball(after);
    const Vec3 first = glm::normalize(a.center[1]), second = glm::normalize(b.center[1]);
    const double R = b.radius[0];
    const Vec3 inward = second - first, across = glm::cross(first, second);
    if (glm::length(inward) < kCorner) return;
    const double cosine = glm::length(first + second) / 2;  // of half the turn
    if (!is_straight_corner(sweep_, before, after) || !(glm::length(across) > kCorner)) return;
    Frame frame;
    frame.origin = b.center[0];
    frame.x = glm::normalize(across), frame.y = glm::normalize(inward), frame.z = glm::cross(frame.x, frame.y);
    const auto ellipse = std::make_shared<Ellipse>(frame, R, R / cosine, Interval{0, kPi});
    ShapeOutline crease{ellipse, true, nullptr, {}};
    const auto point = [&](double t) {
      return frame.origin + std::cos(t) * R * frame.x + std::sin(t) * R / cosine * frame.y;
    };
    for (const Vec3& axis : {first, second})
      add_turns(
          [&](double t) {
            const Vec3 from = point(t) - frame.origin;
            return (from - glm::dot(from, axis) * axis) / R;
          },
          point, view_, {0, kPi}, crease.turns);
    result_.lines.push_back(std::move(crease));
  }

  // What of it other parts of the tube do not hide.
  void add_arc(const BallCircle& circle, const Interval& arc) {
    const auto is_outside = [&](double x) {
      const Vec3 n = circle.normal(x);
      return !tube_.holds(circle.center + circle.radius * n + kBesideBalls * size_ * n);
    };
    each_stretch(arc, 48, is_outside, [&](const Interval& part, bool outside) {
      if (outside) result_.lines.push_back({circle.curve(part), false, circle.outward_offset(part), {}});
    });
  }

  // The circles at flat and open ends.
  void add_ends() {
    for (int side = 0; side < 2; ++side) {
      const Tube::End& end = tube_.end(side);
      const Interval domain = sweep_.curve().domain();
      const BallJet ball = sweep_.ball(side == 0 ? domain.lo : before_end(domain.hi));
      if (grows_inward(ball, side)) {
        ShapeOutlines edge = edge_of_end(tube_, side, view_);
        result_.complete = result_.complete && edge.complete && !edge.lines.empty();
        for (ShapeOutline& line : edge.lines) result_.lines.push_back(std::move(line));
        continue;
      }
      const Frame frame = frame_about(end.point, end.inward);
      const auto normal = [&](double t) { return std::cos(t) * frame.x + std::sin(t) * frame.y; };
      const auto point = [&](double t) { return frame.origin + ball.radius[0] * normal(t); };
      const auto is_outside = [&](double t) {
        return !tube_.holds(point(t) + kBesideBalls * size_ * (normal(t) - end.inward));
      };
      each_stretch({0, kTwoPi}, kPlacesOfRim, is_outside, [&](const Interval& arc, bool outside) {
        if (!outside) return;
        ShapeOutline edge{std::make_shared<Circle>(frame, ball.radius[0], arc), true, nullptr, {}};
        add_turns(normal, point, view_, arc, edge.turns);
        result_.lines.push_back(std::move(edge));
      });
    }
  }

  const Tube& tube_;
  const BallSweep& sweep_;
  const ViewOf& view_;
  double size_;
  ShapeOutlines result_;
};

// The circle about a frame's z axis on both balls, which may be the same, as far as it is on the shape.
void add_edges(const Balls& balls, const std::array<size_t, 2>& on, const Frame& frame, double radius,
               const ViewOf& view, ShapeOutlines& outlines) {
  const Circle circle(frame, radius);
  const auto point = [&](double x) { return circle.point(x); };
  for (const Interval& arc : arcs_outside(balls, on, point)) {
    ShapeOutline edge{std::make_shared<Circle>(frame, radius, arc), true, nullptr, {}};
    for (size_t k = 0; k < (on[0] == on[1] ? 1 : 2); ++k) {
      const Balls::Ball& ball = balls.balls()[on[k]];
      add_turns([&](double x) { return (point(x) - ball.center) / ball.radius; }, point, view, arc, edge.turns);
    }
    outlines.lines.push_back(std::move(edge));
  }
}

}  // namespace

ShapeOutlines outlines(const Tube& tube, const ViewOf& view) { return TubeOutlines(tube, view).find(); }

ShapeOutlines outlines(const Balls& balls, const ViewOf& view) {
  ShapeOutlines result;
  const auto& all = balls.balls();
  for (size_t i = 0; i < all.size(); ++i) {
    if (const auto circle = circle_of(all[i].center, all[i].radius, view))
      for (const Interval& arc : arcs_outside(balls, {i, i}, [&](double x) { return circle->point(x); }))
        result.lines.push_back({circle->curve(arc), false, circle->outward_offset(arc), {}});
    balls.near(i, [&](size_t k) {
      if (k <= i) return;
      // The circle of two balls.
      const Vec3 way = all[k].center - all[i].center;
      const double apart = glm::length(way), a = all[i].radius, b = all[k].radius;
      const double height = 0.5 * (apart + (a * a - b * b) / apart), square = a * a - height * height;
      if (!(apart > 0) || !(square > 0)) return;
      add_edges(balls, {i, k}, frame_about(all[i].center + height / apart * way, way / apart), std::sqrt(square), view,
                result);
    });
  }
  return result;
}

ShapeOutlines plane_section(const Balls& balls, const Vec3& origin, const Vec3& normal, const ViewOf& view) {
  ShapeOutlines result;
  const Vec3 n = glm::normalize(normal);
  const auto& all = balls.balls();
  for (size_t i = 0; i < all.size(); ++i) {
    const double height = glm::dot(origin - all[i].center, n), square = all[i].radius * all[i].radius - height * height;
    if (square > 0)
      add_edges(balls, {i, i}, frame_about(all[i].center + height * n, n), std::sqrt(square), view, result);
  }
  return result;
}

}  // namespace lekalo::geometry
