#include "geometry/shapes/sign_changes.h"

#include <algorithm>
#include <cmath>

#include "geometry/numerics/jet.h"

namespace lekalo::geometry {

namespace {

constexpr double kSmallestPart = 1e-13;
constexpr int kMostParts = 20000;  // of formulas that oscillate without end; the rest counts as a touch

class Follower {
 public:
  Follower(const ImplicitFormula& formula, const Line& line, double size, SignChanges& changes)
      : formula_(formula),
        line_(line),
        smallest_(kSmallestPart * size / glm::length(line.direction)),
        slopes_(formula.smoothness() != Expression::Smoothness::jumps),
        changes_(changes) {}

  void run(double t0, double t1) {
    if (!changes_.has_begun()) changes_.begin(sign_at(t0));
    Interval stack[64];
    int top = 0;
    stack[0] = {t0, t1};
    for (int parts = 0; top >= 0; ++parts) {
      const Interval part = stack[top--];
      const State state = tell(part, parts > kMostParts || top > 60);
      if (state == State::open) {
        const double middle = part.middle();
        stack[++top] = {middle, part.hi};
        stack[++top] = {part.lo, middle};
      }
      if (changes_.is_done()) return;
    }
    close_cluster(sign_at(t1));
  }

 private:
  enum class State { open, done };

  bool sign_at(double t) const { return is_positive(formula_(line_.at(t))); }

  State tell(const Interval& part, bool last) {
    const auto value = formula_.along(line_, Jet<Interval, 1>::variable(part));
    const double middle = part.middle();
    const Interval at_middle = formula_.along(line_, Interval(middle));
    Interval range = value.c[0];
    if (slopes_) range = intersect(range, at_middle + value.c[1] * (part - middle));
    if (range.lo > 0 || range.hi < 0) {
      close_cluster(range.lo > 0);
      changes_.pass(part.lo, range.lo > 0);
      return State::done;
    }
    if (slopes_ && !value.c[1].contains(0.0)) {
      const bool begin = sign_at(part.lo), end = sign_at(part.hi);
      close_cluster(begin);
      changes_.pass(part.lo, begin);
      if (begin != end) changes_.add(find_zero(formula_, line_, part.lo, part.hi, end, middle));
      return State::done;
    }
    if (!last && part.width() > smallest_ && magnitude(range) > 4 * at_middle.width()) return State::open;
    if (!in_cluster_) cluster_.lo = part.lo;
    cluster_.hi = part.hi;
    in_cluster_ = true;
    return State::done;
  }

  void close_cluster(bool after) {
    if (!in_cluster_) return;
    in_cluster_ = false;
    if (after == changes_.positive()) {
      if (is_jump()) return;
      if (!formula_.has_sheets(line_.at(cluster_.middle()), after)) return;
      changes_.add(cluster_.lo);
      changes_.add(cluster_.hi);
    } else if (is_jump()) {
      changes_.jump(cluster_.middle());
    } else {
      changes_.add(cluster_.middle());
    }
  }

  // At a zero the value shrinks with the distance; at a jump it stays, at a pole it grows.
  bool is_jump() const {
    const double near = std::max(cluster_.width(), smallest_), far = 64 * near, at = cluster_.middle();
    const auto size = [&](double by) {
      return std::abs(formula_(line_.at(at - by))) + std::abs(formula_(line_.at(at + by)));
    };
    return !(size(near) < 0.5 * size(far));
  }

  const ImplicitFormula& formula_;
  const Line& line_;
  double smallest_;
  bool slopes_;  // derivatives tell all
  SignChanges& changes_;
  bool in_cluster_ = false;
  Interval cluster_;
};

}  // namespace

double find_zero(const ImplicitFormula& formula, const Line& line, double lo, double hi, bool rising, double start) {
  const double tolerance = 4e-16 * (hi - lo) + 2e-16 * std::max(std::abs(lo), std::abs(hi));
  double t = std::clamp(start, lo, hi), previous = 0;
  for (int step = 0; step < 200; ++step) {
    const auto value = formula.along(line, Jet<double, 1>::variable(t));
    (is_positive(value.c[0]) == rising ? hi : lo) = t;
    double next = t - value.c[0] / value.c[1];
    const bool is_newtons = lo <= next && next <= hi;
    if (!is_newtons) next = 0.5 * lo + 0.5 * hi;
    const double change = std::abs(next - t);
    t = next;
    // Newton's steps shrink at least as their squares: the one after would be change^3 / previous^2.
    if (change <= tolerance || hi - lo <= tolerance) break;
    if (is_newtons && change < 0.1 * previous && change * change * change <= tolerance * previous * previous) break;
    previous = change;
  }
  return t;
}

void follow_by_intervals(const ImplicitFormula& formula, const Line& line, double t0, double t1, double size,
                         SignChanges& changes) {
  Follower(formula, line, size, changes).run(t0, t1);
}

}  // namespace lekalo::geometry
