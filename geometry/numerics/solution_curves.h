// All curves of solutions of N - 1 equations in N unknowns in a box of parameters, certified by interval arithmetic
// (Krawczyk's operator with one unknown as the parameter: Moore, Kearfott, Cloud 2009, chapter 8; tracing: Golovanov
// 2016, 4.8; Patrikalakis, Maekawa 2002, chapter 5).
//
// With the unknown x_a for the parameter and C about the inverse of the derivatives by the others, every solution in a
// box X with x_a in I satisfies
//
//   y in y0 - C F(c, y0) - C F_a(X) (I - c) + (I - C F_y(X)) (Y - y0),   c the middle of I.
//
// Where the rows of I - C F_y(X), weighed with the sides of X, sum up to less than 1 there is at most one solution for
// each x_a: X is a chart. The box is halved into charts and boxes without solutions. In a chart the curve is found by
// slices of x_a, and followed from there step by step to the border of the box or back to its beginning. Each step has
// a chart of its own, a tube, whose sides the curve cannot leave. A slice of a chart is done when all that it may
// contain lies in one tube: so no curve is lost, however short.
//
// Boxes that stay undecided until their image is small hold singular solutions, where F' loses its rank: contacts,
// crossings of the curves of solutions, cusps, poles. The curves end near these.
//
// With more equations than N - 1 that have a curve of common solutions all the same (M > N - 1) C is the
// pseudo-inverse: what is followed solves the equations in the sense of least squares, and counts where each holds to
// its tolerance.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "geometry/numerics/solution_charts.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

// A curve of solutions from one place to another.
template <int N>
struct SolutionArc {
  std::vector<ParameterPoint<N>> nodes;  // solutions to rounding, in order; a closed arc repeats the first at the end
  // tubes[i] contains the arc from nodes[i] to nodes[i + 1] and nothing of another, hulls[i] too, more tightly.
  std::vector<ParameterBox<N>> tubes, hulls;
  bool closed = false;
  // The arc ends next to a singular solution rather than on the border of the domain.
  bool begins_singular = false, ends_singular = false;
};

template <int N>
struct SolutionCurves {
  std::vector<SolutionArc<N>> arcs;
  std::vector<ParameterBox<N>> open;  // hulls of what is not decided: singular solutions
  bool complete = true;               // false where there were more than max_boxes: the solutions are no curves
};

template <int N, int M = N - 1>
struct SolutionCurveOptions {
  // Boxes with smaller images are not halved; a length in space.
  double least = 0;
  // So far outside of the domain a solution still counts (it is moved to the border).
  std::array<double, N> slack{};
  // Whether boxes in which a curve takes too many slices are divided: not where the solutions may be no curves, which
  // would take long to find out.
  bool divides_hard_boxes = false;
  // The error of each equation's value.
  std::array<double, M> rounding{};
  // An equation holds where it is no larger than this; of account with more than N - 1 equations.
  std::array<double, M> tolerance{};
  // Boxes inside of these are left out: what they contain is known.
  std::vector<ParameterBox<N>> settled;
  // Of the domain's sides: Newton's steps that no longer get shorter are rounding below it.
  double rounding_of_places = 1e-12;
  // Direction of the curve in space and in the parameters (of the domain's sides) changes by no more in one step;
  // radians.
  double max_turn = 0.3;
  int max_boxes = 8000;
};

namespace solution_curves {

template <int N>
bool is_empty(const ParameterBox<N>& box) {
  for (const Interval& x : box)
    if (x.empty()) return true;
  return false;
}

template <int N>
bool contains(const ParameterBox<N>& outer, const ParameterBox<N>& inner) {
  for (int i = 0; i < N; ++i)
    if (!outer[i].contains(inner[i])) return false;
  return true;
}

template <int N>
bool meet(const ParameterBox<N>& a, const ParameterBox<N>& b) {
  for (int i = 0; i < N; ++i)
    if (!intersects(a[i], b[i])) return false;
  return true;
}

template <int N, int M, class System>
class Search {
 public:
  using Place = ParameterPoint<N>;
  using Box = ParameterBox<N>;

  Search(const System& system, const Box& domain, const SolutionCurveOptions<N, M>& options)
      : system_(system), domain_(domain), options_(options) {
    for (int i = 0; i < N; ++i) scale_[i] = domain[i].width();
  }

  SolutionCurves<N> run() {
    std::vector<Box> level{domain_};
    while (!level.empty()) {
      if (static_cast<int>(level.size()) > options_.max_boxes) {
        result_.complete = false;
        result_.open.insert(result_.open.end(), level.begin(), level.end());
        break;
      }
      boxes_.clear();
      visit_all(level);
      level.swap(boxes_);
    }
    result_.open = joined_boxes<N>(result_.open, slack_box());
    return std::move(result_);
  }

