#include "geometry/queries/closest/distance.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/queries/closest/distance_neighbours.h"
#include "geometry/queries/closest/distance_pairs.h"
#include "geometry/queries/closest/non_isolated_minima.h"
#include "geometry/queries/closest/unbounded_surfaces.h"
#include "geometry/queries/implicit_curves/smooth_parts.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Boxes are not halved below this part of the range.
constexpr double kMinBox = 1e-8;
// Boxes of one size that may stay undecided before minima count as not isolated, by the number of unknowns; with four
// fewer where a descent shows that they are not.
constexpr int kMaxBoxes[] = {0, 4096, 4096, 8192, 16384};
constexpr int kMaxBoxesOfLevel = 1024;
// What is on the border of an element is found on that; what is not decided near to it too, about a pole.
constexpr double kOnBorder = 2 * kBorderSlack, kAtPole = 1e-7;
// A stationary place: the derivative over the entire range in parts of the square of the size.
constexpr double kStationary = 1e-8;
// From so far off, in parts of the range, an isolated minimum is found again within kFoundAgain.
constexpr double kBeside = 1e-3, kFoundAgain = 1e-5;

class DistanceQuery {
 public:
  DistanceQuery(const Distant& a, const Distant& b, bool nearest) : nearest_(nearest) {
    const Box3 box_a = bounds(a), box_b = bounds(b);
    if (box_a.bounded()) all_.include(box_a);
    if (box_b.bounded()) all_.include(box_b);
    a_ = distance_elements(a, box_b);
    b_ = distance_elements(b, box_a);
    size_ = all_.diameter();
    for (const auto& list : {&a_, &b_})
      for (const auto& element : *list)
        if (element->dimension > 0) size_ = std::max(size_, element->box.diameter());
    size_ = std::max(size_, 1e-300);
  }

  Distance run() {
    found_ = minima_of_curve_on_patches(a_, b_, size_);
    if (!found_.empty()) {
      seen_.distance = found_.front().minimum.distance;
      return result();
    }
    const auto has_patches = [](const DistanceElements& list) {
      return std::any_of(list.begin(), list.end(), [](const auto& element) { return element->dimension == 2; });
    };
    const bool wanted = nearest_;
    if (has_patches(a_) && has_patches(b_)) {
      nearest_ = stops_at_intersection_ = true;
      search_all();
      if (wanted || seen_.distance <= kIntersection * size_) return result();
      nearest_ = stops_at_intersection_ = false;
      found_.clear();
      flats_.clear();
      bound_ = kInfinity;
    }
    search_all();
    return result();
  }

 private:
  void search_all() {
    if (nearest_) {
      NearestPairs pairs(a_, b_);
      while (const auto pair = pairs.next()) {
        if (pair->from > seen_.distance * (1 + kTie) + kEqualDistance * size_) break;
        visit(*pair);
        if (stops_at_intersection_ && seen_.distance <= kIntersection * size_) return;
      }
    } else {
      for (const auto& a : a_)
        for (const auto& b : b_) visit({a.get(), b.get()});
    }
    merge_minima_of_parallels(flats_, size_, found_);
  }

  void visit(const ElementPair& pair) {
    if (is_flat_pair(pair))
      flats_.push_back(pair);
    else
      search(pair);
  }

  // Two parallel elements that are straight or plane: where they are nearest to each other reaches to their borders,
  // so that it is found among these.
  bool is_flat_pair(const ElementPair& pair) const {
    const DistanceElement &a = *pair.a, &b = *pair.b;
    if (a.dimension == 0 || b.dimension == 0) return false;
    if (a.dimension == 2 && b.dimension == 2) return a.flat && b.flat;
    if (a.dimension == 1 && b.dimension == 1)
      return a.flat && b.flat && glm::length(glm::cross(a.axis, b.axis)) <= kLevel;
    const DistanceElement &line = a.dimension == 1 ? a : b, &patch = a.dimension == 1 ? b : a;
    if (!patch.flat) return false;
    if (line.flat) return std::abs(glm::dot(line.axis, patch.axis)) <= kLevel;
    const Box3 slope = line.range({line.domain[0]}).first[0];
    double along = 0;
    for (int k = 0; k < 3; ++k)
      along += std::abs(patch.axis[k]) * std::max(std::abs(slope.lo[k]), std::abs(slope.hi[k]));
    return along * line.scale[0] <= kEqualDistance * size_;
  }

