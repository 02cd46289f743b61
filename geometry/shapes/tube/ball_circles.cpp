#include "geometry/shapes/tube/ball_circles.h"

#include "geometry/curves/splines/polynomial_approximation.h"

namespace lekalo::geometry {

namespace {

constexpr double kShallow = 0.7;      // |k| down to which angles tell points near joins
constexpr double kShallowest = 0.99;  // of bulges on which |k| falls less than half as far angles tell nothing
constexpr int kPlacesOfArc = 64;
constexpr double kAgreeInPace = 1e-9;  // of the size

}  // namespace

CurvePtr BallCircle::curve(const Interval& t) const {
  Frame at = frame;
  at.origin = center + radius * k * frame.z;
  return std::make_shared<Circle>(at, radius * s, t);
}

CurvePtr BallCircle::outward_offset(const Interval& t) const {
  Frame at = frame;
  at.origin = k * frame.z;
  return std::make_shared<Circle>(at, s, t);
}

std::optional<BallCircle> circle_of(const Vec3& center, double radius, const ViewOf& view) {
  if (!view.central) return BallCircle{center, radius, frame_about(Vec3(0), view.direction_or_eye), 0, 1};
  const Vec3 away = center - view.direction_or_eye;
  const double distance = glm::length(away);
  if (!(distance > radius)) return std::nullopt;
  const double k = -radius / distance;
  return BallCircle{center, radius, frame_about(Vec3(0), away / distance), k, std::sqrt(1 - k * k)};
}

std::optional<BallCircle> circle_of(const Vec3& center, double radius, const Vec3& origin, const Vec3& normal) {
  const double k = glm::dot(origin - center, normal) / radius, square = 1 - k * k;
  if (!(square > 0)) return std::nullopt;
  return BallCircle{center, radius, frame_about(Vec3(0), normal), k, std::sqrt(square)};
}

void Condition::add_roots(std::vector<double>& roots) const {
  const double size = std::hypot(a, b);
  if (!(std::abs(c) < size)) return;
  const double middle = std::atan2(b, a), half = std::acos(-c / size);
  for (const double t : {middle - half, middle + half}) roots.push_back(t - kTwoPi * std::floor(t / kTwoPi));
}

Condition condition(const std::function<double(double)>& value) {
  const double at_0 = value(0), at_half = value(kPi), at_quarter = value(0.5 * kPi);
  const double c = 0.5 * (at_0 + at_half);
  return {at_0 - c, at_quarter - c, c};
}

std::vector<Interval> kept(const std::vector<Condition>& conditions) {
  std::vector<double> cuts;
  for (const Condition& one : conditions) {
    if (!(std::abs(one.c) < std::hypot(one.a, one.b)) && one.c < 0) return {};
    one.add_roots(cuts);
  }
  if (cuts.empty()) return {{0, kTwoPi}};
  std::sort(cuts.begin(), cuts.end());
  cuts.push_back(cuts.front() + kTwoPi);
  std::vector<Interval> result;
  for (size_t k = 0; k + 1 < cuts.size(); ++k) {
    const Interval t{cuts[k], cuts[k + 1]};
    const auto holds = [&](const Condition& one) { return one.at(t.middle()) >= 0; };
    if (t.width() > kSameOnBalls && std::all_of(conditions.begin(), conditions.end(), holds)) result.push_back(t);
  }
  return result;
}

bool is_corner(const BallSweep& sweep, double before, double after) {
  const Vec3 a = sweep.ball(before).center[1], b = sweep.ball(after).center[1];
  return !(glm::length(glm::normalize(a) - glm::normalize(b)) < kCorner);
}

bool is_straight_corner(const BallSweep& sweep, double before, double after) {
  const auto is_straight = [&](double t) {
    const BallJet at = sweep.ball(t);
    return glm::length(glm::cross(at.center[1], at.center[2])) < kSameOnBalls * glm::dot(at.center[1], at.center[1]) &&
           at.radius[1] == 0;
  };
  return is_straight(before) && is_straight(after);
}

std::vector<Interval> arcs_between(const Tube& tube, const BallCircle& circle, std::optional<double> before,
                                   std::optional<double> after) {
  std::vector<Condition> conditions;
  if (before != after) {
    for (const auto& [end, sign] : {std::pair(before, 1.0), std::pair(after, -1.0)}) {
      if (!end) continue;
      const BallJet at = tube.sweep().ball(*end);
      conditions.push_back(condition(
          [&, sign = sign](double x) { return sign * (glm::dot(circle.normal(x), at.center[1]) + at.radius[1]); }));
    }
    for (int side = 0; side < 2; ++side)
      if (tube.caps() != Caps::round && (side == 0 ? !before : !after)) {
        const Tube::End& end = tube.end(side);
        conditions.push_back(condition([&](double x) { return glm::dot(circle.point(x) - end.point, end.inward); }));
      }
  }
  return kept(conditions);
}

std::vector<Interval> arcs_outside(const Balls& balls, const std::array<size_t, 2>& on,
                                   const std::function<Vec3(double)>& point, std::vector<Condition> conditions) {
  balls.near(on[0], [&](size_t k) {
    if (k == on[0] || k == on[1]) return;
    const Balls::Ball& ball = balls.balls()[k];
    conditions.push_back(condition([&](double x) {
      const Vec3 from = point(x) - ball.center;
      return glm::dot(from, from) - ball.radius * ball.radius;
    }));
  });
  return kept(conditions);
}

bool grows_inward(const BallJet& ball, int side) {
  return (side == 0 ? 1 : -1) * ball.radius[1] > kSameOnBalls * glm::length(ball.center[1]);
}

void add_turns(const std::function<Vec3(double)>& normal, const std::function<Vec3(double)>& point, const ViewOf& view,
               const Interval& range, std::vector<double>& turns) {
  std::vector<double> roots;
  condition([&](double t) {
    return glm::dot(normal(t), view.central ? point(t) - view.direction_or_eye : view.direction_or_eye);
  }).add_roots(roots);
  for (const double root : roots)
    for (const double t : {root, root + kTwoPi})
      if (range.contains(t)) turns.push_back(t);
}

double zero_between(const std::function<double(double)>& value, double a, double b) {
  double at_a = value(a);
  const double at_b = value(b);
  if ((at_a > 0) == (at_b > 0)) return std::abs(at_a) < std::abs(at_b) ? a : b;
  double lo = a, hi = b, t = a, before = b, now = at_a, then = at_b;
  if (lo > hi) std::swap(lo, hi), at_a = at_b;
  constexpr int kSteps = 200, kHalve = 8;
  for (int step = 1; step < kSteps && now != 0; ++step) {
    double next = t - now * (before - t) / (then - now);
    if (!(next > lo && next < hi) || step % kHalve == 0) next = 0.5 * (lo + hi);
    if (!(next > lo && next < hi) || next == t) break;
    before = t, then = now;
    t = next, now = value(t);
    ((now > 0) == (at_a > 0) ? lo : hi) = t;
  }
  return t;
}

std::vector<WallPath> wall_paths(const Interval& t, bool joins_lo, bool joins_hi,
                                 const std::function<double(double)>& share) {
  const auto by_t = [share](double at, double sign) {
    const double k = std::clamp(share(at), -1.0, 1.0);
    return WallPlace{at, k, sign * std::sqrt(1 - k * k)};
  };
  // From a join where |k| is down to that, or half way down to its first least value, if that is more.
  struct ArcEnd {
    double t, k;
  };
  const auto end_of_arc = [&](double from, double to) -> std::optional<ArcEnd> {
    const auto at = [&](int i) { return from + (to - from) * i / kPlacesOfArc; };
    const auto size_of = [&](double x) { return std::abs(share(x)); };
    double least = 1;
    int last = 0;
    while (last + 1 < kPlacesOfArc && least > kShallow && size_of(at(last + 1)) < least) least = size_of(at(++last));
    const double told = std::max(kShallow, 0.5 * (1 + least));
    if (told > kShallowest) return std::nullopt;
    return ArcEnd{zero_between([&](double x) { return size_of(x) - told; }, from, at(last)), told};
  };
  std::vector<WallPath> paths;
  const std::optional<ArcEnd> lo = joins_lo ? end_of_arc(t.lo, t.hi) : ArcEnd{t.lo, 1},
                              hi = joins_hi ? end_of_arc(t.hi, t.lo) : ArcEnd{t.hi, 1};
  if (!lo || !hi) {
    // One smooth curve by the root of the distance from where they join; there rounding would leave them apart.
    const auto place = [=](double at, double sign) {
      at = t.clamp(at);
      if ((at == t.lo && joins_lo) || (at == t.hi && joins_hi)) return WallPlace{at, share(at) > 0 ? 1.0 : -1.0, 0};
      return by_t(at, sign);
    };
    if (joins_lo && joins_hi)
      paths.push_back({{0, kTwoPi}, [=](double s) {
                         return place(t.middle() - 0.5 * t.width() * std::cos(s), s <= kPi ? 1.0 : -1.0);
                       }});
    else
      paths.push_back({{-1, 1}, [=](double s) {
                         return place(joins_lo ? t.lo + t.width() * s * s : t.hi - t.width() * s * s,
                                      s >= 0 ? 1.0 : -1.0);
                       }});
    return paths;
  }
  const auto add_arc = [&](double from, const ArcEnd& to) {
    const double sign = share(from) > 0 ? 1 : -1, angle = std::acos(to.k);
    paths.push_back(
        {{-angle, angle}, [=](double s) {
           const double k = sign * std::cos(s);
           return WallPlace{zero_between([&](double x) { return share(x) - k; }, from, to.t), k, std::sin(s)};
         }});
  };
  if (joins_lo) add_arc(t.lo, *lo);
  if (joins_hi) add_arc(t.hi, *hi);
  if (lo->t < hi->t)
    for (const double sign : {1.0, -1.0}) paths.push_back({{lo->t, hi->t}, [=](double s) { return by_t(s, sign); }});
  return paths;
}

CurvePtr fitted_line(const Interval& range, double size, const std::function<Vec3(double)>& point_at,
                     const std::function<bool(double, const Vec3&)>& is_on_line, bool& complete) {
  const std::array<Interval, 1> whole{range};
  if (auto curve = polynomial_approximation(point_at, whole, kAgreeOnBalls * size)) return curve;
  const OwnPace pace{kAgreeInPace * size, is_on_line};
  if (auto curve = polynomial_approximation(point_at, whole, kAgreeOnBalls * size, &pace)) return curve;
  complete = false;
  return polynomial_approximation(point_at, whole, kAgreeInPace * size);
}

}  // namespace lekalo::geometry
