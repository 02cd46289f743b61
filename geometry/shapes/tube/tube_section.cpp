// Sections of tubes by planes (declared in ball_outlines.h).
//
// The wall consists of circles: the points c + R n with n . c' = -R', of radius rho = R sqrt(1 - p^2) about
// q = c + R p e, where e = c'/|c'| and p = -R'/|c'|. The plane m . x = h cuts the circle where
//
//   g = |m_e|^2 - ((h - m . q) / rho)^2 >= 0,   m_e the part of m across e,
//
// in the two points q + rho (k f +- sqrt(1 - k^2) e x f), f = m_e/|m_e|, k = (h - m . q)/(rho |m_e|). Where g < 0 all
// of the circle lies on one side. A stretch with g > 0 between places on different sides is a loop about the tube:
// where the curve goes nearly straight through the plane it is a function of the angle, at each angle the t of the
// wall's line that lies in the plane. (By t alone a section across a tube, which is all of one circle, could not be
// told.)

#include "geometry/curves/analytic/segment.h"
#include "geometry/shapes/tube/ball_circles.h"
#include "geometry/shapes/tube/ball_outlines.h"

namespace lekalo::geometry {

namespace {

// |e . m| from which a loop about the tube is a function of the angle.
constexpr double kSteep = 0.8;
constexpr double kShortest = 1e-6;  // of the domain: on stretches as short g is rounding, or has one top
// Of g: less between two stretches is where the two points of a circle meet, and the section crosses itself.
constexpr double kMeets = 1e-12;
constexpr int kPlaces = 256;  // a piece of the curve
constexpr int kTurnPlaces = 64;

class TubeSection {
 public:
  TubeSection(const Tube& tube, const Vec3& origin, const Vec3& normal, const ViewOf& view)
      : tube_(tube),
        sweep_(tube.sweep()),
        origin_(origin),
        m_(normal),
        frame_(frame_about(origin, normal)),
        view_(view),
        size_(tube.bounds().diameter()) {}

  // Of the wall alone, within a range of t.
  ShapeOutlines find_wall(const Interval& range) {
    for (const CurvePiece& piece : sweep_.curve().pieces()) add_walls(intersect(piece.domain, range));
    return std::move(result_);
  }

  ShapeOutlines find() {
    const Curve& curve = sweep_.curve();
    const std::vector<CurvePiece> pieces = curve.pieces();
    for (const CurvePiece& piece : pieces) add_walls(intersect(piece.domain, curve.domain()));
    for (size_t k = 0; k < pieces.size(); ++k) {
      if (k == 0 && !curve.is_closed()) continue;
      const double before = next_down(pieces[k == 0 ? pieces.size() - 1 : k - 1].domain.hi),
                   after = pieces[k].domain.lo;
      if (is_corner(sweep_, before, after)) add_ball(before, after);
    }
    if (!curve.is_closed()) {
      add_ball(std::nullopt, curve.domain().lo);
      add_ball(next_down(curve.domain().hi), std::nullopt);
      if (tube_.caps() == Caps::flat) add_ends();
    }
    return std::move(result_);
  }

 private:
  // The circle of the wall at t.
  struct WallCircle {
    Vec3 axis, center;
    double p, radius;
    double height;  // of the center over the plane
    Vec3 steepest;  // m's part across the axis
    // Negative where the plane does not meet it, also where there is no wall.
    double g() const {
      if (!(radius > 0)) return -1;
      const double k = height / radius;
      return glm::dot(steepest, steepest) - k * k;
    }
  };
  WallCircle circle(double t) const {
    const BallJet ball = sweep_.ball(t);
    WallCircle at;
    const double speed = glm::length(ball.center[1]);
    at.axis = ball.center[1] / speed;
    at.p = -ball.radius[1] / speed;
    at.radius = std::abs(at.p) < 1 ? ball.radius[0] * std::sqrt(1 - at.p * at.p) : 0;
    at.center = ball.center[0] + ball.radius[0] * at.p * at.axis;
    at.height = glm::dot(at.center - origin_, m_);
    // Twice: what is left of m is small where the plane goes across.
    at.steepest = m_ - glm::dot(m_, at.axis) * at.axis;
    at.steepest -= glm::dot(at.steepest, at.axis) * at.axis;
    return at;
  }
  // A point of it, in a unit direction across the axis.
  struct WallPoint {
    double t;
    WallCircle circle;
    Vec3 direction;
    Vec3 point() const { return circle.center + circle.radius * direction; }
    Vec3 normal() const { return circle.p * circle.axis + std::sqrt(1 - circle.p * circle.p) * direction; }
  };
  // The direction across the axis at an angle about m.
  Vec3 direction_at_angle(const WallCircle& at, double angle) const {
    Vec3 x = frame_.x - glm::dot(frame_.x, at.axis) * at.axis;
    x = glm::normalize(x);
    return std::cos(angle) * x + std::sin(angle) * glm::cross(at.axis, x);
  }