  void search(const ElementPair& pair) {
    switch (pair.unknowns()) {
      case 0: {
        const double distance = glm::length(pair.a->place.point - pair.b->place.point);
        if (distance < seen_.distance) seen_ = {distance, pair};
        bound_ = std::min(bound_, next_down(next_down(distance)));
        consider(pair, {}, {}, true);
        break;
      }
      case 1:
        return search<1>(pair);
      case 2:
        return search<2>(pair);
      case 3:
        return search<3>(pair);
      case 4:
        return search<4>(pair);
    }
  }

  template <int N>
  void search(const ElementPair& pair) {
    const DistanceSystem<N> system(pair, &seen_, nearest_);
    const ParameterBox<N> domain = system.domain();
    if (nearest_ && N > 1) {
      // A low limit first: it leaves out most of the boxes.
      for (const ParameterPoint<N>& start : starts<N>(domain, N == 4 && pair.from <= kIntersection * size_ ? 3 : 1)) {
        system.evaluate(descended<N>(system, domain, start));
        if (stops_at_intersection_ && seen_.distance <= kIntersection * size_) return;
      }
    }
    RootSearchOptions<N, N> options;
    options.max_boxes = N == 4 && seems_level<N>(pair, system) ? kMaxBoxesOfLevel : kMaxBoxes[N];
    for (int i = 0; i < N; ++i) {
      options.least[i] = kMinBox * system.scale(i);
      options.slack[i] = kBorderSlack * system.scale(i);
    }
    const RootSearchResult<N> found = search_roots<N, N>(system, domain, options);
    for (const ParameterPoint<N>& at : found.isolated) {
      ParameterBox<N> around;
      for (int i = 0; i < N; ++i)
        around[i] = intersect(Interval(at[i] - 1e-9 * system.scale(i), at[i] + 1e-9 * system.scale(i)), domain[i]);
      bound_ = std::min(bound_, system.lower_bound(around));
      if (is_on_border(pair, system.of_a(at), system.of_b(at), kOnBorder)) continue;
      if (!system.keeps(at) || !is_minimum<N>(system.evaluate(at).derivative)) continue;
      consider(pair, system.of_a(at), system.of_b(at), true);
    }
    for (const ParameterBox<N>& box : found.open) look_into<N>(pair, system, box);
  }

  static bool is_on_border(const ElementPair& pair, const ElementPlace& a, const ElementPlace& b, double slack) {
    return pair.a->is_on_border(a, slack) || pair.b->is_on_border(b, slack);
  }

  // The second derivatives are positive (Cholesky).
  template <int N>
  static bool is_minimum(std::array<std::array<double, N>, N> h) {
    for (int k = 0; k < N; ++k) {
      if (!(h[k][k] > 0)) return false;
      for (int i = k + 1; i < N; ++i)
        for (int j = k + 1; j < N; ++j) h[i][j] -= h[i][k] * h[k][j] / h[k][k];
    }
    return true;
  }

