// The squared distance of two elements as a function of their one to four parameters, half of it:
//
//   f = |w|^2 / 2,  w = r_a - r_b,   f_i = w . w_i,   f_ij = w_i . w_j + w . w_ij,
//
// w_i being r_a's derivative by a parameter of a, or minus r_b's.
#pragma once

#include <cmath>
#include <queue>

#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/numerics/root_search.h"
#include "geometry/queries/closest/distance_elements.h"

namespace lekalo::geometry {

// Minima whose distances differ by less than this part of them are as near.
inline constexpr double kTie = 1e-12;
// Distances that differ by less than this part of the size are equal, points nearer than that one.
inline constexpr double kEqualDistance = 1e-12, kOnePlace = 1e-7;
// A slope along which the distance grows by less than this part of the size for its length is level.
inline constexpr double kLevel = 1e-8;

using ElementPlace = std::array<double, 2>;

struct ElementPair {
  const DistanceElement *a, *b;
  double from = 0;  // the distance of their boxes
  int unknowns() const { return a->dimension + b->dimension; }
};

// The nearest places of all that were looked at.
struct NearestSeen {
  double distance = kInfinity;
  ElementPair pair{};
  ElementPlace a{}, b{};
};

// A minimum while it is sorted among others. `absorbed`: it is part of another one.
struct FoundMinimum {
  DistanceMinimum minimum;
  const DistanceElement *a, *b;
  bool absorbed = false;
  bool family = false;  // of two straight or plane elements
};

// The parameters of a place are its element's own, not those of a line on a surface.
inline bool has_two_parameters(const DistancePlace& place) {
  return place.kind == DistancePlace::Kind::surface || place.kind == DistancePlace::Kind::face;
}

inline DistanceMinimum minimum_at(const ElementPair& pair, const ElementPlace& a, const ElementPlace& b) {
  DistanceMinimum minimum;
  minimum.a = pair.a->place_at(a), minimum.b = pair.b->place_at(b);
  minimum.distance = glm::length(minimum.a.point - minimum.b.point);
  const auto range_of = [](const DistancePlace& place) -> std::array<Interval, 2> {
    if (has_two_parameters(place)) return {Interval(place.u), Interval(place.v)};
    return {Interval(place.t), Interval(0)};
  };
  minimum.range_a = range_of(minimum.a), minimum.range_b = range_of(minimum.b);
  return minimum;
}

template <int N>
class DistanceSystem {
 public:
  // What is looked at is remembered in `seen`, if that is asked for. With `nearest` boxes where all is farther are left
  // out.
  explicit DistanceSystem(const ElementPair& pair, NearestSeen* seen = nullptr, bool nearest = false)
      : a_(*pair.a), b_(*pair.b), seen_(seen), nearest_(nearest) {}

  ParameterBox<N> domain() const {
    ParameterBox<N> box;
    for (int i = 0; i < N; ++i) box[i] = is_of_a(i) ? a_.domain[i] : b_.domain[i - a_.dimension];
    return box;
  }
  double scale(int i) const { return is_of_a(i) ? a_.scale[i] : b_.scale[i - a_.dimension]; }
  std::array<double, 2> of_a(const ParameterPoint<N>& at) const {
    std::array<double, 2> result{};
    for (int i = 0; i < a_.dimension; ++i) result[i] = at[i];
    return result;
  }
  std::array<double, 2> of_b(const ParameterPoint<N>& at) const {
    std::array<double, 2> result{};
    for (int i = 0; i < b_.dimension; ++i) result[i] = at[a_.dimension + i];
    return result;
  }
  Vec3 way(const ParameterPoint<N>& at) const { return a_.at(of_a(at)) - b_.at(of_b(at)); }
  bool keeps(const ParameterPoint<N>& at) const { return a_.keeps(of_a(at)) && b_.keeps(of_b(at)); }

  // Gradient and second derivatives. A box without a minimum has values that do not vanish.
  SystemValue<Interval, N, N> enclose(const ParameterBox<N>& box) const {
    SystemValue<Interval, N, N> none;
    none.value[0] = Interval(kInfinity, kInfinity);
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j) none.derivative[i][j] = Interval(0);
    bool thin = true;
    for (const Interval& side : box) thin = thin && side.width() == 0;
    // A place is asked for as such, whatever is there.
    if (!thin && is_outside(box)) return none;
    const auto [ra, rb] = ranges(box);
    const Box3 w = difference(ra.point, rb.point);
    if (!thin && nearest_ && std::sqrt(square(w).lo) > seen_->distance * (1 + kTie)) return none;
    SystemValue<Interval, N, N> result = gradient(w, ra, rb);
    if (!thin)
      for (int i = 0; i < N; ++i)
        if (result.derivative[i][i].hi < 0) return none;
    return result;
  }