  // A place of the domain, with the sign of g there and, where that is negative, the side of the circle.
  struct Place {
    double t;
    bool meets, above;
  };
  Place place(double t) const {
    const WallCircle at = circle(t);
    return {t, at.g() >= 0, at.height > 0};
  }
  // Where g changes its sign, the place on the side of `b`.
  double change(Place a, Place b) const {
    for (double middle = 0.5 * (a.t + b.t); a.t < middle && middle < b.t; middle = 0.5 * (a.t + b.t))
      (place(middle).meets == a.meets ? a.t : b.t) = middle;
    return a.meets ? a.t : b.t;
  }

  // An end of a stretch of t.
  struct End {
    double t;
    bool joins;   // both points of the circle are one there
    Place outer;  // a place beyond, where the plane does not meet the circle
  };

  void add_walls(const Interval& all) {
    if (!(all.width() > 0)) return;
    std::vector<Place> places;
    const auto at = [&](int k) { return std::min(all.lo + all.width() * k / kPlaces, next_down(all.hi)); };
    for (int k = 0; k <= kPlaces; ++k) {
      const Place here = place(at(k));
      // A circle that is met between two places on both of whose sides it is not.
      if (!places.empty() && !places.back().meets && !here.meets && places.back().above != here.above)
        add_across(places.back(), here, places);
      places.push_back(here);
      if (k >= 2) add_touch(at(k - 2), at(k - 1), at(k), places);
    }
    // Stretches where it is met.
    for (size_t k = 0; k < places.size();) {
      if (!places[k].meets) {
        ++k;
        continue;
      }
      size_t last = k;
      while (last + 1 < places.size() && places[last + 1].meets) ++last;
      End lo{places[k].t, k > 0, {}}, hi{places[last].t, last + 1 < places.size(), {}};
      if (lo.joins) lo.outer = places[k - 1], lo.t = change(places[k - 1], places[k]);
      if (hi.joins) hi.outer = places[last + 1], hi.t = change(places[last], places[last + 1]);
      add_stretch(lo, hi);
      k = last + 1;
    }
  }

  // Between two places on different sides: a place where the circle is met, or, if rounding leaves none, the loop at
  // once.
  void add_across(Place a, Place b, std::vector<Place>& places) {
    const Place from = a, to = b;
    for (double middle = 0.5 * (a.t + b.t); a.t < middle && middle < b.t; middle = 0.5 * (a.t + b.t)) {
      const Place here = place(middle);
      if (here.meets) return places.push_back(here);
      (here.above == a.above ? a : b) = here;
    }
    add_loop(from, to);
  }

  // A bulge of the wall that the plane cuts: the largest g of three places on one side, if it is positive.
  void add_touch(double a, double b, double c, std::vector<Place>& places) {
    const auto g = [&](double t) { return circle(t).g(); };
    if (!(g(a) < 0 && g(b) < 0 && g(c) < 0 && g(b) >= g(a) && g(b) >= g(c))) return;
    double lo = a, hi = c;
    constexpr int kSteps = 80;
    for (int step = 0; step < kSteps && g(0.5 * (lo + hi)) < 0; ++step) {
      const double first = lo + (hi - lo) / 3, second = hi - (hi - lo) / 3;
      (g(first) < g(second) ? lo : hi) = g(first) < g(second) ? first : second;
    }
    const Place top = place(0.5 * (lo + hi));
    if (!top.meets || place(a).above != place(c).above) return;  // on different sides it was found before
    places.insert(
        std::upper_bound(places.begin(), places.end(), top.t, [](double t, const Place& one) { return t < one.t; }),
        top);
  }

  bool goes_across(const Interval& t) const {
    for (const double x : {0.0, 0.25, 0.5, 0.75, 1.0})
      if (std::abs(glm::dot(circle(t.lo + x * t.width()).axis, m_)) <= kSteep) return false;
    return true;
  }