 private:
  // Of least squares: whether each equation holds.
  bool holds(const SystemValue<double, N, M>& there) const {
    if constexpr (M > N - 1)
      for (int k = 0; k < M; ++k)
        if (!(std::abs(there.value[k]) <= options_.tolerance[k])) return false;
    return true;
  }

  std::array<double, N> slack_box() const {
    std::array<double, N> by;
    for (int i = 0; i < N; ++i) by[i] = std::max(options_.slack[i], 1e-9 * scale_[i]);
    return by;
  }

  static std::array<Interval, M> values_of(const SystemValue<double, N, M>& there, bool count) {
    std::array<Interval, M> f;
    for (int k = 0; k < M; ++k) f[k] = Interval(count ? there.value[k] : 0.0);
    return f;
  }

  std::array<Interval, M> rounded(const SystemValue<double, N, M>& there) const {
    std::array<Interval, M> f;
    for (int k = 0; k < M; ++k) f[k] = {there.value[k] - options_.rounding[k], there.value[k] + options_.rounding[k]};
    return f;
  }

  // What a box turns out to be, told by itself alone.
  struct Examined {
    enum class Kind { without, cut, chart, undecided } kind = Kind::without;
    Box left;  // of a box that is cut
    Place middle;
    std::optional<ChartBox<N, M>> over;
  };

  void visit(const Box& box) { visit(box, examined(box)); }
  void visit(const Box& box, const Examined& as) {
    switch (as.kind) {
      case Examined::Kind::without:
        return;
      case Examined::Kind::cut:
        return boxes_.push_back(as.left);
      case Examined::Kind::chart:
        return cover(*as.over, as.middle);
      case Examined::Kind::undecided:
        return divide(box);
    }
  }

  void visit_all(const std::vector<Box>& level) {
    if constexpr (requires { requires System::kThreadSafe; }) {
      constexpr size_t kAtOnce = 512, kForOneThread = 8;
      std::vector<Examined> all(std::min(level.size(), kAtOnce));
      for (size_t first = 0; first < level.size(); first += kAtOnce) {
        const size_t count = std::min(kAtOnce, level.size() - first);
        // Whoever waits here does nothing else meanwhile: it may hold what others wait for.
        tbb::this_task_arena::isolate([&] {
          tbb::parallel_for(tbb::blocked_range<size_t>(0, count, kForOneThread),
                            [&](const tbb::blocked_range<size_t>& some) {
                              for (size_t k = some.begin(); k < some.end(); ++k) all[k] = examined(level[first + k]);
                            });
        });
        for (size_t k = 0; k < count; ++k) visit(level[first + k], all[k]);
      }
    } else {
      for (const Box& box : level) visit(box);
    }
  }

  Examined examined(const Box& box) const {
    Examined result;
    for (const Box& known : options_.settled)
      if (contains<N>(known, box)) return result;
    if constexpr (requires { system_.holds_none(box); })
      if (system_.holds_none(box)) return result;
    const SystemValue<Interval, N, M> range = system_.enclose(box);
    for (int k = 0; k < M; ++k)
      if (range.value[k].lo > options_.rounding[k] || range.value[k].hi < -options_.rounding[k]) return result;
    Place& middle = result.middle;
    std::array<double, N> sides;
    for (int i = 0; i < N; ++i) middle[i] = box[i].middle(), sides[i] = box[i].width();
    const SystemValue<double, N, M> there = system_.evaluate_middle(box);
    const Place direction = direction_of<N, M>(there.derivative, sides);
    // The unknown that changes most, seen in units of the box.
    const std::optional<Chart<N, M>> chart = chart_of<N, M>(there.derivative, largest<N>(direction));
    if (chart) {
      const ChartBox<N, M> over(*chart, box, range);
      Box reached = box;
      if constexpr (M == N - 1) {
        reached = over.reachable(box[chart->along], middle, rounded(there), widened(box, chart->along), kCuts);
        if (is_empty<N>(reached)) return result;
      }
      if (over.is_one_to_one()) {
        result.kind = Examined::Kind::chart;
        result.over.emplace(over);
        return result;
      }
      double share = 1;
      for (int i = 0; i < N; ++i) {
        const Interval part = intersect(reached[i], box[i]);
        reached[i] = part.empty() ? Interval(box[i].clamp(reached[i].lo)) : part;
        share *= reached[i].width() / box[i].width();
      }
      if (share < kWorthCutting) {
        result.kind = Examined::Kind::cut;
        result.left = reached;
        return result;
      }
    }
    if (!is_excluded(box, range, middle, there, sides)) result.kind = Examined::Kind::undecided;
    return result;
  }