  SystemValue<double, N, N> evaluate(const ParameterPoint<N>& at) const {
    const ElementJet ja = a_.jet(of_a(at)), jb = b_.jet(of_b(at));
    const Vec3 w = ja.point - jb.point;
    if (seen_ && glm::length(w) < seen_->distance && keeps(at))
      *seen_ = {glm::length(w), {&a_, &b_}, of_a(at), of_b(at)};
    SystemValue<double, N, N> result;
    const auto first = [&](int i) { return is_of_a(i) ? ja.first[i] : -jb.first[i - a_.dimension]; };
    for (int i = 0; i < N; ++i) {
      result.value[i] = glm::dot(w, first(i));
      for (int j = 0; j < N; ++j) {
        result.derivative[i][j] = glm::dot(first(i), first(j));
        if (is_of_a(i) && is_of_a(j)) result.derivative[i][j] += glm::dot(w, ja.second[i + j]);
        if (!is_of_a(i) && !is_of_a(j)) result.derivative[i][j] -= glm::dot(w, jb.second[i + j - 2 * a_.dimension]);
      }
    }
    return result;
  }

  // What the distance in the box is not below, by its range and by its value in the middle and the range of the
  // gradient: near a minimum the second is the better one.
  double lower_bound(const ParameterBox<N>& box) const {
    if (is_outside(box)) return kInfinity;
    const auto [ra, rb] = ranges(box);
    const Box3 w = difference(ra.point, rb.point);
    const double plain = std::sqrt(std::max(0.0, square(w).lo));
    ParameterBox<N> middle;
    for (int i = 0; i < N; ++i) middle[i] = Interval(box[i].middle());
    const auto [ma, mb] = ranges(middle);
    Interval squared = square(difference(ma.point, mb.point));
    const SystemValue<Interval, N, N> over = gradient(w, ra, rb);
    for (int i = 0; i < N; ++i) squared += Interval(2) * over.value[i] * (box[i] - middle[i]);
    return std::max(plain, squared.lo > 0 ? next_down(std::sqrt(squared.lo)) : 0.0);
  }

 private:
  bool is_of_a(int i) const { return i < a_.dimension; }

  std::pair<ElementRange, ElementRange> ranges(const ParameterBox<N>& box) const {
    std::array<Interval, 2> of_a, of_b;
    for (int i = 0; i < N; ++i) (is_of_a(i) ? of_a[i] : of_b[i - a_.dimension]) = box[i];
    return {a_.range(of_a), b_.range(of_b)};
  }
  static Box3 difference(const Box3& a, const Box3& b) {
    Box3 result;
    for (int k = 0; k < 3; ++k) {
      const Interval one = along(a, k) - along(b, k);
      result.lo[k] = one.lo, result.hi[k] = one.hi;
    }
    return result;
  }
  static Box3 negative(const Box3& box) { return {-box.hi, -box.lo}; }

  SystemValue<Interval, N, N> gradient(const Box3& w, const ElementRange& ra, const ElementRange& rb) const {
    SystemValue<Interval, N, N> result;
    const auto first = [&](int i) { return is_of_a(i) ? ra.first[i] : negative(rb.first[i - a_.dimension]); };
    for (int i = 0; i < N; ++i) {
      result.value[i] = product(w, first(i));
      for (int j = 0; j <= i; ++j) {
        Interval second = i == j ? square(first(i)) : product(first(i), first(j));
        if (is_of_a(i)) second += product(w, ra.second[i + j]);
        if (!is_of_a(j)) second -= product(w, rb.second[i + j - 2 * a_.dimension]);
        result.derivative[i][j] = result.derivative[j][i] = second;
      }
    }
    return result;
  }

