// The oracle of implicit surfaces: where a function changes its sign on a line, found by halving alone.
//
// It shares nothing with the product's solver: a part of the line is discarded only if the function's enclosure by
// interval arithmetic excludes zero, parts shorter than 1e-9 of the whole that remain are gathered into clusters, and
// the signs in 113 bits at a cluster's ends tell whether there is a zero, which is then halved down to. No Newton
// iteration, no derivative.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/numerics/interval.h"
#include "geometry/quad.h"
#include "geometry/vectors.h"

namespace lekalo::oracle {

using geometry::Interval;
using geometry::Line;

// F() is a function of three numbers of type T: Interval, Quad.
template <class F>
class SignOracle {
 public:
  struct Answer {
    std::vector<double> t;
    bool doubtful = false;  // something touches, or nearly
  };
  Answer ask(const Line& line, double t0, double t1) {
    line_ = line;
    cells_.clear();
    // Not below what doubles tell apart so far from the line's origin.
    halve(t0, t1, std::max(1e-9 * (t1 - t0), 1e-15 * std::max(std::abs(t0), std::abs(t1))));
    Answer answer;
    for (size_t first = 0, last; first < cells_.size(); first = last) {
      for (last = first + 1; last < cells_.size() && cells_[last].lo == cells_[last - 1].hi;) ++last;
      Quad lo = cells_[first].lo, hi = cells_[last - 1].hi;
      const bool begins = at(lo) > Quad(0), ends = at(hi) > Quad(0);
      answer.doubtful = answer.doubtful || begins == ends || cells_[first].lo == t0 || cells_[last - 1].hi == t1;
      if (begins == ends) continue;
      for (int step = 0; step < 60; ++step) {
        const Quad middle = (lo + hi) * Quad(0.5);
        ((at(middle) > Quad(0)) == ends ? hi : lo) = middle;
      }
      answer.t.push_back(static_cast<double>(lo));
    }
    return answer;
  }
  double slope(double t) const {
    const Quad h = 1e-10;
    return static_cast<double>((at(Quad(t) + h) - at(Quad(t) - h)) / (Quad(2.0) * h));
  }

 private:
  template <class T>
  T along(const T& t) const {
    return F()(T(line_.origin.x) + t * T(line_.direction.x), T(line_.origin.y) + t * T(line_.direction.y),
               T(line_.origin.z) + t * T(line_.direction.z));
  }
  Quad at(const Quad& t) const { return along(t); }
  void halve(double lo, double hi, double smallest) {
    if (!along(Interval(lo, hi)).contains(0.0)) return;
    if (hi - lo < smallest) {
      cells_.push_back({lo, hi});
      return;
    }
    const double middle = 0.5 * (lo + hi);
    halve(lo, middle, smallest);
    halve(middle, hi, smallest);
  }

  Line line_;
  std::vector<Interval> cells_;
};

}  // namespace lekalo::oracle