  // With the slack of the domain's border, but for one unknown.
  Box widened(Box box, int along) const {
    for (int i = 0; i < N; ++i)
      if (i != along) box[i] = {box[i].lo - options_.slack[i], box[i].hi + options_.slack[i]};
    return box;
  }

  // The mean value form in the combination of equations that changes least over the box: surfaces that are nearly
  // parallel are told apart across them.
  bool is_excluded(const Box& box, const SystemValue<Interval, N, M>& range, const Place& middle,
                   const SystemValue<double, N, M>& there, const std::array<double, N>& sides) const {
    std::array<double, M> weights;
    weights.fill(1);
    if constexpr (M > 1) {
      root_search::Matrix<M> gram{};
      for (int a = 0; a < M; ++a)
        for (int b = 0; b < M; ++b)
          for (int i = 0; i < N; ++i)
            gram[a][b] += there.derivative[a][i] * there.derivative[b][i] * sides[i] * sides[i];
      if (!weakest_direction<M>(gram, weights)) return false;
    }
    Interval sum(0);
    for (int k = 0; k < M; ++k)
      sum +=
          Interval(weights[k]) * Interval(there.value[k] - options_.rounding[k], there.value[k] + options_.rounding[k]);
    for (int i = 0; i < N; ++i) {
      Interval by(0);
      for (int k = 0; k < M; ++k) by += Interval(weights[k]) * range.derivative[k][i];
      sum += by * (box[i] - Interval(middle[i]));
    }
    return !sum.contains(0);
  }

  // Across the parameter that moves the image most.
  void divide(const Box& box) {
    const std::array<double, N> extents = system_.extents(box);
    int best = 0;
    double most = -1;
    for (int i = 0; i < N; ++i)
      if (extents[i] > most && box[i].middle() > box[i].lo && box[i].middle() < box[i].hi) best = i, most = extents[i];
    if (most <= options_.least) {
      result_.open.push_back(box);
      return;
    }
    Box lower = box, upper = box;
    lower[best].hi = upper[best].lo = box[best].middle();
    boxes_.push_back(lower);
    boxes_.push_back(upper);
  }

  // Finds the curves in a chart that are not known yet.
  void cover(const ChartBox<N, M>& over, const Place& middle) {
    const int along = over.chart.along;
    const Box wide = widened(over.box, along);
    Slices slices;
    cut_at_nodes(over, over.box[along], middle, slices);
    int slices_seen = 0;
    while (!slices.empty()) {
      const Interval slice = slices.back().first;
      Place x = slices.back().second;
      slices.pop_back();
      if (is_settled(over, slice, wide, x)) continue;
      // On a known arc, but over more than one of its tubes.
      if (slice.width() > kWideSlice * scale_[along] && is_known_place(x)) {
        halve(over, slice, x, slices);
        continue;
      }
      SystemValue<double, N, M> there;
      const bool found = solve_in(over, wide, x, there);
      if (++slices_seen > kMaxSlices) {
        if (options_.divides_hard_boxes) return divide(over.box);
        result_.open.push_back(over.box);
        return;
      }
      // What was found is the solution, to rounding; where the equations are flat their values' rounding says nothing.
      Box reached = over.reachable(slice, x, values_of(there, !found), wide, kTimes);
      if (is_empty<N>(reached)) continue;
      if (slices_seen > kPatience) {
        reached = seen_closer(slice, along, x, values_of(there, !found), reached);
        if (is_empty<N>(reached)) continue;
      }
      if (is_known(reached)) continue;
      const bool holds_here = found && holds(there);
      if (found && !holds_here && lies_off(reached)) continue;
      if (holds_here && !is_known_place(x)) {
        if (!trace(inside(x))) {
          // It cannot be followed from here: next to a singular solution.
          result_.open.push_back(over.box);
          return;
        }
        if (is_known_place(x)) {
          cut_at_nodes(over, slice, x, slices);
          continue;
        }
      }
      if (slice.width() <= kMinSlice * scale_[along]) continue;
      halve(over, slice, x, slices);
    }
  }