  // All of the box lies outside of one's trim.
  bool is_outside(const ParameterBox<N>& box) const {
    const auto outside = [&](const DistanceElement& element, int first) {
      if (!element.trim || element.dimension == 0) return false;
      Rectangle over{box[first], box[first]};
      if (element.dimension == 2) over.v = box[first + 1];
      if (element.held_u) over.u = *element.held_u;
      if (element.held_v) over.v = *element.held_v;
      return element.trim->coverage(over) == TrimRegion::Coverage::outside;
    };
    return outside(a_, 0) || outside(b_, a_.dimension);
  }

  const DistanceElement &a_, &b_;
  NearestSeen* seen_;
  bool nearest_;
};

// `count` places along each side of a box.
template <int N>
std::vector<ParameterPoint<N>> starts(const ParameterBox<N>& box, int count) {
  std::vector<ParameterPoint<N>> result{{}};
  for (int i = 0; i < N; ++i) {
    std::vector<ParameterPoint<N>> more;
    for (const ParameterPoint<N>& place : result)
      for (int k = 0; k < count; ++k) {
        more.push_back(place);
        // Not where symmetric things are level.
        more.back()[i] = box[i].lo + box[i].width() * (k + 0.52 - 0.01 * i) / count;
      }
    result = std::move(more);
  }
  return result;
}

// Downhill from a place to where the distance is least within the box, by Newton's steps made shorter until they lead
// down (Levenberg and Marquardt).
template <int N>
ParameterPoint<N> descended(const DistanceSystem<N>& system, const ParameterBox<N>& box, ParameterPoint<N> x) {
  constexpr int kMaxSteps = 200;
  double shortening = 1e-4;
  Vec3 way = system.way(x);
  for (int step = 0; step < kMaxSteps; ++step) {
    const SystemValue<double, N, N> there = system.evaluate(x);
    bool moved = false;
    while (!moved && shortening < 1e12) {
      root_search::Matrix<N> m = there.derivative, inverse;
      bool held[N];
      for (int i = 0; i < N; ++i) {
        held[i] = (x[i] <= box[i].lo && there.value[i] >= 0) || (x[i] >= box[i].hi && there.value[i] <= 0);
        m[i][i] += shortening * std::max(std::abs(m[i][i]), 1e-300);
      }
      for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j)
          if (held[i] || held[j]) m[i][j] = i == j ? 1.0 : 0.0;
      ParameterPoint<N> next = x;
      bool small = true;
      double slope = 0;
      if (root_search::invert<N>(m, inverse))
        for (int i = 0; i < N; ++i) {
          if (held[i]) continue;
          for (int j = 0; j < N; ++j)
            if (!held[j]) next[i] -= inverse[i][j] * there.value[j];
          next[i] = box[i].clamp(next[i]);
          slope += (next[i] - x[i]) * there.value[i];
          small = small && std::abs(next[i] - x[i]) <= 1e-15 * system.scale(i);
        }
      if (small) return x;
      const Vec3 next_way = system.way(next);
      if (slope < 0 && glm::dot(next_way, next_way) < glm::dot(way, way)) {
        x = next, way = next_way, moved = true;
        shortening = std::max(1e-14, 0.1 * shortening);
      } else {
        shortening *= 10;
      }
    }
    if (!moved) return x;
  }
  return x;
}

// A lower bound of the distance in a box, by halving where it is lowest; `good`: no better one is asked for.
template <int N>
double lower_bound(const DistanceSystem<N>& system, const ParameterBox<N>& all, double good, int boxes = 4000) {
  using Bounded = std::pair<double, ParameterBox<N>>;
  const auto higher = [](const Bounded& a, const Bounded& b) { return a.first > b.first; };
  std::priority_queue<Bounded, std::vector<Bounded>, decltype(higher)> queue(higher);
  queue.emplace(system.lower_bound(all), all);
  while (boxes-- > 0 && !queue.empty() && queue.top().first < good) {
    ParameterBox<N> box = queue.top().second;
    const double before = queue.top().first;
    queue.pop();
    int widest = 0;
    for (int i = 1; i < N; ++i)
      if (box[i].width() * system.scale(widest) > box[widest].width() * system.scale(i)) widest = i;
    for (const bool upper : {false, true}) {
      ParameterBox<N> half = box;
      (upper ? half[widest].lo : half[widest].hi) = box[widest].middle();
      queue.emplace(std::max(before, system.lower_bound(half)), half);
    }
  }
  return queue.empty() ? kInfinity : queue.top().first;
}

}  // namespace lekalo::geometry
