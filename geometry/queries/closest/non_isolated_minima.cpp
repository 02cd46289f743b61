#include "geometry/queries/closest/non_isolated_minima.h"

#include <algorithm>

#include "geometry/curves/operations/uneven_places.h"

namespace lekalo::geometry {

namespace {

DistanceElement element_of(const Vec3& point) {
  DistanceElement element;
  element.place.point = point;
  return element;
}

// The parameters of a point on an element, if it lies on it.
std::optional<ElementPlace> place_on(const DistanceElement& element, const Vec3& point, double size,
                                     double within = kOnePlace) {
  const DistanceElement of_point = element_of(point);
  const auto from = [&](auto start) -> std::optional<ElementPlace> {
    constexpr int n = std::tuple_size_v<decltype(start)>;
    const DistanceSystem<n> system({&of_point, &element});
    for (const auto& place : starts<n>(system.domain(), 4)) {
      const auto end = descended<n>(system, system.domain(), place);
      if (glm::length(system.way(end)) <= within * size) return system.of_b(end);
    }
    return std::nullopt;
  };
  return element.dimension == 1 ? from(ParameterPoint<1>{}) : from(ParameterPoint<2>{});
}

// Of a point that moves along curved patches. It stays on the sheet on which it was, where several meet.
class PlaceOnPatches {
 public:
  PlaceOnPatches(const DistanceElements& elements, double size) : size_(size) {
    for (const auto& element : elements)
      if (element->dimension == 2 && !element->flat) patches_.push_back(element.get());
  }

  // False where the point is on none.
  bool move_to(const Vec3& point) {
    if (patch_ && follow(point)) return true;
    for (const DistanceElement* patch : patches_) {
      if (!patch->box.inflated(kIntersection * size_).contains(point)) continue;
      const auto found = place_on(*patch, point, size_, kIntersection);
      if (!found || !patch->keeps(*found)) continue;
      patch_ = patch, place_ = *found;
      return true;
    }
    return false;
  }
  const DistanceElement& patch() const { return *patch_; }
  const ElementPlace& place() const { return place_; }

 private:
  bool follow(const Vec3& point) {
    const DistanceElement of_point = element_of(point);
    const DistanceSystem<2> system({&of_point, patch_});
    const ParameterPoint<2> end = descended<2>(system, system.domain(), {place_[0], place_[1]});
    if (!(glm::length(system.way(end)) <= kIntersection * size_) || !system.keeps(end)) return false;
    place_ = system.of_b(end);
    return true;
  }