  // What a chart of its own leaves of a slice, seen from x with the values f: where a curve turns back near a border
  // the slopes of a large box tell little.
  Box seen_closer(const Interval& slice, int along, const Place& x, const std::array<Interval, M>& f,
                  const Box& reached) const {
    Box box = reached;
    for (int i = 0; i < N; ++i) {
      box[i] = intersect(reached[i], domain_[i]);
      if (box[i].empty()) box[i] = Interval(domain_[i].clamp(reached[i].lo));
    }
    const std::optional<Chart<N, M>> chart = chart_of<N, M>(system_.evaluate(inside(x)).derivative, along);
    if (!chart) return reached;
    return ChartBox<N, M>(*chart, box, system_.enclose(box)).reachable(slice, x, f, widened(reached, along), kTimes);
  }

  using Slices = std::vector<std::pair<Interval, Place>>;
  static void halve(const ChartBox<N, M>& over, const Interval& slice, const Place& x, Slices& slices) {
    for (const Interval& half : {Interval(slice.lo, slice.middle()), Interval(slice.middle(), slice.hi)})
      slices.emplace_back(half, over.along_slope(x, half.middle()));
  }

  // What is left of a range of a chart by known arcs. Where an arc runs inside of the box it is the chart's only
  // solution; beyond the range is cut at the nodes, so that each slice may lie in one tube. With places near the
  // solution.
  void cut_at_nodes(const ChartBox<N, M>& over, const Interval& range, const Place& near, Slices& slices) const {
    const int along = over.chart.along;
    std::vector<Interval> settled;
    std::vector<const Place*> nodes;
    for (size_t a = 0; a < result_.arcs.size(); ++a) {
      if (!meet<N>(around_[a], over.box)) continue;
      const SolutionArc<N>& arc = result_.arcs[a];
      for (size_t k = 0; k < arc.nodes.size(); ++k) {
        const Place& node = arc.nodes[k];
        if (!range.contains(node[along])) continue;
        bool inside = true;
        for (int i = 0; inside && i < N; ++i) inside = over.box[i].contains(node[i]);
        if (!inside) continue;
        nodes.push_back(&node);
        if (k + 1 < arc.nodes.size() && contains<N>(over.box, arc.hulls[k]))
          settled.push_back(hull(Interval(node[along]), Interval(arc.nodes[k + 1][along])));
      }
    }
    std::sort(settled.begin(), settled.end(), [](const Interval& a, const Interval& b) { return a.lo < b.lo; });
    std::sort(nodes.begin(), nodes.end(), [&](const Place* a, const Place* b) { return (*a)[along] < (*b)[along]; });
    const auto add = [&](double lo, double hi) {
      for (const Place* node : nodes) {
        const double at = (*node)[along];
        if (!(at > lo && at < hi)) continue;
        slices.emplace_back(Interval(lo, at), over.along_slope(*node, 0.5 * (lo + at)));
        lo = at;
      }
      const auto last =
          std::find_if(nodes.rbegin(), nodes.rend(), [&](const Place* node) { return (*node)[along] <= lo; });
      const Place& from = last != nodes.rend() ? **last : near;
      slices.emplace_back(Interval(lo, hi), over.along_slope(from, 0.5 * (lo + hi)));
    };
    double lo = range.lo;
    for (const Interval& part : settled) {
      if (part.lo > lo) add(lo, part.lo);
      lo = std::max(lo, part.hi);
    }
    if (lo < range.hi || settled.empty()) add(lo, range.hi);
  }

  // Whether a slice holds nothing, or only what is known: seen from near a solution, which moves x nearer to it.
  bool is_settled(const ChartBox<N, M>& over, const Interval& slice, const Box& wide, Place& x) const {
    if constexpr (M == N - 1)
      for (int look = 0; look < 2; ++look) {
        const SystemValue<double, N, M> there = system_.evaluate(x);
        const Box reached = over.reachable(slice, x, rounded(there), wide, kLooks);
        if (is_empty<N>(reached) || is_known(reached)) return true;
        for (int i = 0; i < N - 1; ++i) {
          const int unknown = over.chart.others[i];
          for (int k = 0; k < M; ++k) x[unknown] -= over.chart.inverse[i][k] * there.value[k];
          x[unknown] = wide[unknown].clamp(x[unknown]);
        }
      }
    return false;
  }

  // Whether the equations of least squares cannot all vanish there.
  bool lies_off(const Box& reached) const {
    Box box;
    Place middle;
    std::array<double, N> sides;
    for (int i = 0; i < N; ++i) {
      box[i] = intersect(reached[i], domain_[i]);
      if (box[i].empty()) box[i] = Interval(domain_[i].clamp(reached[i].lo));
      middle[i] = box[i].middle(), sides[i] = std::max(box[i].width(), 1e-12 * scale_[i]);
    }
    return is_excluded(box, system_.enclose(box), middle, system_.evaluate(middle), sides);
  }

