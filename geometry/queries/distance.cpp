#include "geometry/queries/distance.h"

#include <algorithm>
#include <cmath>

#include "geometry/queries/distance_search.h"
#include "geometry/queries/projection.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

// Boxes are not halved below this part of the range.
constexpr double kLeastBox = 1e-8;
// Boxes of one size that may stay undecided before minima count as not isolated, by the number of unknowns; with four
// fewer where a descent shows that they are not.
constexpr int kMostBoxes[] = {0, 4096, 4096, 8192, 16384};
constexpr int kMostBoxesOfLevel = 1024;
// A slope along which the distance grows by less than this part of the size for its length is level.
constexpr double kLevel = 1e-8;
// Distances that differ by less than this part of the size are equal, points nearer than that one.
constexpr double kEqualDistance = 1e-12, kOnePlace = 1e-7;
// What is on the border of an element is found on that; what is not decided near to it too, about a pole.
constexpr double kOnBorder = 2 * kBorderSlack, kAtPole = 1e-7;
// A stationary place: the derivative over the entire range in parts of the square of the size.
constexpr double kStationary = 1e-8;
// From so far off, in parts of the range, an isolated minimum is found again within kFoundAgain.
constexpr double kBeside = 1e-3, kFoundAgain = 1e-5;

using Place2 = std::array<double, 2>;