  double size_;
  std::vector<const DistanceElement*> patches_;
  const DistanceElement* patch_ = nullptr;
  ElementPlace place_{};
};

// Its parameters are those of its place.
bool has_own(const DistanceElement& element) { return !element.held_u && !element.held_v; }

// Whether the way is across both planes.
bool is_along(const ElementPair& pair, const Vec3& way) {
  const double far = 1e-6 * glm::length(way);
  return glm::length(glm::cross(pair.a->axis, way)) <= far && glm::length(glm::cross(pair.b->axis, way)) <= far;
}
void widen(FoundMinimum& family, const ElementPlace& a, const ElementPlace& b) {
  for (int i = 0; i < 2; ++i) {
    if (i < family.a->dimension && has_own(*family.a))
      family.minimum.range_a[i] = hull(family.minimum.range_a[i], Interval(a[i]));
    if (i < family.b->dimension && has_own(*family.b))
      family.minimum.range_b[i] = hull(family.minimum.range_b[i], Interval(b[i]));
  }
}
// Places of the first that are as near to the second; how many.
size_t widen_inside(const ElementPair& pair, FoundMinimum& family, double size) {
  constexpr int kPlaces = 8;
  const bool from_a = pair.a->dimension <= pair.b->dimension;
  const DistanceElement &from = from_a ? *pair.a : *pair.b, &to = from_a ? *pair.b : *pair.a;
  const Vec3 way = (from_a ? 1.0 : -1.0) * (family.minimum.b.point - family.minimum.a.point);
  size_t count = 0;
  for (int i = 0; i <= kPlaces; ++i)
    for (int j = 0; j <= (from.dimension == 2 ? kPlaces : 0); ++j) {
      const ElementPlace at{from.domain[0].lo + from.domain[0].width() * i / kPlaces,
                            from.domain[1].lo + from.domain[1].width() * j / kPlaces};
      if (!from.keeps(at)) continue;
      const auto foot_point = place_on(to, from.at(at) + way, size);
      if (!foot_point || !to.keeps(*foot_point)) continue;
      from_a ? widen(family, at, *foot_point) : widen(family, *foot_point, at);
      ++count;
    }
  return count;
}

void add_family(const ElementPair& pair, const std::vector<FoundMinimum>& found, double size,
                std::vector<FoundMinimum>& families, std::vector<size_t>& members) {
  std::optional<FoundMinimum> family;
  size_t count = 0;
  for (size_t k = 0; k < found.size(); ++k) {
    const FoundMinimum& one = found[k];
    if (one.minimum.isolated || one.absorbed || one.family) continue;
    // Two planes that are not parallel are level nowhere.
    if (pair.unknowns() == 4 && !is_along(pair, one.minimum.b.point - one.minimum.a.point)) continue;
    if (!pair.a->box.inflated(kOnePlace * size).contains(one.minimum.a.point) ||
        !pair.b->box.inflated(kOnePlace * size).contains(one.minimum.b.point))
      continue;
    const auto a = place_on(*pair.a, one.minimum.a.point, size), b = place_on(*pair.b, one.minimum.b.point, size);
    if (!a || !b) continue;
    if (family && std::abs(family->minimum.distance - one.minimum.distance) > kEqualDistance * size) continue;
    if (!family) family = {minimum_at(pair, *a, *b), pair.a, pair.b};
    widen(*family, *a, *b);
    members.push_back(k);
    ++count;
  }
  // Other borders of where they are as near may have something nearer beside them, or a closed line none.
  if (family && pair.unknowns() > 2) count += widen_inside(pair, *family, size);
  if (count < 2) {
    members.resize(members.size() - count);
    return;
  }
  family->minimum.isolated = false;
  family->family = true;
  families.push_back(std::move(*family));
}

bool is_as_far(const FoundMinimum& x, const FoundMinimum& y, double size) {
  return std::abs(x.minimum.distance - y.minimum.distance) <= 1e3 * kEqualDistance * size;
}

// What of an element a minimum reaches over (on neighbouring pieces too); all of a parameter line.
std::array<Interval, 2> ranges_on(const std::array<Interval, 2>& range, const DistanceElement& element) {
  return has_own(element) ? range : element.domain;
}

// What is in a family or on its border stands for it no more: on the corners of its pieces too.
void absorb_borders(double size, std::vector<FoundMinimum>& found) {
  for (FoundMinimum& one : found) {
    if (one.absorbed) continue;
    for (const FoundMinimum& family : found) {
      if (&family == &one || family.absorbed || family.minimum.isolated || !is_as_far(one, family, size)) continue;
      const int own = one.a->dimension + one.b->dimension, its = family.a->dimension + family.b->dimension;
      if (own > its || (own == its && !one.minimum.isolated)) continue;
      const double wide = 1e-6 * size;
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
}

}  // namespace

void merge_minima_of_parallels(std::vector<ElementPair> flats, double size, std::vector<FoundMinimum>& found) {
  std::stable_sort(flats.begin(), flats.end(),
                   [](const ElementPair& x, const ElementPair& y) { return x.unknowns() > y.unknowns(); });
  for (int unknowns = 4; unknowns >= 2; --unknowns) {
    std::vector<FoundMinimum> families;
    std::vector<size_t> members;
    for (const ElementPair& pair : flats)
      if (pair.unknowns() == unknowns) add_family(pair, found, size, families, members);
    for (const size_t k : members) found[k].absorbed = true;
    found.insert(found.end(), families.begin(), families.end());
  }
  std::erase_if(found, [](const FoundMinimum& one) { return one.absorbed; });
}

std::vector<FoundMinimum> minima_of_curve_on_patches(const DistanceElements& a, const DistanceElements& b,
                                                     double size) {
  const auto is_curve = [](const DistanceElements& elements) {
    return std::any_of(elements.begin(), elements.end(), [](const auto& element) {
      return element->place.kind == DistancePlace::Kind::curve && element->dimension == 1;
    });
  };
  const bool from_a = is_curve(a);
  if (!from_a && !is_curve(b)) return {};
  PlaceOnPatches foot_point(from_a ? b : a, size);
  std::vector<FoundMinimum> found;
  for (const auto& line : from_a ? a : b) {
    if (line->dimension != 1) continue;
    for (int i = 0; i <= kPlacesOfCommonPart; ++i) {
      const ElementPlace at{line->domain[0].lo + line->domain[0].width() * share_of_place(i)};
      if (!foot_point.move_to(line->at(at))) return {};
      const DistanceElement& patch = foot_point.patch();
      const ElementPair pair = from_a ? ElementPair{line.get(), &patch} : ElementPair{&patch, line.get()};
      const ElementPlace &at_a = from_a ? at : foot_point.place(), &at_b = from_a ? foot_point.place() : at;
      const auto known = std::find_if(found.begin(), found.end(), [&](const FoundMinimum& one) {
        return (from_a ? one.b : one.a)->place.index == patch.place.index;
      });
      if (known == found.end()) {
        found.push_back({minimum_at(pair, at_a, at_b), pair.a, pair.b, false, true});
        found.back().minimum.isolated = false;
      } else {
        widen(*known, at_a, at_b);
      }
    }
  }
  return found;
}

void join_non_isolated_minima(double size, std::vector<FoundMinimum>& found) {
  const auto touch = [](const std::array<Interval, 2>& x, const std::array<Interval, 2>& y,
                        const std::array<double, 2>& scale) {
    for (int i = 0; i < 2; ++i)
      if (x[i].lo > y[i].hi + 1e-6 * scale[i] || y[i].lo > x[i].hi + 1e-6 * scale[i]) return false;
    return true;
  };
  const auto is_same = [](const DistancePlace& x, const DistancePlace& y) {
    return x.kind == y.kind && x.index == y.index;
  };
  for (size_t k = 0; k < found.size(); ++k) {
    if (found[k].minimum.isolated || found[k].absorbed) continue;
    for (size_t i = 0; i < found.size(); ++i) {
      DistanceMinimum &x = found[k].minimum, &y = found[i].minimum;
      if (i == k || y.isolated || found[i].absorbed || !is_as_far(found[k], found[i], size)) continue;
      if (is_same(x.a, y.a) && is_same(x.b, y.b) && touch(x.range_a, y.range_a, found[k].a->scale) &&
          touch(x.range_b, y.range_b, found[k].b->scale)) {
        for (int j = 0; j < 2; ++j) {
          x.range_a[j] = hull(x.range_a[j], y.range_a[j]);
          x.range_b[j] = hull(x.range_b[j], y.range_b[j]);
        }
        found[i].absorbed = true;
        i = static_cast<size_t>(-1);
      }
    }
  }
  absorb_borders(size, found);
  std::erase_if(found, [](const FoundMinimum& one) { return one.absorbed; });
}

}  // namespace lekalo::geometry