  Place inside(Place x) const {
    for (int i = 0; i < N; ++i) x[i] = domain_[i].clamp(x[i]);
    return x;
  }

  // The solution with x[along] as it is, if it has one in the box; else a place of the box near which it would be.
  bool solve_in(const ChartBox<N, M>& over, const Box& wide, Place& x, SystemValue<double, N, M>& there) const {
    const Chart<N, M>& chart = over.chart;
    double length = 0;
    bool leads_out = false;
    for (int step = 0; step < kMaxSteps; ++step) {
      there = system_.evaluate(x);
      // Newton's steps first; the fixed inverse always contracts.
      std::optional<Chart<N, M>> own;
      if (step < kNewtonSteps) own = chart_of<N, M>(there.derivative, chart.along);
      const auto& c = own ? own->inverse : chart.inverse;
      length = 0, leads_out = false;
      for (int i = 0; i < N - 1; ++i) {
        const int unknown = chart.others[i];
        double free = x[unknown];
        for (int k = 0; k < M; ++k) free -= c[i][k] * there.value[k];
        const double to = wide[unknown].clamp(free);
        if (!(std::abs(free - to) <= 1e-3 * options_.slack[unknown])) leads_out = true;
        length = std::max(length, std::abs(to - x[unknown]) / scale_[unknown]);
        x[unknown] = to;
      }
      if (length <= kSettled) break;
      if (step > 4 && step < kNewtonSteps && length < kNearlySettled) break;
    }
    there = system_.evaluate(x);
    return !leads_out && length <= std::max(kNearlySettled, options_.rounding_of_places);
  }

  bool is_known(const Box& box) const {
    Box clipped = box;
    for (int i = 0; i < N; ++i) {
      clipped[i] = intersect(box[i], domain_[i]);
      if (clipped[i].empty()) clipped[i] = Interval(domain_[i].clamp(box[i].lo));
    }
    for (size_t k = 0; k < result_.arcs.size(); ++k) {
      if (!contains<N>(around_[k], clipped)) continue;
      for (const Box& tube : result_.arcs[k].tubes)
        if (contains<N>(tube, clipped)) return true;
    }
    for (const Box& tube : loose_tubes_)
      if (contains<N>(tube, clipped)) return true;
    return false;
  }
  bool is_known_place(const Place& place) const {
    Box box;
    for (int i = 0; i < N; ++i) box[i] = Interval(domain_[i].clamp(place[i]));
    return is_known(box);
  }

  // --- following a curve

  struct Ahead {
    Place to, direction;  // there, on
    Box tube, hull;
    bool at_border = false;
  };

  // False where not one step can be certified.
  bool trace(const Place& start) {
    SolutionArc<N> arc;
    meets_known_ = false;
    arc.nodes.push_back(start);
    const Place first = direction_of<N, M>(system_.evaluate(start).derivative, scale_);
    arc.ends_singular = follow(arc, first, start);
    if (!arc.closed) {
      std::reverse(arc.nodes.begin(), arc.nodes.end());
      std::reverse(arc.tubes.begin(), arc.tubes.end());
      std::reverse(arc.hulls.begin(), arc.hulls.end());
      arc.begins_singular = arc.ends_singular;
      Place back = first;
      for (double& x : back) x = -x;
      arc.ends_singular = follow(arc, back, start);
      // In the sense of the direction's sign.
      std::reverse(arc.nodes.begin(), arc.nodes.end());
      std::reverse(arc.tubes.begin(), arc.tubes.end());
      std::reverse(arc.hulls.begin(), arc.hulls.end());
      std::swap(arc.begins_singular, arc.ends_singular);
    }
    if (arc.nodes.size() == 1) return !arc.begins_singular && !arc.ends_singular;
    // What runs into a known arc is its last bit, before a singular solution.
    if (meets_known_) {
      loose_tubes_.insert(loose_tubes_.end(), arc.tubes.begin(), arc.tubes.end());
      return true;
    }
    Box around = arc.tubes.front();
    for (const Box& tube : arc.tubes)
      for (int i = 0; i < N; ++i) around[i] = hull(around[i], tube[i]);
    around_.push_back(around);
    result_.arcs.push_back(std::move(arc));
    return true;
  }

