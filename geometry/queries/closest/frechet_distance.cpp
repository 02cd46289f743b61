#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/queries/closest/continuous_curve.h"
#include "geometry/queries/closest/curve_nearness.h"

namespace lekalo::geometry {

namespace {

// Points of a polyline, at most; halvings of a smooth piece.
constexpr size_t kMaxPoints = 40000, kManyPoints = 8000;  // with so many it is not made finer
constexpr int kMaxHalvings = 40;

struct Polyline {
  std::vector<Vec3> points;
  double deviation = 0;  // of the curve at the same parameter
};

// |r(t) - chord(t)| <= h^2/8 max |r''|; where that is not bounded, both lie in one box.
double chord_deviation(const Curve& curve, const Interval& t) {
  const CurveEnclosure over = curve.enclose(t, 2);
  const auto largest = [](const Box3& box) {
    return box.bounded() ? glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi))) : kInfinity;
  };
  const double by_bend = t.width() * t.width() / 8 * largest(over.d[2]);
  return std::min(by_bend, over.d[0].bounded() ? over.d[0].diameter() : kInfinity);
}

void add_parts(const Curve& curve, const Interval& t, double wanted, int halvings, Polyline& line) {
  const double deviation = chord_deviation(curve, t), middle = t.middle();
  if (deviation > wanted && halvings < kMaxHalvings && line.points.size() < kMaxPoints && t.lo < middle &&
      middle < t.hi) {
    add_parts(curve, {t.lo, middle}, wanted, halvings + 1, line);
    add_parts(curve, {middle, t.hi}, wanted, halvings + 1, line);
    return;
  }
  line.deviation = std::max(line.deviation, deviation);
  line.points.push_back(curve.point(t.hi));
}

Polyline polyline_of(const Curve& curve, double wanted) {
  Polyline line;
  line.points.push_back(curve.point(curve.domain().lo));
  for (const CurvePiece& piece : curve.pieces()) add_parts(curve, piece.domain, wanted, 0, line);
  return line;
}

// The part of a side from p to q that is no farther than `epsilon` from a point; empty: lo > hi.
struct Free {
  double lo = 1, hi = 0;
  bool empty() const { return lo > hi; }
};
Free free_part(const Vec3& point, const Vec3& p, const Vec3& q, double epsilon) {
  const Vec3 side = q - p, from = p - point;
  const double a = glm::dot(side, side), b = glm::dot(side, from), c = glm::dot(from, from) - epsilon * epsilon;
  if (a == 0) return c <= 0 ? Free{0, 1} : Free{};
  const double d = b * b - a * c;
  if (d < 0) return {};
  const double root = std::sqrt(d);
  const Free part{std::max(0.0, (-b - root) / a), std::min(1.0, (-b + root) / a)};
  return part.hi < 0 || part.lo > 1 ? Free{} : part;
}

double squared(const Vec3& v) { return glm::dot(v, v); }

std::vector<double> lengths_of_sides(const std::vector<Vec3>& points) {
  std::vector<double> lengths;
  for (size_t i = 0; i + 1 < points.size(); ++i) lengths.push_back(glm::length(points[i + 1] - points[i]));
  return lengths;
}

// The free-space diagram of two polylines (Alt, Godau 1995), row by row.
class FreeSpace {
 public:
  FreeSpace(const std::vector<Vec3>& p, const std::vector<Vec3>& q, double epsilon)
      : p_(p), q_(q), p_sides_(lengths_of_sides(p)), q_sides_(lengths_of_sides(q)), epsilon_(epsilon) {}

