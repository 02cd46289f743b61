#include "geometry/queries/closest/distance_neighbours.h"

namespace lekalo::geometry {

namespace {

std::vector<DistanceStep> steps(const DistanceElement& element, const ElementPlace& at) {
  return element.steps ? element.steps(at) : std::vector<DistanceStep>();
}

// Downhill to the element about a place on it.
double min_distance(const DistanceElement& point, const DistanceElement& element, const ElementPlace& at) {
  const auto from = [&](const auto& start) {
    constexpr int n = std::tuple_size_v<std::decay_t<decltype(start)>>;
    const DistanceSystem<n> system({&point, &element});
    const auto end = descended<n>(system, system.domain(), start);
    return system.keeps(end) ? glm::length(system.way(end)) : kInfinity;
  };
  if (element.dimension == 1) return from(ParameterPoint<1>{at[0]});
  if (element.dimension == 2) return from(ParameterPoint<2>{at[0], at[1]});
  return glm::length(point.place.point - element.place.point);
}

// Of a point from an element about a place on it, and from its neighbours.
double distance_from(const Vec3& point, const DistanceElement& element, const ElementPlace& at,
                     const std::vector<DistanceStep>& steps) {
  DistanceElement of_point;
  of_point.place.point = point;
  double least = min_distance(of_point, element, at);
  for (const DistanceStep& step : steps) least = std::min(least, min_distance(of_point, *step.into, step.at));
  return least;
}
template <int N>
bool ends_beside(const ElementPair& pair, const DistanceStep& step, const ElementPlace& at) {
  const DistanceSystem<N> system(pair);
  const ElementPlace moved = step.moved(kSmallStep);
  ParameterPoint<N> start, end;
  for (int i = 0; i < N; ++i) start[i] = i < pair.a->dimension ? moved[i] : at[i - pair.a->dimension];
  end = descended<N>(system, system.domain(), start);
  if (!system.keeps(end)) return false;
  const Vec3 before = step.into->at(step.at), point = step.into->at(system.of_a(end));
  return glm::length(point - before) > 0.1 * glm::length(step.into->at(moved) - before);
}

// Whether a descent from the end of the step, both places free, ends elsewhere.
bool is_level_beside(const DistanceStep& step, const DistanceElement& other, const ElementPlace& other_at,
                     const std::vector<DistanceStep>& other_steps) {
  const auto stays_off = [&](const DistanceElement& element, const ElementPlace& at) {
    const ElementPair pair{step.into, &element};
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
// The distance from the one's neighbours, `towards` the other. Where it is level to first order it is compared a
// little way off.
bool grows(const std::vector<DistanceStep>& off, const Vec3& towards, const DistanceElement& other,
           const ElementPlace& other_at, const std::vector<DistanceStep>& other_steps, double size,
           DistanceMinimum& minimum) {
  for (const DistanceStep& step : off) {
    const ElementJet jet = step.into->jet(step.at);
    Vec3 ahead(0);
    for (int i = 0; i < step.into->dimension; ++i) ahead += step.direction[i] * step.into->scale[i] * jet.first[i];
    // At a cusp or pole the tangent is where the next place lies.
    if (!(glm::length(ahead) > kLevel * size)) ahead = step.into->at(step.moved(1e-2 * kSmallStep)) - jet.point;
    const double length = glm::length(ahead);
    // Along an edge that is one point there is no way off.
    if (!(length > kEqualDistance * size)) continue;
    const double slope = glm::dot(towards, ahead) / length;
    if (slope * minimum.distance > kLevel * size) return false;
    if (slope * minimum.distance < -kLevel * size) continue;
    const double beside = distance_from(step.into->at(step.moved(kSmallStep)), other, other_at, other_steps);
    if (beside < minimum.distance - kEqualDistance * size) return false;
    if (beside <= minimum.distance + kEqualDistance * size || is_level_beside(step, other, other_at, other_steps))
      minimum.isolated = false;
  }
  return true;
}

// Whether two borders that meet do so along a curve, in what is beside them.
bool meets_beside(const std::vector<DistanceStep>& from_a, const std::vector<DistanceStep>& from_b, double size) {
  for (const DistanceStep& step : from_a) {
    const Vec3 beside = step.into->at(step.moved(kSmallStep));
    for (const DistanceStep& other : from_b) {
      DistanceElement of_point;
      of_point.place.point = beside;
      if (min_distance(of_point, *other.into, other.at) <= kIntersection * size) return true;
    }
  }
  return false;
}

}  // namespace

bool is_minimum_beside(const ElementPair& pair, const ElementPlace& a, const ElementPlace& b, double size,
                       DistanceMinimum& minimum) {
  const std::vector<DistanceStep> from_a = steps(*pair.a, a), from_b = steps(*pair.b, b);
  if (minimum.distance <= kIntersection * size) {
    if (!from_a.empty() && !from_b.empty() && meets_beside(from_a, from_b, size)) minimum.isolated = false;
    return true;
  }
  const Vec3 to_b = (minimum.b.point - minimum.a.point) / minimum.distance;
  return grows(from_a, to_b, *pair.b, b, from_b, size, minimum) &&
         grows(from_b, -to_b, *pair.a, a, from_a, size, minimum);
}

}  // namespace lekalo::geometry