  // From the last node on; true if it ends next to a singular solution.
  bool follow(SolutionArc<N>& arc, Place direction, const Place& start) {
    double step = kFirstStep;
    const size_t known = arc.nodes.size();
    while (arc.nodes.size() < known + kMaxNodes) {
      const Place x = arc.nodes.back();
      Ahead ahead;
      for (;;) {
        if (advance(x, direction, step, ahead)) break;
        step *= 0.5;
        if (step < kMinStep || (step < kShortStep && too_short(x, direction, step))) return true;
      }
      if (ahead.to == x) return false;  // the curve leaves the domain here
      if (arc.nodes.size() > known && passes(ahead, x, direction, start)) {
        arc.nodes.push_back(start);
        arc.tubes.push_back(ahead.tube);
        arc.hulls.push_back(ahead.hull);
        arc.hulls.push_back(ahead.hull);
        arc.closed = true;
        return false;
      }
      arc.nodes.push_back(ahead.to);
      arc.tubes.push_back(ahead.tube);
      arc.hulls.push_back(ahead.hull);
      meets_known_ = meets_known_ || is_known_place(ahead.to);
      if (ahead.at_border || meets_known_) return false;
      direction = ahead.direction;
      step = std::min(1.7 * step, kLongestStep);
    }
    return true;
  }

  bool too_short(const Place& x, const Place& direction, double step) const {
    Box box;
    for (int i = 0; i < N; ++i) {
      const double to = domain_[i].clamp(x[i] + step * direction[i] * scale_[i]);
      box[i] = {std::min(x[i], to), std::max(x[i], to)};
    }
    double most = 0;
    for (const double extent : system_.extents(box)) most = std::max(most, extent);
    return most < 0.1 * options_.least;
  }

  // Whether the way to `ahead` goes through the place where the arc began.
  bool passes(const Ahead& ahead, const Place& x, const Place& direction, const Place& start) const {
    for (int i = 0; i < N; ++i)
      if (!ahead.tube[i].contains(start[i])) return false;
    const int along = largest<N>(direction);
    const double at = (start[along] - x[along]) * (direction[along] > 0 ? 1 : -1);
    const double to = (ahead.to[along] - x[along]) * (direction[along] > 0 ? 1 : -1);
    return at > 0 && at <= to;
  }

  // One step; false where it is too long to be certified.
  bool advance(const Place& x, const Place& direction, double step, Ahead& ahead) {
    const int along = largest<N>(direction);
    Place to;
    for (int i = 0; i < N; ++i) to[i] = x[i] + step * direction[i] * scale_[i];
    ahead.at_border = false;
    const double free = to[along];
    to[along] = domain_[along].clamp(to[along]);
    if (to[along] == x[along]) {
      ahead.to = x;
      return true;
    }
    if (to[along] != free) {
      const double share = (to[along] - x[along]) / (free - x[along]);
      for (int i = 0; i < N; ++i)
        if (i != along) to[i] = x[i] + share * (to[i] - x[i]);
    }
    Place near = options_.slack;
    if (!settle(to, along, step, near)) return false;
    ahead.at_border = to[along] != free;
    int out = -1;
    double share = 1;
    for (int i = 0; i < N; ++i) {
      if (i == along) continue;
      const double border = domain_[i].clamp(to[i]);
      if (std::abs(to[i] - border) <= near[i]) {
        to[i] = border;
        continue;
      }
      const double part = to[i] != x[i] ? (border - x[i]) / (to[i] - x[i]) : 0;
      if (out < 0 || part < share) out = i, share = part;
    }
    if (out >= 0) {
      // The curve leaves the domain on the way: the place on the border.
      Place at;
      for (int i = 0; i < N; ++i) at[i] = x[i] + share * (to[i] - x[i]);
      at[out] = domain_[out].clamp(to[out]);
      if (x[out] == at[out]) {
        ahead.to = x;
        return leaves_at_once(x, direction, out);
      }
      near[out] = options_.slack[out];
      if (!settle(at, out, step, near)) return false;
      for (int i = 0; i < N; ++i) {
        const double border = domain_[i].clamp(at[i]);
        if (std::abs(at[i] - border) > near[i]) return false;
        at[i] = border;
      }
      const double side = (at[along] - x[along]) * (to[along] - x[along]);
      if (!(side >= 0) || std::abs(at[along] - x[along]) > 1.5 * std::abs(to[along] - x[along])) return false;
      if (at[along] == x[along]) {
        ahead.to = x;
        return true;
      }
      to = at;
      ahead.at_border = true;
    }
    const SystemValue<double, N, M> there = system_.evaluate(to);
    ahead.to = to;
    ahead.direction = onward(there, direction);
    if (turns_too_much(x, direction, ahead) || !holds(there) || dips_out(x, direction, along, step, ahead))
      return false;
    return certify(x, direction, along, step, there, ahead);
  }

