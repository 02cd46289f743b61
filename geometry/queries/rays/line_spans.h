// The part of a line inside a union of solids: disjoint spans in order. What solids share is merged as they come, so
// ends inside the union vanish and those that are left alternate in and out.
#pragma once

#include <algorithm>
#include <vector>

namespace lekalo::geometry {

// Where a line enters or leaves: its own parameter, and the place on what it meets.
struct SpanEnd {
  double s = 0;
  double u = 0;
  int piece = 0;
  int face = 0;
};

struct Span {
  SpanEnd in;
  SpanEnd out;
};

class LineSpans {
 public:
  void clear() { spans_.clear(); }
  bool empty() const { return spans_.empty(); }
  auto begin() const { return spans_.begin(); }
  auto end() const { return spans_.end(); }

  void add(Span span) {
    const auto first = std::lower_bound(spans_.begin(), spans_.end(), span.in.s,
                                        [](const Span& one, double s) { return one.out.s < s; });
    auto last = first;
    for (; last != spans_.end() && last->in.s <= span.out.s; ++last) {
      if (last->in.s <= span.in.s) span.in = last->in;
      if (last->out.s >= span.out.s) span.out = last->out;
    }
    if (first == last) {
      spans_.insert(first, span);
    } else {
      *first = span;
      spans_.erase(first + 1, last);
    }
  }

  // True if everything from lo to hi is inside one span, but for `slack` at either end.
  bool cover(double lo, double hi, double slack) const {
    return std::any_of(spans_.begin(), spans_.end(),
                       [&](const Span& one) { return one.in.s <= lo + slack && one.out.s >= hi - slack; });
  }

 private:
  std::vector<Span> spans_;
};

}  // namespace lekalo::geometry