  // A box that the search left open: minima where the second derivatives vanish too, or more than can be told apart.
  template <int N>
  void look_into(const ElementPair& pair, const DistanceSystem<N>& system, const ParameterBox<N>& box) {
    const ParameterBox<N> domain = system.domain();
    double own = kInfinity;
    bool level = false;
    for (const ParameterPoint<N>& start : starts<N>(box, is_wide<N>(system, box) ? 3 : 1)) {
      const ParameterPoint<N> end = descended<N>(system, domain, start);
      const double distance = glm::length(system.way(end));
      if (!system.keeps(end)) continue;
      own = std::min(own, distance);
      if (is_on_border(pair, system.of_a(end), system.of_b(end), kAtPole)) continue;
      bool inside = true;
      const SystemValue<double, N, N> there = system.evaluate(end);
      for (int i = 0; i < N; ++i)
        inside = inside && std::abs(end[i] - box[i].clamp(end[i])) <= kFoundAgain * system.scale(i) &&
                 std::abs(there.value[i]) * system.scale(i) <= kStationary * size_ * size_;
      if (!inside) continue;
      const bool isolated = is_found_again<N>(system, end);
      if (isolated || !level) consider(pair, system.of_a(end), system.of_b(end), isolated, ranges_of<N>(pair, box));
      level = level || !isolated;
    }
    bound_ = std::min(bound_, lower_bound<N>(system, box, std::min(seen_.distance, own) - 1e-15 * size_));
  }

  // Whether descents end where places beside are as near, or at a pole, about which all parameters are. (Those that
  // the pole stops on their way to something nearer tell nothing.)
  template <int N>
  bool seems_level(const ElementPair& pair, const DistanceSystem<N>& system) const {
    const ParameterBox<N> domain = system.domain();
    double least = kInfinity, min_at_pole = kInfinity;
    for (const ParameterPoint<N>& start : starts<N>(domain, 2)) {
      const ParameterPoint<N> end = descended<N>(system, domain, start);
      const double distance = glm::length(system.way(end));
      least = std::min(least, distance);
      if (is_singular(*pair.a, system.of_a(end)) || is_singular(*pair.b, system.of_b(end))) {
        min_at_pole = std::min(min_at_pole, distance);
        continue;
      }
      bool inner = true;
      for (int i = 0; i < N; ++i) inner = inner && end[i] > domain[i].lo && end[i] < domain[i].hi;
      if (inner && !is_found_again<N>(system, end)) return true;
    }
    return min_at_pole <= least + 1e-9 * size_;
  }
  static bool is_singular(const DistanceElement& element, const ElementPlace& at) {
    const ElementJet jet = element.jet(at);
    for (int i = 0; i < element.dimension; ++i)
      if (glm::length(jet.first[i]) * element.scale[i] <= 1e-6 * element.box.diameter()) return true;
    return false;
  }

  template <int N>
  static bool is_wide(const DistanceSystem<N>& system, const ParameterBox<N>& box) {
    for (int i = 0; i < N; ++i)
      if (box[i].width() > kFoundAgain * system.scale(i)) return true;
    return false;
  }

  template <int N>
  static bool is_found_again(const DistanceSystem<N>& system, const ParameterPoint<N>& at) {
    const ParameterBox<N> domain = system.domain();
    for (int i = 0; i < N; ++i)
      for (const double side : {1.0, -1.0}) {
        ParameterPoint<N> beside = at;
        beside[i] = domain[i].clamp(at[i] + side * kBeside * system.scale(i));
        const ParameterPoint<N> end = descended<N>(system, domain, beside);
        for (int k = 0; k < N; ++k)
          if (std::abs(end[k] - at[k]) > kFoundAgain * system.scale(k)) return false;
      }
    return true;
  }

  template <int N>
  static std::array<std::array<Interval, 2>, 2> ranges_of(const ElementPair& pair, const ParameterBox<N>& box) {
    std::array<std::array<Interval, 2>, 2> result{};
    for (int i = 0; i < N; ++i) (i < pair.a->dimension ? result[0][i] : result[1][i - pair.a->dimension]) = box[i];
    return result;
  }