  // Between two places inside the curve may be outside for a while: where it turns back beyond a border. No farther off
  // than a place may be that still lies on the border is inside.
  bool dips_out(const Place& x, const Place& direction, int along, double step, const Ahead& ahead) const {
    for (int i = 0; i < N; ++i) {
      if (i == along) continue;
      const bool up = direction[i] > 0;
      const double border = up ? domain_[i].hi : domain_[i].lo;
      if (std::min(std::abs(border - x[i]), std::abs(border - ahead.to[i])) > 0.5 * step * scale_[i]) continue;
      if (direction[i] == 0 || (ahead.direction[i] > 0) == up) continue;
      Place before = x, after = ahead.to;
      for (int time = 0; time < kBisections; ++time) {
        Place middle, near = options_.slack;
        for (int k = 0; k < N; ++k) middle[k] = 0.5 * (before[k] + after[k]);
        if (!settle(middle, along, step, near)) return true;
        if (up ? middle[i] > border + near[i] : middle[i] < border - near[i]) return true;
        ((onward(system_.evaluate(middle), direction)[i] > 0) == up ? before : after) = middle;
      }
    }
    return false;
  }
  // The curve's direction at a place on, when that was `direction` before.
  Place onward(const SystemValue<double, N, M>& there, const Place& direction) const {
    Place next = direction_of<N, M>(there.derivative, scale_);
    double with = 0;
    for (int i = 0; i < N; ++i) with += next[i] * direction[i];
    if (with < 0)
      for (double& d : next) d = -d;
    return next;
  }

  // At a border that the curve touches from inside it may stay a little beyond: only a true exit ends it.
  bool leaves_at_once(const Place& x, const Place& direction, int out) const {
    const bool low = x[out] - domain_[out].lo < domain_[out].hi - x[out];
    return low ? direction[out] < 0 : direction[out] > 0;
  }

  // Newton's iteration with one unknown held. `near`: how far off a border a place may be and still lie on it: the
  // slack, or what the rounding of the equations' values makes of the unknown.
  bool settle(Place& x, int held, double step, Place& near) const {
    const Place start = x;
    double before = kInfinity;
    for (int time = 0; time < kMaxHeldSteps; ++time) {
      const SystemValue<double, N, M> there = system_.evaluate(x);
      const std::optional<Chart<N, M>> chart = chart_of<N, M>(there.derivative, held);
      if (!chart) return false;
      double length = 0, noise = options_.rounding_of_places;
      for (int i = 0; i < N - 1; ++i) {
        const int unknown = chart->others[i];
        double by = 0, rounding = 0;
        for (int k = 0; k < M; ++k) {
          by += chart->inverse[i][k] * there.value[k];
          rounding += std::abs(chart->inverse[i][k]) * options_.rounding[k];
        }
        x[unknown] -= by;
        length = std::max(length, std::abs(by) / scale_[unknown]);
        noise = std::max(noise, rounding / scale_[unknown]);
        near[unknown] = std::max(options_.slack[unknown], rounding);
        if (!(std::abs(x[unknown] - start[unknown]) <= 0.7 * step * scale_[unknown])) return false;
      }
      if (length <= kSettled || (length < noise && length >= 0.5 * before)) return true;
      before = length;
    }
    return false;
  }
  bool turns_too_much(const Place& x, const Place& direction, const Ahead& ahead) const {
    double with = 0;
    for (int i = 0; i < N; ++i) with += ahead.direction[i] * direction[i];
    const double cosine = std::cos(options_.max_turn);
    if (!(with >= cosine)) return true;
    const Vec3 here = system_.motion(x, scaled(direction)), there = system_.motion(ahead.to, scaled(ahead.direction));
    const double lengths = glm::length(here) * glm::length(there);
    return lengths > 0 && glm::dot(here, there) < cosine * lengths;
  }
  Place scaled(Place direction) const {
    for (int i = 0; i < N; ++i) direction[i] *= scale_[i];
    return direction;
  }