  // Whether a monotone way leads through it from corner to corner: what of each cell's lower and left sides can be
  // reached.
  bool has_way() {
    const size_t n = p_.size() - 1, m = q_.size() - 1;
    std::vector<double> row = squares(0), next;
    if (row.front() > epsilon_ * epsilon_ || squared(p_.back() - q_.back()) > epsilon_ * epsilon_) return false;
    std::vector<Free> lower(n);
    for (size_t i = 0; i < n && (i == 0 || lower[i - 1].hi >= 1); ++i) {
      lower[i] = side(q_[0], p_[i], p_[i + 1], row[i], row[i + 1], p_sides_[i]);
      if (lower[i].lo > 0) lower[i] = {};
    }
    bool left_begins = true;  // the left border is reached up to here
    for (size_t j = 0; j < m; ++j, row.swap(next)) {
      next = squares(j + 1);
      Free left = left_begins ? side(p_[0], q_[j], q_[j + 1], row[0], next[0], q_sides_[j]) : Free{};
      if (left.lo > 0) left = {};
      left_begins = !left.empty() && left.hi >= 1;
      bool any = left_begins;
      for (size_t i = 0; i < n; ++i) {
        Free& below = lower[i];
        if (left.empty() && below.empty()) continue;
        Free right = side(p_[i + 1], q_[j], q_[j + 1], row[i + 1], next[i + 1], q_sides_[j]);
        Free above = side(q_[j + 1], p_[i], p_[i + 1], next[i], next[i + 1], p_sides_[i]);
        if (below.empty()) right.lo = std::max(right.lo, left.lo);
        if (left.empty()) above.lo = std::max(above.lo, below.lo);
        any = any || !above.empty();
        below = above, left = right;
      }
      if (!any) return false;
    }
    return !lower[n - 1].empty() && lower[n - 1].hi >= 1;
  }

 private:
  std::vector<double> squares(size_t j) const {
    std::vector<double> result;
    result.reserve(p_.size());
    for (const Vec3& point : p_) result.push_back(squared(point - q_[j]));
    return result;
  }

  // Most sides lie in the ball of radius epsilon about the point, or far outside of it.
  Free side(const Vec3& point, const Vec3& a, const Vec3& b, double square_a, double square_b, double length) const {
    if (square_a <= epsilon_ * epsilon_ && square_b <= epsilon_ * epsilon_) return {0, 1};
    const double far = (epsilon_ + length) * (1 + 1e-12);
    return square_a > far * far ? Free{} : free_part(point, a, b, epsilon_);
  }

  const std::vector<Vec3>&p_, &q_;
  std::vector<double> p_sides_, q_sides_;
  double epsilon_;
};

}  // namespace

Nearness frechet_distance(const Curve& a, const Curve& b) {
  demand_continuous(a), demand_continuous(b);
  const Box3 box_a = bounds(a), box_b = bounds(b);
  const double size = std::max(box_a.diameter(), box_b.diameter());
  const auto ends_apart = [&](double Interval::*end) {
    return glm::length(a.point(a.domain().*end) - b.point(b.domain().*end));
  };
  Nearness result;
  result.lower = std::max(ends_apart(&Interval::lo), ends_apart(&Interval::hi));
  result.lower =
      std::max(result.lower, hausdorff_distance(CurvePtr(CurvePtr(), &a), CurvePtr(CurvePtr(), &b), 500).lower);
  Box3 both = box_a;
  both.include(box_b.lo), both.include(box_b.hi);
  result.upper = both.diameter();
  for (double wanted = 0.02 * size;; wanted /= 4) {
    const Polyline p = polyline_of(a, wanted), q = polyline_of(b, wanted);
    const double deviation = (p.deviation + q.deviation) * (1 + 1e-15);
    // Of the polylines; the bracket of the curves is wider by the deviation.
    double lo = std::max(0.0, result.lower - deviation), hi = result.upper + deviation;
    while (hi - lo > std::max({0.1 * deviation, 0.2 * kNearness * hi, 1e-15 * size})) {
      const double middle = 0.5 * (lo + hi);
      if (!(lo < middle && middle < hi)) break;
      (FreeSpace(p.points, q.points, middle).has_way() ? hi : lo) = middle;
    }
    result.lower = std::max(result.lower, lo - deviation);
    result.upper = std::max(result.lower, std::min(result.upper, hi + deviation));
    const bool finest = std::max(p.points.size(), q.points.size()) >= kManyPoints;
    if (result.upper - result.lower <= kNearness * result.upper || finest || deviation <= 1e-14 * size) return result;
  }
}

}  // namespace lekalo::geometry