  void add_stretch(const End& lo, const End& hi) {
    const Interval t{lo.t, hi.t};
    const auto g = [&](double x) { return circle(x).g(); };
    const auto at = [&](int k) { return t.lo + t.width() * k / kPlaces; };
    std::vector<double> least;  // places inside
    for (int k = 1; k + 1 < kPlaces; ++k) {
      if (!(g(at(k)) <= g(at(k - 1)) && g(at(k)) <= g(at(k + 1)))) continue;
      double a = at(k - 1), b = at(k + 1);
      constexpr int kSteps = 80;
      for (int step = 0; step < kSteps; ++step) {
        const double first = a + (b - a) / 3, second = b - (b - a) / 3;
        (g(first) < g(second) ? b : a) = g(first) < g(second) ? second : first;
      }
      const double place_of_least = 0.5 * (a + b);
      if (g(place_of_least) < -kMeets) {
        // A gap between the places that were looked at.
        const Place gap = place(place_of_least);
        add_stretch(lo, {change(place(at(k - 1)), gap), true, gap});
        return add_stretch({change(gap, place(at(k + 1))), true, gap}, hi);
      }
      least.push_back(place_of_least);
    }
    const bool is_plain = least.empty() || t.width() < kShortest * sweep_.curve().domain().width();
    if (lo.joins && hi.joins && lo.outer.above != hi.outer.above && is_plain && goes_across(t))
      return add_loop(lo.outer, hi.outer);
    // Where the two points meet inside of the stretch each goes on as the other.
    std::vector<End> ends{lo};
    for (const double place : least)
      if (g(place) < kMeets) ends.push_back({place, false, {}});
    ends.push_back(hi);
    for (size_t k = 0; k + 1 < ends.size(); ++k)
      if (ends[k].t < ends[k + 1].t) add_wall({ends[k].t, ends[k + 1].t}, ends[k].joins, ends[k + 1].joins);
  }

  static double share(const WallCircle& at) { return -at.height / (at.radius * glm::length(at.steepest)); }

  void add_wall(const Interval& t, bool joins_lo, bool joins_hi) {
    for (const WallPath& path : wall_paths(t, joins_lo, joins_hi, [this](double x) { return share(circle(x)); }))
      add_path(path.range, [at = path.at, this](double s) {
        const WallPlace place = at(s);
        const WallCircle wall = circle(place.t);
        const Vec3 f = glm::normalize(wall.steepest);
        return WallPoint{place.t, wall, place.k * f + place.side * glm::cross(wall.axis, f)};
      });
  }

  // All around the tube between two places on different sides, by the angle.
  void add_loop(const Place& from, const Place& to) {
    add_path({0, kTwoPi}, [=, this](double angle) {
      const double t = zero_between(
          [&](double x) {
            const WallCircle at = circle(x);
            return at.height + at.radius * glm::dot(direction_at_angle(at, angle), m_);
          },
          from.t, to.t);
      const WallCircle at = circle(t);
      return WallPoint{t, at, direction_at_angle(at, angle)};
    });
  }

  // What of a path on the wall is outside of the rest of the tube.
  void add_path(const Interval& range, const std::function<WallPoint(double)>& path) {
    const auto is_outside = [&](double s) {
      const WallPoint at = path(s);
      return !tube_.is_cut_off(at.point(), at.t) && !tube_.holds(at.point() + kBesideBalls * size_ * at.normal());
    };
    each_stretch(range, std::max(kTurnPlaces, static_cast<int>(sweep_.cells().size())), is_outside,
                 [&](const Interval& part, bool outside) {
                   if (outside) put(part, path);
                 });
  }

  void put(const Interval& range, const std::function<WallPoint(double)>& path) {
    // By the balls that touch the wall at the path's own places: distances change by the square of what these are off.
    const auto is_on_section = [&](double s, const Vec3& p) {
      const BallJet ball = sweep_.ball(path(s).t);
      return std::abs(glm::dot(p - origin_, m_)) <= kAgreeOnBalls * size_ &&
             std::abs(glm::length(p - ball.center[0]) - ball.radius[0]) <= kAgreeOnBalls * size_;
    };
    const auto point_at = [&](double s) { return path(s).point(); };
    const CurvePtr curve = fitted_line(range, size_, point_at, is_on_section, result_.complete);
    if (!curve) return;
    ShapeOutline line{curve, true, nullptr, {}};
    const auto faces_viewer = [&](double s) {
      const WallPoint at = path(s);
      return glm::dot(at.normal(), view_.central ? at.point() - view_.direction_or_eye : view_.direction_or_eye) < 0;
    };
    each_stretch(range, kTurnPlaces, faces_viewer, [&](const Interval& part, bool) {
      if (part.lo > range.lo) line.turns.push_back(part.lo);
    });
    result_.lines.push_back(std::move(line));
  }

