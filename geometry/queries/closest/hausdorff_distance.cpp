#include <algorithm>
#include <cmath>
#include <queue>
#include <stdexcept>

#include "geometry/queries/closest/closest_point.h"
#include "geometry/queries/closest/continuous_curve.h"
#include "geometry/queries/closest/curve_nearness.h"

namespace lekalo::geometry {

namespace {

// Distances below this part of the size need not be told apart.
constexpr double kSmall = 1e-8;
constexpr double kRounding = 1e-15;

double farthest(const Box3& box, const Vec3& from) {
  return box.bounded() ? glm::length(glm::max(glm::abs(box.lo - from), glm::abs(box.hi - from))) : kInfinity;
}

Box3 over(const Box3& a, double k, const Box3& b) {  // a - k b
  Box3 result;
  for (int i = 0; i < 3; ++i) {
    const Interval x = along(a, i) - Interval(k) * along(b, i);
    result.lo[i] = x.lo, result.hi[i] = x.hi;
  }
  return result;
}

// Farthest points of a curve from another.
class Search {
 public:
  Search(const Curve& a, const CurvePtr& b, int max_parts) : a_(a), b_(*b), projector_(b), max_parts_(max_parts) {}

  struct Found {
    double lower = 0, upper = 0, t = 0;
    Vec3 point{0}, nearest{0};
  };

  // `good`: what is not above this need not be known better.
  Found run(double good) {
    for (const CurvePiece& piece : a_.pieces()) add(piece.domain, kInfinity, look_at(piece.domain.middle()).t, good);
    for (const double t : {a_.domain().lo, a_.domain().hi}) look_at(t);
    int parts = 0;
    while (!parts_.empty() && parts_.top().upper > enough(good) && ++parts < max_parts_) {
      const Part part = parts_.top();
      parts_.pop();
      const double middle = part.t.middle();
      if (!(part.t.lo < middle && middle < part.t.hi)) {
        rest_ = std::max(rest_, part.upper);
        continue;
      }
      add({part.t.lo, middle}, part.upper, part.foot, good);
      add({middle, part.t.hi}, part.upper, part.foot, good);
    }
    found_.upper = std::max({found_.lower, rest_, parts_.empty() ? 0.0 : parts_.top().upper});
    return found_;
  }

 private:
  struct Part {
    double upper;
    Interval t;
    double foot;  // on the other curve, of the part's middle
    bool operator<(const Part& other) const { return upper < other.upper; }
  };

  double enough(double good) const { return std::max(good, found_.lower * (1 + 0.9 * kNearness)); }

  CurveFootPoint look_at(double t) {
    const Vec3 point = a_.point(t);
    const CurveFootPoints feet = projector_.foot_points(point);
    if (feet.foot_points.empty()) throw std::invalid_argument("a curve has no nearest point");
    const CurveFootPoint foot = feet.foot_points.front();
    if (foot.distance > found_.lower)
      found_.lower = foot.distance, found_.t = t, found_.point = point, found_.nearest = foot.point;
    return foot;
  }

  // A foot point by Newton's iteration from one that lies beside it; there may be a nearer one elsewhere.
  CurveFootPoint foot_beside(const Vec3& point, double from) const {
    constexpr int kSteps = 6;
    const Interval domain = b_.domain();
    double s = from;
    CurveJet at = b_.evaluate(s, 2);
    for (int step = 0; step < kSteps; ++step) {
      const Vec3 way = at.d[0] - point;
      const double square_of_speed = glm::dot(at.d[1], at.d[1]), slope = square_of_speed + glm::dot(way, at.d[2]);
      const double next = domain.clamp(s - glm::dot(way, at.d[1]) / (slope > 0 ? slope : square_of_speed));
      const bool is_there = std::abs(next - s) <= 1e-14 * domain.width();
      s = next;
      at = b_.evaluate(s, 2);
      if (is_there) break;
    }
    return {s, at.d[0], glm::length(at.d[0] - point), FootPointKind::minimum};
  }

  // `foot_of_whole`: where that of the part's whole was. All foot points are looked for only where the one beside that
  // is so far off that the point may be the farthest.
  void add(const Interval& t, double upper, double foot_of_whole, double good) {
    const double middle = t.middle();
    const Vec3 point = a_.point(middle);
    CurveFootPoint foot = foot_beside(point, foot_of_whole);
    const double near = std::max(good * (1 - 0.3 * kNearness), found_.lower * (1 + 0.3 * kNearness));
    if (!(foot.distance <= near)) foot = look_at(middle);
    const CurveEnclosure over_part = a_.enclose(t, 1);
    upper = std::min({upper, foot.distance + farthest(over_part.d[0], point), beside(t, over_part.d[1], point, foot)});
    parts_.push({upper * (1 + kRounding), t, foot.t});
  }

  // By |A(t) - B(s + k (t - m))| over the part, k so that both run side by side, or 0 at a corner of B.
  double beside(const Interval& t, const Box3& slope_of_a, const Vec3& point, const CurveFootPoint& foot) const {
    const Vec3 a1 = evaluate_within(a_, t, t.middle(), 1).d[1], b1 = b_.evaluate(foot.t, 1).d[1];
    const double square_of_speed = glm::dot(b1, b1);
    const double k = square_of_speed > 0 ? glm::dot(a1, b1) / square_of_speed : 0;
    return std::min(beside(t, slope_of_a, point, foot, 0),
                    std::isfinite(k) ? beside(t, slope_of_a, point, foot, k) : kInfinity);
  }

  // w + F' (t - m), where w . F' is small if w lies across both curves.
  double beside(const Interval& t, const Box3& slope_of_a, const Vec3& point, const CurveFootPoint& foot,
                double k) const {
    const double half = 0.5 * t.width() * (1 + 1e-15);
    const Interval s(foot.t - std::abs(k) * half, foot.t + std::abs(k) * half);
    if (k != 0 && (s.lo < b_.domain().lo || s.hi > b_.domain().hi)) return kInfinity;
    const Box3 slope = over(slope_of_a, k, k == 0 ? Box3{Vec3(0), Vec3(0)} : b_.enclose(s, 1).d[1]);
    if (!slope.bounded()) return kInfinity;
    const Vec3 w = point - foot.point;
    Interval along_w(0);
    for (int i = 0; i < 3; ++i) along_w += Interval(w[i]) * along(slope, i);
    const double growth = std::max(std::abs(along_w.lo), std::abs(along_w.hi));
    return std::sqrt(foot.distance * foot.distance + 2 * half * growth + half * half * square(slope).hi);
  }

  const Curve& a_;
  const Curve& b_;
  CurveProjector projector_;
  int max_parts_;
  std::priority_queue<Part> parts_;
  Found found_;
  double rest_ = 0;  // of parts that are not halved further
};

}  // namespace

HausdorffDistance hausdorff_distance(const CurvePtr& a, const CurvePtr& b, int max_parts) {
  demand_continuous(*a), demand_continuous(*b);
  const double small = kSmall * std::max(bounds(*a).diameter(), bounds(*b).diameter());
  const Search::Found of_a = Search(*a, b, max_parts).run(small),
                      of_b = Search(*b, a, max_parts).run(std::max(small, of_a.lower));
  const bool first = of_a.lower >= of_b.lower;
  const Search::Found& far = first ? of_a : of_b;
  HausdorffDistance result;
  result.lower = far.lower, result.upper = std::max(of_a.upper, of_b.upper);
  result.of_first = first, result.t = far.t, result.point = far.point, result.nearest = far.nearest;
  return result;
}

}  // namespace lekalo::geometry
