#include "geometry/shapes/implicit/sign_changes.h"

#include <algorithm>
#include <cmath>

#include "geometry/numerics/jet.h"

namespace lekalo::geometry {

namespace {

constexpr double kSmallestPart = 1e-13;
// Of formulas that oscillate without end. After that many parts the smallest ones double with each kCoarser further, so
// that what lies behind still gets its share.
constexpr int kMaxParts = 5000, kCoarser = 200;

bool is_bounded(const Interval& range) { return std::isfinite(range.lo) && std::isfinite(range.hi); }

class Follower {
 public:
  Follower(const ImplicitFormula& formula, const Line& line, double size, SignChanges& changes)
      : formula_(formula),
        line_(line),
        smallest_(kSmallestPart * size / glm::length(line.direction)),
        slopes_(formula.smoothness() != Expression::Smoothness::jumps),
        changes_(changes) {}

  void run(double t0, double t1) {
    if (const double begin = value_at(t0); !changes_.has_begun() && !std::isnan(begin))
      changes_.begin(is_positive(begin));
    Interval stack[64];
    int top = 0;
    stack[0] = {t0, t1};
    for (int parts = 0; top >= 0; ++parts) {
      const Interval part = stack[top--];
      const double coarser = std::exp2(std::max(0, parts - kMaxParts) / kCoarser);
      const State state = tell(part, top > 60 ? kInfinity : coarser * smallest_);
      if (state == State::open) {
        const double middle = part.middle();
        stack[++top] = {middle, part.hi};
        stack[++top] = {part.lo, middle};
      }
      if (changes_.is_done()) return;
    }
    if (!in_cluster_) return;
    if (const double end = value_at(t1); !std::isnan(end)) go_on(t1, is_positive(end));
  }

 private:
  enum class State { open, done };

  double value_at(double t) const { return formula_(line_.at(t)); }

  // Parts of the width `least` or less are not halved further.
  State tell(const Interval& part, double least) {
    const auto value = formula_.along(line_, Jet<Interval, 1>::variable(part));
    const double middle = part.middle();
    const Interval at_middle = formula_.along(line_, Interval(middle));
    Interval range = value.c[0];
    if (slopes_) range = intersect(range, at_middle + value.c[1] * (part - middle));
    if (range.lo > 0 || range.hi < 0) {
      go_on(part.lo, range.lo > 0);
      return State::done;
    }
    // Only what is bounded with its slope is continuous: beside a pole slopes may have one sign, too (tan).
    if (slopes_ && is_bounded(value.c[0]) && is_bounded(value.c[1]) && !value.c[1].contains(0.0)) {
      const bool begin = is_positive(value_at(part.lo)), end = is_positive(value_at(part.hi));
      go_on(part.lo, begin);
      if (begin != end) changes_.add(find_zero(formula_, line_, part.lo, part.hi, end, middle));
      return State::done;
    }
    const bool is_rounding = magnitude(range) <= 4 * at_middle.width();
    if (!is_rounding && part.width() > least) return State::open;
    if (!in_cluster_) {
      cluster_.lo = part.lo;
      is_told_ = true;
    }
    cluster_.hi = part.hi;
    in_cluster_ = true;
    is_told_ = is_told_ && (is_rounding || part.width() <= smallest_);
    return State::done;
  }

  // The sign from t on. What lies between it and another one before may be a jump or a pole.
  void go_on(double t, bool positive) {
    if (!changes_.has_begun()) changes_.begin(positive);
    if (!in_cluster_) {
      if (positive == changes_.positive()) return;
      cluster_ = t;
      is_told_ = true;
    }
    close_cluster(positive);
  }

  void close_cluster(bool after) {
    in_cluster_ = false;
    const double reach = is_told_ ? std::max(cluster_.width(), smallest_) : smallest_;
    if (after == changes_.positive()) {
      if (!is_told_ || is_jump(cluster_.middle(), reach)) return;
      if (!formula_.has_sheets(line_.at(cluster_.middle()), after)) return;
      changes_.add(cluster_.lo);
      changes_.add(cluster_.hi);
      return;
    }
    const double t = change_in_cluster(after);
    if (is_jump(t, reach))
      changes_.jump(t);
    else
      changes_.add(t);
  }

  // Where the computed sign changes, to the last digit: beside infinite slopes a hit has no better place.
  double change_in_cluster(bool after) const {
    double lo = cluster_.lo, hi = cluster_.hi;
    while (true) {
      const double middle = 0.5 * lo + 0.5 * hi;
      if (!(lo < middle && middle < hi)) return middle;
      (is_positive(value_at(middle)) == after ? hi : lo) = middle;
    }
  }

  // At a zero the value shrinks as a power p of the distance, by 64^p here; at a jump it stays, at a pole it grows.
  bool is_jump(double t, double near) const {
    constexpr double kStays = 0.9;  // p < 1/40
    const auto size = [&](double by) { return std::abs(value_at(t - by)) + std::abs(value_at(t + by)); };
    return !(size(near) < kStays * size(64 * near));
  }

  const ImplicitFormula& formula_;
  const Line& line_;
  double smallest_;
  bool slopes_;  // derivatives tell all
  SignChanges& changes_;
  bool in_cluster_ = false;
  Interval cluster_;
  bool is_told_ = true;  // no part of the cluster was given up before its time
};

}  // namespace

double find_zero(const ImplicitFormula& formula, const Line& line, double lo, double hi, bool rising, double start) {
  const double tolerance = 4e-16 * (hi - lo) + 2e-16 * std::max(std::abs(lo), std::abs(hi));
  constexpr int kMaxSteps = 400, kHalvedEach = 8;  // so that any bracket closes
  const auto narrow = [&](double t, double value) { (is_positive(value) == rising ? hi : lo) = t; };
  double t = std::clamp(start, lo, hi);
  double previous = 0;  // the step before if it was Newton's
  for (int step = 1; step <= kMaxSteps && hi - lo > tolerance; ++step) {
    const auto value = formula.along(line, Jet<double, 1>::variable(t));
    if (value.c[0] == 0) return t;
    narrow(t, value.c[0]);
    const double next = t - value.c[0] / value.c[1], change = std::abs(next - t);
    if (!std::isfinite(value.c[1]) || !(lo <= next && next <= hi) || step % kHalvedEach == 0) {
      t = 0.5 * lo + 0.5 * hi;
      previous = 0;
      continue;
    }
    // Newton's steps shrink at least as their squares: the one after would be change^3 / previous^2.
    if (change < 0.1 * previous && change * change * change <= tolerance * previous * previous) return next;
    previous = change;
    t = next;
    if (change > tolerance) continue;
    // A small step is no proof: beside an infinite slope all steps are. The other sign must be as near.
    const double beyond = std::clamp(t + (t - lo < hi - t ? tolerance : -tolerance), lo, hi);
    narrow(beyond, formula(line.at(beyond)));
    t = 0.5 * lo + 0.5 * hi;
    previous = 0;
  }
  return t;
}

void follow_by_intervals(const ImplicitFormula& formula, const Line& line, double t0, double t1, double size,
                         SignChanges& changes) {
  Follower(formula, line, size, changes).run(t0, t1);
}

}  // namespace lekalo::geometry