struct Found {
  DistanceMinimum minimum;
  const DistanceElement *a, *b;
  bool absorbed = false, family = false;
};

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
    const auto has_patches = [](const DistanceElements& list) {
      return std::any_of(list.begin(), list.end(), [](const auto& element) { return element->dimension == 2; });
    };
    const bool wanted = nearest_;
    if (has_patches(a_) && has_patches(b_)) {
      nearest_ = stops_at_meeting_ = true;
      search_all();
      if (wanted || limit_ <= kMeeting * size_) return result();
      nearest_ = stops_at_meeting_ = false;
      found_.clear();
      flats_.clear();
      bound_ = kInfinity;
    }
    search_all();
    return result();
  }

 private:
  struct Pair {
    const DistanceElement *a, *b;
    double from;
    int unknowns() const { return a->dimension + b->dimension; }
  };

  static double distance_of(const Box3& a, const Box3& b) {
    return glm::length(glm::max(glm::max(a.lo - b.hi, b.lo - a.hi), Vec3(0)));
  }

  void search_all() {
    std::vector<Pair> pairs;
    for (const auto& a : a_)
      for (const auto& b : b_) pairs.push_back({a.get(), b.get(), distance_of(a->box, b->box)});
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
      return x.from != y.from ? x.from < y.from : x.unknowns() < y.unknowns();
    });
    for (const Pair& pair : pairs) {
      if (nearest_ && pair.from > limit_ * (1 + kTie) + kEqualDistance * size_) break;
      if (is_flat_pair(pair))
        flats_.push_back(pair);
      else
        search(pair);
      if (stops_at_meeting_ && limit_ <= kMeeting * size_) return;
    }
    absorb_in_flats();
  }

  // Two parallel elements that are straight or plane: where they are nearest to each other reaches to their borders,
  // so that it is found among these.
  bool is_flat_pair(const Pair& pair) const {
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

  void search(const Pair& pair) {
    switch (pair.unknowns()) {
      case 0: {
        const double distance = glm::length(pair.a->place.point - pair.b->place.point);
        limit_ = std::min(limit_, distance);
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
  void search(const Pair& pair) {
    const DistanceSystem<N> system(*pair.a, *pair.b, limit_, nearest_);
    const ParameterBox<N> domain = system.domain();
    if (nearest_ && N > 1) {
      // A low limit first: it leaves out most of the boxes.
      for (const ParameterPlace<N>& start : starts<N>(domain, N == 4 && pair.from <= kMeeting * size_ ? 3 : 1)) {
        const ParameterPlace<N> end = descended<N>(system, domain, start);
        system.evaluate(end);
        if (!stops_at_meeting_ || !(glm::length(system.way(end)) <= kMeeting * size_) || !system.keeps(end)) continue;
        keep({minimum_at(pair, system.of_a(end), system.of_b(end)), pair.a, pair.b});
        return;
      }
    }
    RootSearchOptions<N, N> options;
    options.most_boxes = N == 4 && seems_level<N>(pair, system) ? kMostBoxesOfLevel : kMostBoxes[N];
    for (int i = 0; i < N; ++i) {
      options.least[i] = kLeastBox * system.scale(i);
      options.slack[i] = kBorderSlack * system.scale(i);
    }
    const RootSearchResult<N> found = search_roots<N, N>(system, domain, options);
    for (const ParameterPlace<N>& at : found.isolated) {
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

  static bool is_on_border(const Pair& pair, const Place2& a, const Place2& b, double slack) {
    return pair.a->is_on_border(a, slack) || pair.b->is_on_border(b, slack);
  }

  // `count` places along each side of a box.
  template <int N>
  static std::vector<ParameterPlace<N>> starts(const ParameterBox<N>& box, int count) {
    std::vector<ParameterPlace<N>> result{{}};
    for (int i = 0; i < N; ++i) {
      std::vector<ParameterPlace<N>> more;
      for (const ParameterPlace<N>& place : result)
        for (int k = 0; k < count; ++k) {
          more.push_back(place);
          // Not where symmetric things are level.
          more.back()[i] = box[i].lo + box[i].width() * (k + 0.52 - 0.01 * i) / count;
        }
      result = std::move(more);
    }
    return result;
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
  void look_into(const Pair& pair, const DistanceSystem<N>& system, const ParameterBox<N>& box) {
    const ParameterBox<N> domain = system.domain();
    double own = kInfinity;
    bool level = false;
    for (const ParameterPlace<N>& start : starts<N>(box, is_wide<N>(system, box) ? 3 : 1)) {
      const ParameterPlace<N> end = descended<N>(system, domain, start);
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
    bound_ = std::min(bound_, lower_bound<N>(system, box, std::min(limit_, own) - 1e-15 * size_));
  }

  // Whether descents end where places beside are as near, or at a pole, about which all parameters are.
  template <int N>
  static bool seems_level(const Pair& pair, const DistanceSystem<N>& system) {
    const ParameterBox<N> domain = system.domain();
    for (const ParameterPlace<N>& start : starts<N>(domain, 2)) {
      const ParameterPlace<N> end = descended<N>(system, domain, start);
      const auto singular = [](const DistanceElement& element, const Place2& at) {
        const ElementJet jet = element.jet(at);
        for (int i = 0; i < element.dimension; ++i)
          if (glm::length(jet.first[i]) * element.scale[i] <= 1e-6 * element.box.diameter()) return true;
        return false;
      };
      if (singular(*pair.a, system.of_a(end)) || singular(*pair.b, system.of_b(end))) return true;
      bool inner = true;
      for (int i = 0; i < N; ++i) inner = inner && end[i] > domain[i].lo && end[i] < domain[i].hi;
      if (inner && !is_found_again<N>(system, end)) return true;
    }
    return false;
  }

  template <int N>
  static bool is_wide(const DistanceSystem<N>& system, const ParameterBox<N>& box) {
    for (int i = 0; i < N; ++i)
      if (box[i].width() > kFoundAgain * system.scale(i)) return true;
    return false;
  }

  template <int N>
  static bool is_found_again(const DistanceSystem<N>& system, const ParameterPlace<N>& at) {
    const ParameterBox<N> domain = system.domain();
    for (int i = 0; i < N; ++i)
      for (const double side : {1.0, -1.0}) {
        ParameterPlace<N> beside = at;
        beside[i] = domain[i].clamp(at[i] + side * kBeside * system.scale(i));
        const ParameterPlace<N> end = descended<N>(system, domain, beside);
        for (int k = 0; k < N; ++k)
          if (std::abs(end[k] - at[k]) > kFoundAgain * system.scale(k)) return false;
      }
    return true;
  }

  template <int N>
  static std::array<std::array<Interval, 2>, 2> ranges_of(const Pair& pair, const ParameterBox<N>& box) {
    std::array<std::array<Interval, 2>, 2> result{};
    for (int i = 0; i < N; ++i) (i < pair.a->dimension ? result[0][i] : result[1][i - pair.a->dimension]) = box[i];
    return result;
  }

  DistanceMinimum minimum_at(const Pair& pair, const Place2& a, const Place2& b) const {
    DistanceMinimum minimum;
    minimum.a = pair.a->place_at(a), minimum.b = pair.b->place_at(b);
    minimum.distance = glm::length(minimum.a.point - minimum.b.point);
    set_ranges(minimum.a, minimum.range_a);
    set_ranges(minimum.b, minimum.range_b);
    return minimum;
  }
  static bool has_two(const DistancePlace& place) {
    return place.kind == DistancePlace::Kind::surface || place.kind == DistancePlace::Kind::face;
  }
  static void set_ranges(const DistancePlace& place, std::array<Interval, 2>& range) {
    range = has_two(place) ? std::array<Interval, 2>{Interval(place.u), Interval(place.v)}
                           : std::array<Interval, 2>{Interval(place.t), Interval(0)};
  }

  // A minimum on the two elements is one on the whole where the distance grows into what is beside them.
  void consider(const Pair& pair, const Place2& a, const Place2& b, bool isolated,
                const std::array<std::array<Interval, 2>, 2>& ranges = {}) {
    Found found{minimum_at(pair, a, b), pair.a, pair.b};
    DistanceMinimum& minimum = found.minimum;
    if (nearest_ && minimum.distance > limit_ * (1 + kTie) + kEqualDistance * size_) return;
    minimum.isolated = isolated;
    if (!isolated) {
      if (pair.a->dimension == 2 || !has_two(minimum.a)) minimum.range_a = ranges[0];
      if (pair.b->dimension == 2 || !has_two(minimum.b)) minimum.range_b = ranges[1];
    }
    const std::vector<DistanceStep> from_a = steps(*pair.a, a), from_b = steps(*pair.b, b);
    if (minimum.distance > kMeeting * size_) {
      const Vec3 to_b = (minimum.b.point - minimum.a.point) / minimum.distance;
      if (!grows(from_a, to_b, *pair.b, b, from_b, minimum) || !grows(from_b, -to_b, *pair.a, a, from_a, minimum))
        return;
    } else if (!from_a.empty() && !from_b.empty()) {
      // Two borders that meet: what is beside them may do so along a curve.
      minimum.isolated = minimum.isolated && !meets_beside(from_a, from_b);
    }
    keep(std::move(found));
  }

  static std::vector<DistanceStep> steps(const DistanceElement& element, const Place2& at) {
    return element.steps ? element.steps(at) : std::vector<DistanceStep>();
  }

  // The distance from the one's neighbours, `towards` the other. Where it is level to first order it is compared a
  // little way off.
  bool grows(const std::vector<DistanceStep>& off, const Vec3& towards, const DistanceElement& other,
             const Place2& other_at, const std::vector<DistanceStep>& other_steps, DistanceMinimum& minimum) const {
    for (const DistanceStep& step : off) {
      const ElementJet jet = step.into->jet(step.at);
      Vec3 ahead(0);
      for (int i = 0; i < step.into->dimension; ++i) ahead += step.direction[i] * step.into->scale[i] * jet.first[i];
      // At a cusp or pole the tangent is where the next place lies.
      if (!(glm::length(ahead) > kLevel * size_)) ahead = step.into->at(step.moved(1e-2 * kSmallStep)) - jet.point;
      const double length = glm::length(ahead);
      if (!(length > 0)) continue;
      const double slope = glm::dot(towards, ahead) / length;
      if (slope * minimum.distance > kLevel * size_) return false;
      if (slope * minimum.distance < -kLevel * size_) continue;
      const double beside = distance_from(step.into->at(step.moved(kSmallStep)), other, other_at, other_steps);
      if (beside < minimum.distance - kEqualDistance * size_) return false;
      if (beside <= minimum.distance + kEqualDistance * size_ || is_level_beside(step, other, other_at, other_steps))
        minimum.isolated = false;
    }
    return true;
  }

  // Whether a descent from the end of the step, both places free, ends elsewhere.
  bool is_level_beside(const DistanceStep& step, const DistanceElement& other, const Place2& other_at,
                       const std::vector<DistanceStep>& other_steps) const {
    const auto stays_off = [&](const DistanceElement& element, const Place2& at) {
      const Pair pair{step.into, &element, 0};
      switch (pair.unknowns()) {
        case 1:
          return ends_beside<1>(pair, step, at);
        case 2:
          return ends_beside<2>(pair, step, at);
        case 3:
          return ends_beside<3>(pair, step, at);
        default:
          return ends_beside<4>(pair, step, at);
      }
    };
    if (stays_off(other, other_at)) return true;
    return std::any_of(other_steps.begin(), other_steps.end(),
                       [&](const DistanceStep& one) { return stays_off(*one.into, one.at); });
  }
  template <int N>
  bool ends_beside(const Pair& pair, const DistanceStep& step, const Place2& at) const {
    double limit = kInfinity;
    const DistanceSystem<N> system(*pair.a, *pair.b, limit, false);
    const Place2 moved = step.moved(kSmallStep);
    ParameterPlace<N> start, end;
    for (int i = 0; i < N; ++i) start[i] = i < pair.a->dimension ? moved[i] : at[i - pair.a->dimension];
    end = descended<N>(system, system.domain(), start);
    if (!system.keeps(end)) return false;
    const Vec3 before = step.into->at(step.at), point = step.into->at(system.of_a(end));
    return glm::length(point - before) > 0.1 * glm::length(step.into->at(moved) - before);
  }

  // Of a point from an element about a place on it, and from its neighbours.
  double distance_from(const Vec3& point, const DistanceElement& element, const Place2& at,
                       const std::vector<DistanceStep>& steps) const {
    DistanceElement of_point;
    of_point.place.point = point;
    double least = least_distance(of_point, element, at);
    for (const DistanceStep& step : steps) least = std::min(least, least_distance(of_point, *step.into, step.at));
    return least;
  }
  static double least_distance(const DistanceElement& point, const DistanceElement& element, const Place2& at) {
    double limit = kInfinity;
    const auto from = [&](const auto& start) {
      constexpr int n = std::tuple_size_v<std::decay_t<decltype(start)>>;
      const DistanceSystem<n> system(point, element, limit, false);
      const auto end = descended<n>(system, system.domain(), start);
      return system.keeps(end) ? glm::length(system.way(end)) : kInfinity;
    };
    if (element.dimension == 1) return from(ParameterPlace<1>{at[0]});
    if (element.dimension == 2) return from(ParameterPlace<2>{at[0], at[1]});
    return glm::length(point.place.point - element.place.point);
  }

  bool meets_beside(const std::vector<DistanceStep>& from_a, const std::vector<DistanceStep>& from_b) const {
    for (const DistanceStep& step : from_a) {
      const Vec3 beside = step.into->at(step.moved(kSmallStep));
      for (const DistanceStep& other : from_b) {
        DistanceElement of_point;
        of_point.place.point = beside;
        if (least_distance(of_point, *other.into, other.at) <= kMeeting * size_) return true;
      }
    }
    return false;
  }

  void keep(Found found) {
    const DistanceMinimum& one = found.minimum;
    for (Found& other : found_) {
      DistanceMinimum& kept = other.minimum;
      if (glm::length(kept.a.point - one.a.point) <= kOnePlace * size_ &&
          glm::length(kept.b.point - one.b.point) <= kOnePlace * size_) {
        kept.isolated = kept.isolated && one.isolated;
        return;
      }
    }
    found_.push_back(std::move(found));
  }

  // The parameters of a point on an element, if it lies on it.
  std::optional<Place2> place_on(const DistanceElement& element, const Vec3& point) const {
    double limit = kInfinity;
    DistanceElement of_point;
    of_point.place.point = point;
    const auto from = [&](auto start) -> std::optional<Place2> {
      constexpr int n = std::tuple_size_v<decltype(start)>;
      const DistanceSystem<n> system(of_point, element, limit, false);
      for (const auto& place : starts<n>(system.domain(), 4)) {
        const auto end = descended<n>(system, system.domain(), place);
        if (glm::length(system.way(end)) <= kOnePlace * size_) return system.of_b(end);
      }
      return std::nullopt;
    };
    return element.dimension == 1 ? from(ParameterPlace<1>{}) : from(ParameterPlace<2>{});
  }

  // Places as near as each other on two parallel straight or plane elements are one minimum that is not isolated.
  void absorb_in_flats() {
    std::stable_sort(flats_.begin(), flats_.end(),
                     [](const Pair& x, const Pair& y) { return x.unknowns() > y.unknowns(); });
    for (int unknowns = 4; unknowns >= 2; --unknowns) {
      std::vector<Found> families;
      std::vector<size_t> members;
      for (const Pair& pair : flats_)
        if (pair.unknowns() == unknowns) add_family(pair, families, members);
      for (const size_t k : members) found_[k].absorbed = true;
      found_.insert(found_.end(), families.begin(), families.end());
    }
    std::erase_if(found_, [](const Found& one) { return one.absorbed; });
  }
  void add_family(const Pair& pair, std::vector<Found>& families, std::vector<size_t>& members) const {
    std::optional<Found> family;
    size_t count = 0;
    for (size_t k = 0; k < found_.size(); ++k) {
      const Found& one = found_[k];
      if (one.minimum.isolated || one.absorbed || one.family) continue;
      // Two planes that are not parallel are level nowhere.
      if (pair.unknowns() == 4 && !is_along(pair, one.minimum.b.point - one.minimum.a.point)) continue;
      if (!pair.a->box.inflated(kOnePlace * size_).contains(one.minimum.a.point) ||
          !pair.b->box.inflated(kOnePlace * size_).contains(one.minimum.b.point))
        continue;
      const auto a = place_on(*pair.a, one.minimum.a.point), b = place_on(*pair.b, one.minimum.b.point);
      if (!a || !b) continue;
      if (family && std::abs(family->minimum.distance - one.minimum.distance) > kEqualDistance * size_) continue;
      if (!family) family = {minimum_at(pair, *a, *b), pair.a, pair.b};
      widen(*family, *a, *b);
      members.push_back(k);
      ++count;
    }
    // Other borders of where they are as near may have something nearer beside them, or a closed line none.
    if (family && pair.unknowns() > 2) count += widen_inside(pair, *family);
    if (count < 2) {
      members.resize(members.size() - count);
      return;
    }
    family->minimum.isolated = false;
    family->family = true;
    families.push_back(std::move(*family));
  }
  // Whether the way is across both planes.
  static bool is_along(const Pair& pair, const Vec3& way) {
    const double far = 1e-6 * glm::length(way);
    return glm::length(glm::cross(pair.a->axis, way)) <= far && glm::length(glm::cross(pair.b->axis, way)) <= far;
  }
  static void widen(Found& family, const Place2& a, const Place2& b) {
    for (int i = 0; i < 2; ++i) {
      if (i < family.a->dimension && has_own(*family.a))
        family.minimum.range_a[i] = hull(family.minimum.range_a[i], Interval(a[i]));
      if (i < family.b->dimension && has_own(*family.b))
        family.minimum.range_b[i] = hull(family.minimum.range_b[i], Interval(b[i]));
    }
  }
  // Places of the first that are as near to the second; how many.
  size_t widen_inside(const Pair& pair, Found& family) const {
    constexpr int kPlaces = 8;
    const bool from_a = pair.a->dimension <= pair.b->dimension;
    const DistanceElement &from = from_a ? *pair.a : *pair.b, &to = from_a ? *pair.b : *pair.a;
    const Vec3 way = (from_a ? 1.0 : -1.0) * (family.minimum.b.point - family.minimum.a.point);
    size_t count = 0;
    for (int i = 0; i <= kPlaces; ++i)
      for (int j = 0; j <= (from.dimension == 2 ? kPlaces : 0); ++j) {
        const Place2 at{from.domain[0].lo + from.domain[0].width() * i / kPlaces,
                        from.domain[1].lo + from.domain[1].width() * j / kPlaces};
        if (!from.keeps(at)) continue;
        const auto foot = place_on(to, from.at(at) + way);
        if (!foot || !to.keeps(*foot)) continue;
        from_a ? widen(family, at, *foot) : widen(family, *foot, at);
        ++count;
      }
    return count;
  }

  // Its parameters are those of its place.
  static bool has_own(const DistanceElement& element) { return !element.held_u && !element.held_v; }

  // Parts of one family on neighbouring pieces become one; a border of it is not another.
  void join_families() {
    const auto is_as_far = [&](const Found& x, const Found& y) {
      return std::abs(x.minimum.distance - y.minimum.distance) <= 1e3 * kEqualDistance * size_;
    };
    const auto touch = [](const std::array<Interval, 2>& x, const std::array<Interval, 2>& y,
                          const std::array<double, 2>& scale) {
      for (int i = 0; i < 2; ++i)
        if (x[i].lo > y[i].hi + 1e-6 * scale[i] || y[i].lo > x[i].hi + 1e-6 * scale[i]) return false;
      return true;
    };
    const auto is_same = [](const DistancePlace& x, const DistancePlace& y) {
      return x.kind == y.kind && x.index == y.index;
    };
    for (size_t k = 0; k < found_.size(); ++k) {
      if (found_[k].minimum.isolated || found_[k].absorbed) continue;
      for (size_t i = 0; i < found_.size(); ++i) {
        DistanceMinimum &x = found_[k].minimum, &y = found_[i].minimum;
        if (i == k || y.isolated || found_[i].absorbed || !is_as_far(found_[k], found_[i])) continue;
        if (is_same(x.a, y.a) && is_same(x.b, y.b) && touch(x.range_a, y.range_a, found_[k].a->scale) &&
            touch(x.range_b, y.range_b, found_[k].b->scale)) {
          for (int j = 0; j < 2; ++j) {
            x.range_a[j] = hull(x.range_a[j], y.range_a[j]);
            x.range_b[j] = hull(x.range_b[j], y.range_b[j]);
          }
          found_[i].absorbed = true;
          i = static_cast<size_t>(-1);
        }
      }
    }
    // What is in a family or on its border stands for it no more: on the corners of its pieces too.
    for (Found& one : found_) {
      if (one.absorbed) continue;
      for (const Found& family : found_) {
        if (&family == &one || family.absorbed || family.minimum.isolated || !is_as_far(one, family)) continue;
        const int own = one.a->dimension + one.b->dimension, its = family.a->dimension + family.b->dimension;
        if (own > its || (own == its && !one.minimum.isolated)) continue;
        const double wide = 1e-6 * size_;
        if (family.a->range(ranges_on(family.minimum.range_a, *family.a))
                .point.inflated(wide)
                .contains(one.minimum.a.point) &&
            family.b->range(ranges_on(family.minimum.range_b, *family.b))
                .point.inflated(wide)
                .contains(one.minimum.b.point)) {
          one.absorbed = true;
          break;
        }
      }
    }
    std::erase_if(found_, [](const Found& one) { return one.absorbed; });
  }
  // What of an element a minimum reaches over (on neighbouring pieces too); all of a parameter line.
  static std::array<Interval, 2> ranges_on(const std::array<Interval, 2>& range, const DistanceElement& element) {
    return has_own(element) ? range : element.domain;
  }

  Distance result() {
    join_families();
    std::stable_sort(found_.begin(), found_.end(),
                     [](const Found& x, const Found& y) { return x.minimum.distance < y.minimum.distance; });
    Distance result;
    result.meet = !found_.empty() && found_[0].minimum.distance <= kMeeting * size_;
    for (Found& one : found_) {
      if (nearest_ && one.minimum.distance > limit_ * (1 + kTie) + kEqualDistance * size_) continue;
      result.minima.push_back(std::move(one.minimum));
      if (result.meet && stops_at_meeting_) break;
    }
    result.distance = result.meet || found_.empty() ? 0 : result.minima[0].distance;
    result.bound = result.meet ? 0 : std::clamp(bound_, 0.0, result.distance);
    return result;
  }

  bool nearest_, stops_at_meeting_ = false;
  Box3 all_;
  double size_ = 0;
  DistanceElements a_, b_;
  double limit_ = kInfinity;  // the least distance seen
  double bound_ = kInfinity;
  std::vector<Pair> flats_;
  std::vector<Found> found_;
};

}  // namespace

Distance distance(const Distant& a, const Distant& b, DistanceMinima wanted) {
  return DistanceQuery(a, b, wanted == DistanceMinima::nearest).run();
}

}  // namespace lekalo::geometry