  // The plane's circle on the ball between two pieces of the curve, or at one of its ends.
  void add_ball(std::optional<double> before, std::optional<double> after) {
    const BallJet ball = sweep_.ball(before ? *before : *after);
    const auto circle = circle_of(ball.center[0], ball.radius[0], origin_, m_);
    if (!circle) return;
    for (const Interval& arc : arcs_between(tube_, *circle, before, after)) {
      const auto is_outside = [&](double x) {
        return !tube_.holds(circle->point(x) + kBesideBalls * size_ * circle->normal(x));
      };
      each_stretch(arc, kTurnPlaces, is_outside, [&](const Interval& part, bool outside) {
        if (!outside) return;
        ShapeOutline line{circle->curve(part), true, nullptr, {}};
        add_turns([&](double x) { return circle->normal(x); }, [&](double x) { return circle->point(x); }, view_, part,
                  line.turns);
        result_.lines.push_back(std::move(line));
      });
    }
  }

  // The chords of flat ends.
  void add_ends() {
    for (int side = 0; side < 2; ++side) {
      const Tube::End& end = tube_.end(side);
      const Vec3 along = glm::cross(end.inward, m_), across = glm::cross(along, end.inward);
      const double sine = glm::length(along);
      if (!(sine > 0)) continue;
      // What of the line that both planes have in common is inside, seen a little behind the end; near the end's own
      // ball, as other parts of the tube may reach through its plane.
      const Vec3 middle = end.point + glm::dot(origin_ - end.point, m_) / (sine * sine) * across;
      const Vec3 way = along / sine;
      std::vector<SurfaceHit> hits;
      tube_.all_hits({middle + kAgreeOnBalls * size_ * end.inward, way}, {-kInfinity, kInfinity}, hits);
      const Interval domain = sweep_.curve().domain();
      double reach = 0;
      for (int cell = end.begin; cell < end.end; ++cell)
        reach = std::max(reach, sweep_.ball(sweep_.cells()[static_cast<size_t>(cell)].t.lo).radius[0]);
      reach = std::max(reach, sweep_.ball(side == 0 ? domain.lo : next_down(domain.hi)).radius[0]);
      for (size_t k = 0; k + 1 < hits.size(); k += 2) {
        const Vec3 from = middle + hits[k].t * way, to = middle + hits[k + 1].t * way;
        if (glm::length(0.5 * (from + to) - end.point) > reach) continue;
        const auto is_outside = [&](double x) {
          return !tube_.holds(glm::mix(from, to, x) - kBesideBalls * size_ * end.inward);
        };
        each_stretch({0, 1}, kTurnPlaces, is_outside, [&](const Interval& part, bool outside) {
          if (!outside) return;
          result_.lines.push_back(
              {std::make_shared<Segment>(glm::mix(from, to, part.lo), glm::mix(from, to, part.hi)), true, nullptr, {}});
        });
      }
    }
  }

  const Tube& tube_;
  const BallSweep& sweep_;
  Vec3 origin_, m_;
  Frame frame_;
  const ViewOf& view_;
  double size_;
  ShapeOutlines result_;
};

}  // namespace

ShapeOutlines edge_of_end(const Tube& tube, int side, const ViewOf& view) {
  const Tube::End& end = tube.end(side);
  const auto& cells = tube.sweep().cells();
  if (end.begin >= end.end) return {};
  const Interval range{cells[static_cast<size_t>(end.begin)].t.lo, cells[static_cast<size_t>(end.end - 1)].t.hi};
  // Behind the plane by what lines are told to: on it rounding would cut them off or not.
  const Vec3 origin = end.point + kAgreeOnBalls * tube.bounds().diameter() * end.inward;
  return TubeSection(tube, origin, end.inward, view).find_wall(range);
}

ShapeOutlines plane_section(const Tube& tube, const Vec3& origin, const Vec3& normal, const ViewOf& view) {
  return TubeSection(tube, origin, glm::normalize(normal), view).find();
}

}  // namespace lekalo::geometry
