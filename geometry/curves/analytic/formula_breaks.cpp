// Kinks and steps are where heights over the borders of branches (expression/branches.h) change their sign, poles where
// no halving bounds the point: both by interval arithmetic, which loses none.
#include "geometry/curves/analytic/formula_breaks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/expression/branches.h"
#include "geometry/numerics/halving.h"

namespace lekalo::geometry {

namespace {

// Stretches down to this part of the domain are halved.
constexpr double kNarrowest = 1e-15;
// A height that needs more parts than that keeps to zero, which is no break; a point is not bounded by intervals.
constexpr int kMaxParts = 1 << 14;
// Of the usual distances: what is farther belongs to a pole.
constexpr double kFar = 1e6;
constexpr int kTried = 64;
// Of the usual distances: what changes by more from one number to the next is a step. A cube root changes by less.
constexpr double kStep = 1e-5;

bool is_narrow(const Interval& t, const Interval& domain) {
  return t.width() <= kNarrowest * domain.width() || !can_be_halved(t);
}

// The first parameter after lo where the answer is another than at lo; hi's is.
template <class Answer>
double first_change(const Answer& answer, double lo, double hi) {
  const bool before = answer(lo);
  for (;;) {
    const double middle = 0.5 * lo + 0.5 * hi;
    if (!(lo < middle && middle < hi)) return hi;
    (answer(middle) == before ? lo : hi) = middle;
  }
}

class Breaks {
 public:
  Breaks(const PointFormulas& point, const Interval& domain) : point_(point), domain_(domain) {}

  std::vector<Interval> stretches() {
    add_borders();
    parts_ = 0;
    add_poles(domain_);
    std::vector<Interval> result;
    double begin = domain_.lo;
    const auto end_at = [&](double end, double next) {
      if (end > begin) result.emplace_back(begin, end);
      begin = next;
    };
    std::sort(gaps_.begin(), gaps_.end(), [](const Interval& a, const Interval& b) { return a.lo < b.lo; });
    for (const Interval& gap : gaps_)
      if (gap.hi > begin && gap.lo < domain_.hi) end_at(gap.lo, gap.hi);
    end_at(domain_.hi, domain_.hi);
    if (result.empty()) result.push_back(domain_);
    return result;
  }

 private:
  void add_borders() {
    const std::array ranges{domain_};
    const auto branches = expression_branches(point_.formulas(), ranges);
    if (!branches) return;
    for (const ExpressionBranch& branch : *branches)
      for (const ExpressionBranch::Side& side : branch.sides) {
        parts_ = 0;
        add_zeros(side.height, domain_);
      }
  }

  void add_zeros(const Expression& height, const Interval& t) {
    if (++parts_ > kMaxParts) return;
    const Jet<Interval, 1> h = height(Jet<Interval, 1>::variable(t));
    if (!h.c[0].contains(0)) return;
    if (is_narrow(t, domain_) || !h.c[1].contains(0)) {
      add_border(height, t);
      return;
    }
    add_zeros(height, {t.lo, t.middle()});
    add_zeros(height, {t.middle(), t.hi});
  }

  // Where a height is zero for some numbers a formula may have a value for these alone, or that of either side.
  void add_border(const Expression& height, const Interval& t) {
    const auto is_below = [&](double x) { return height(x) < 0; };
    const auto is_above = [&](double x) { return height(x) > 0; };
    if (is_below(t.lo) == is_below(t.hi) || is_above(t.lo) == is_above(t.hi)) return;
    const double below = first_change(is_below, t.lo, t.hi), above = first_change(is_above, t.lo, t.hi);
    const double first = std::min(below, above), last = std::max(below, above);
    const double before = change(next_down(first), first), after = change(next_down(last), last);
    if (first < last && std::min(before, after) > kStep * usual_distance())
      gaps_.emplace_back(first, last);
    else
      gaps_.push_back(before >= after ? first : last);
  }

  double change(double a, double b) const {
    const Triple<double> p = point_(a), q = point_(b);
    return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
  }

  double distance(double t) const {
    const Triple<double> p = point_(t);
    const double r = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
    return r == r ? r : kInfinity;
  }

  void add_poles(const Interval& t) {
    const Triple<Interval> p = point_(t);
    const double bound = magnitude(p.x) + magnitude(p.y) + magnitude(p.z);
    if (bound < kInfinity || ++parts_ > kMaxParts) return;
    if (!is_narrow(t, domain_)) {
      add_poles({t.lo, t.middle()});
      add_poles({t.middle(), t.hi});
      return;
    }
    const auto is_far = [&](double x) { return distance(x) > kFar * usual_distance(); };
    if (!is_far(t.lo) && !is_far(t.hi) && !is_far(t.middle())) return;
    // Nearest to the pole from either side; the point comes near again before the next one.
    const auto near = [&](double from, double way) {
      double step = t.width() + kNarrowest * domain_.width();
      while (domain_.contains(from + way * step) && is_far(from + way * step)) step *= 2;
      const double to = domain_.clamp(from + way * step);
      return is_far(from) && !is_far(to) ? first_change(is_far, from, to) : is_far(from) ? to : from;
    };
    gaps_.emplace_back(near(is_far(t.lo) ? t.lo : t.middle(), -1), near(is_far(t.hi) ? t.hi : t.middle(), 1));
  }

  double usual_distance() {
    if (usual_ > 0) return usual_;
    std::vector<double> all;
    for (int i = 0; i <= kTried; ++i) all.push_back(distance(domain_.lo + domain_.width() * i / kTried));
    std::nth_element(all.begin(), all.begin() + kTried / 2, all.end());
    return usual_ = std::max(all[kTried / 2], domain_.width());
  }

  const PointFormulas& point_;
  const Interval domain_;
  std::vector<Interval> gaps_;
  int parts_ = 0;
  double usual_ = 0;
};

}  // namespace

std::vector<Interval> smooth_stretches(const PointFormulas& point, const Interval& domain) {
  return Breaks(point, domain).stretches();
}

}  // namespace lekalo::geometry