  // A minimum on the two elements is one on the whole where the distance grows into what is beside them.
  void consider(const ElementPair& pair, const ElementPlace& a, const ElementPlace& b, bool isolated,
                const std::array<std::array<Interval, 2>, 2>& ranges = {}) {
    FoundMinimum found{minimum_at(pair, a, b), pair.a, pair.b};
    DistanceMinimum& minimum = found.minimum;
    if (nearest_ && minimum.distance > seen_.distance * (1 + kTie) + kEqualDistance * size_) return;
    minimum.isolated = isolated;
    if (!isolated) {
      if (pair.a->dimension == 2 || !has_two_parameters(minimum.a)) minimum.range_a = ranges[0];
      if (pair.b->dimension == 2 || !has_two_parameters(minimum.b)) minimum.range_b = ranges[1];
    }
    if (!is_minimum_beside(pair, a, b, size_, minimum)) return;
    keep(std::move(found));
  }

  void keep(FoundMinimum found) {
    const DistanceMinimum& one = found.minimum;
    for (FoundMinimum& other : found_) {
      DistanceMinimum& kept = other.minimum;
      if (glm::length(kept.a.point - one.a.point) <= kOnePlace * size_ &&
          glm::length(kept.b.point - one.b.point) <= kOnePlace * size_) {
        kept.isolated = kept.isolated && one.isolated;
        return;
      }
    }
    found_.push_back(std::move(found));
  }

  Distance result() {
    join_non_isolated_minima(size_, found_);
    std::stable_sort(found_.begin(), found_.end(), [](const FoundMinimum& x, const FoundMinimum& y) {
      return x.minimum.distance < y.minimum.distance;
    });
    Distance result;
    result.meet = seen_.distance <= kIntersection * size_;
    const double most = nearest_ ? seen_.distance * (1 + kTie) + kEqualDistance * size_ : kInfinity;
    if (!(result.meet && stops_at_intersection_))
      for (FoundMinimum& one : found_)
        if (one.minimum.distance <= most) result.minima.push_back(std::move(one.minimum));
    // A place on a curve where surfaces meet; or one where the search decided nothing.
    if (result.minima.empty() || result.minima[0].distance > seen_.distance + kEqualDistance * size_) {
      result.minima.insert(result.minima.begin(), minimum_at(seen_.pair, seen_.a, seen_.b));
      result.minima[0].isolated = false;
      // It contradicts what the search says of all other places: nothing is certain.
      if (bound_ > seen_.distance) bound_ = 0;
    }
    result.distance = result.meet ? 0 : result.minima[0].distance;
    result.bound = result.meet ? 0 : std::clamp(bound_, 0.0, result.distance);
    return result;
  }

  bool nearest_, stops_at_intersection_ = false;
  Box3 all_;
  double size_ = 0;
  DistanceElements a_, b_;
  NearestSeen seen_;
  double bound_ = kInfinity;
  std::vector<ElementPair> flats_;
  std::vector<FoundMinimum> found_;
};

}  // namespace

static void demand_no_steps(const Distant& of) {
  const auto check = [](const Surface& surface) {
    const SteppedParts stepped = parts_between_steps(SurfacePtr(SurfacePtr(), &surface));
    demand_known(stepped);
    if (!stepped.parts.empty())
      throw std::invalid_argument("a surface whose formulas step has distances from points alone, all of them");
  };
  if (const auto* surface = std::get_if<const Surface*>(&of)) check(**surface);
  if (const auto* body = std::get_if<const Body*>(&of))
    for (const auto& face : (*body)->faces) check(*face.surface);
}

Distance distance(const Distant& a, const Distant& b, DistanceMinima wanted) {
  demand_no_steps(a), demand_no_steps(b);
  const auto *first = std::get_if<const Surface*>(&a), *second = std::get_if<const Surface*>(&b);
  if (first && second && !(*first)->bounded() && !(*second)->bounded())
    if (auto known = unbounded_distance(**first, **second)) return *std::move(known);
  return DistanceQuery(a, b, wanted == DistanceMinima::nearest).run();
}

}  // namespace lekalo::geometry