  // A tube about the way from x to `to`. A wide one holds other solutions off best. But where unknowns move the
  // equations very differently (a small surface meets a large one, near a pole) only a tube is a chart that is as
  // narrow in each as it moves them, but for what the curve bends.
  bool certify(const Place& x, const Place& direction, int along, double step, const SystemValue<double, N, M>& there,
               Ahead& ahead) const {
    const Place& to = ahead.to;
    Place along_way, wide, beside;
    for (int i = 0; i < N; ++i) {
      along_way[i] = 0.1 * std::abs(to[i] - x[i]);
      wide[i] = i == along ? 0 : step * scale_[i];
      beside[i] = along_way[i] + 0.35 * wide[i];
    }
    if (certify(x, to, along, beside, ahead)) return true;
    if (step > kNarrowStep) return false;  // a shorter one may do
    std::array<double, N> moves{};
    for (int i = 0; i < N; ++i)
      for (int k = 0; k < M; ++k) moves[i] += sqr(there.derivative[k][i]);
    for (const double share : {0.35, 0.05, 0.005}) {
      for (int i = 0; i < N; ++i) {
        const double bends = 0.5 * std::abs(ahead.direction[i] - direction[i]);
        const double even = moves[i] > 0 ? step * scale_[along] * std::sqrt(moves[along] / moves[i]) : wide[i];
        beside[i] = along_way[i] + (i == along ? 0 : bends * wide[i] + share * std::min(wide[i], even));
      }
      if (certify(x, to, along, beside, ahead)) return true;
    }
    return false;
  }

  // A tube so far beside the way: a chart whose sides the curve cannot reach.
  bool certify(const Place& x, const Place& to, int along, const Place& beside, Ahead& ahead) const {
    Box& tube = ahead.tube;
    Place middle;
    for (int i = 0; i < N; ++i) {
      const double low = std::min(x[i], to[i]), high = std::max(x[i], to[i]);
      tube[i] = {std::max(domain_[i].lo, low - beside[i]), std::min(domain_[i].hi, high + beside[i])};
      middle[i] = domain_[i].clamp(0.5 * (x[i] + to[i]));
    }
    const std::optional<Chart<N, M>> chart = chart_of<N, M>(system_.evaluate(middle).derivative, along);
    if (!chart) return false;
    const ChartBox<N, M> over(*chart, tube, system_.enclose(tube));
    if (!over.is_one_to_one()) return false;
    const Box reached = over.reachable(tube[along], x, {}, tube, 1);
    if (is_empty<N>(reached)) return false;
    for (int i = 0; i < N; ++i) {
      if (i == along) continue;
      if (reached[i].lo <= tube[i].lo && tube[i].lo > domain_[i].lo) return false;
      if (reached[i].hi >= tube[i].hi && tube[i].hi < domain_[i].hi) return false;
    }
    ahead.hull = over.reachable(hull(Interval(x[along]), Interval(to[along])), x, {}, reached, kCuts);
    return true;
  }

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr double kSettled = 4e-16, kNearlySettled = 1e-9;
  static constexpr double kFirstStep = 0.05, kLongestStep = 0.25, kNarrowStep = 0.01, kShortStep = 1e-3,
                          kMinStep = 1e-10;
  static constexpr double kWorthCutting = 0.25;  // of the volume: a box that keeps more is halved instead
  static constexpr double kMinSlice = 1e-12, kWideSlice = 1e-4;
  static constexpr int kTimes = 400, kCuts = 3, kBisections = 30, kLooks = 10, kNewtonSteps = 10, kMaxHeldSteps = 20,
                       kMaxSteps = 150, kMaxNodes = 200000, kMaxSlices = 250, kPatience = 12;

  const System& system_;
  const Box domain_;
  const SolutionCurveOptions<N, M>& options_;
  std::array<double, N> scale_{};
  std::vector<Box> boxes_;
  std::vector<Box> around_;  // the tubes of each arc
  std::vector<Box> loose_tubes_;
  bool meets_known_ = false;
  SolutionCurves<N> result_;
};

}  // namespace solution_curves

// `system` has these members:
//   SystemValue<Interval, N, M> enclose(const ParameterBox<N>&) const
//     certified ranges over a box in the domain
//   SystemValue<double, N, M> evaluate(const ParameterPoint<N>&) const
//     the same at a place, to rounding; a little outside of the domain too
//   SystemValue<double, N, M> evaluate_middle(const ParameterBox<N>&) const
//     the same in the middle of a box
//   std::array<double, N> extents(const ParameterBox<N>&) const
//     bounds of how far each parameter moves the image in space, over a box
//   Vec3 motion(const ParameterPoint<N>&, const ParameterPoint<N>&) const
//     velocity in space: at a place, moving so
// and may have
//   static constexpr bool kThreadSafe = true
//     enclose and evaluate_middle may be asked from many threads at once
//   bool holds_none(const ParameterBox<N>&) const
//     at less cost than enclose: whether a box holds no solution
template <int N, int M = N - 1, class System>
SolutionCurves<N> search_solution_curves(const System& system, const ParameterBox<N>& domain,
                                         const SolutionCurveOptions<N, M>& options) {
  return solution_curves::Search<N, M, System>(system, domain, options).run();
}

}  // namespace lekalo::geometry
