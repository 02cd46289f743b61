#include "geometry/queries/implicit_arc_collector.h"

#include <algorithm>
#include <cmath>

#include "geometry/curves/polynomial_approximation.h"

namespace lekalo::geometry::implicit_arc {

namespace {

// Of the region's diameter: ends of arcs from the place at which they end, the shortest arc, and how well polynomials
// agree with it.
constexpr double kNearSingular = 1e-4, kShortest = 1e-9;
constexpr double kAgree[] = {1e-13, 1e-11, 1e-9};

// Solves F = level, the second equation, and n . (p - q) = 0 near q, n a unit vector; none where Newton's iteration
// leads farther away than `reach`.
std::optional<Vec3> solved(const ImplicitFormula& formula, const ImplicitCondition& condition, const Vec3& q,
                           const Vec3& n, double reach) {
  constexpr int kMostSteps = 20;
  Vec3 p = q;
  double before = kInfinity;
  for (int step = 0; step < kMostSteps; ++step) {
    const SecondOrder<double> f = second_order(formula, p);
    const auto second = condition.at(f, triple(p));
    const root_search::Matrix<3> rows{{{f.gradient.x, f.gradient.y, f.gradient.z},
                                       {second.gradient.x, second.gradient.y, second.gradient.z},
                                       {n.x, n.y, n.z}}};
    root_search::Matrix<3> inverse;
    if (!root_search::invert<3>(rows, inverse)) return std::nullopt;
    const double values[] = {f.value, second.value, glm::dot(n, p - q)};
    Vec3 by(0);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) by[i] += inverse[i][k] * values[k];
    p -= by;
    const double length = glm::length(by);
    if (!(glm::length(p - q) <= reach)) return std::nullopt;
    // Until the steps are rounding and no longer get shorter.
    if (length == 0 || (length < 1e-9 * reach && length >= 0.5 * before)) return p;
    before = length;
  }
  return before < 1e-9 * reach ? std::optional(p) : std::nullopt;
}

}  // namespace

SecondOrder<Interval> thin(const ImplicitFormula& formula, const Vec3& p) {
  return SecondOrder<Interval>::of(formula.with_second(Interval(p.x), Interval(p.y), Interval(p.z)));
}

double rounding_in(const Box3& box, const std::function<double(const Vec3&)>& width) {
  constexpr int kPlaces = 5;
  double most = 0;
  for (int k = 0; k < kPlaces * kPlaces * kPlaces; ++k) {
    const Vec3 share = (Vec3(k % kPlaces, k / kPlaces % kPlaces, k / (kPlaces * kPlaces)) + 0.5) / double(kPlaces);
    const double here = width(box.lo + share * box.size());
    if (here < kInfinity) most = std::max(most, here);
  }
  return 2 * most;
}

Collector::Collector(const ImplicitSurface& surface, const ImplicitCondition& condition)
    : formula_(surface.formula()), region_(surface.region()), condition_(condition), size_(region_.box.diameter()) {}

void Collector::add(std::vector<Vec3> nodes, bool closed, bool begins_singular, bool ends_singular) {
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  if (nodes.size() < 2) return;
  bool leads_on_at_end = ends_singular && lead_on(nodes);
  std::reverse(nodes.begin(), nodes.end());
  const bool leads_on_at_begin = begins_singular && lead_on(nodes);
  std::reverse(nodes.begin(), nodes.end());
  std::vector<Interval> pieces;
  double length = 0;
  for (size_t k = 0; k + 1 < nodes.size(); ++k) {
    const double to = length + glm::length(nodes[k + 1] - nodes[k]);
    pieces.emplace_back(length, to);
    length = to;
  }
  if (length < kShortest * size_) return;
  ImplicitArc arc;
  arc.closed = closed;
  arc.regular = {leads_on_at_begin ? pieces.front().hi : 0, leads_on_at_end ? pieces.back().lo : length};
  const auto point = [&](double t) {
    const auto after =
        std::upper_bound(pieces.begin(), pieces.end(), t, [](double x, const Interval& piece) { return x < piece.hi; });
    const size_t k = std::min(static_cast<size_t>(after - pieces.begin()), pieces.size() - 1);
    const double share = std::clamp((t - pieces[k].lo) / pieces[k].width(), 0.0, 1.0);
    const Vec3 chord = nodes[k + 1] - nodes[k], q = nodes[k] + share * chord;
    if (!arc.regular.contains(pieces[k].middle())) return q;
    return solved(formula_, condition_, q, chord / glm::length(chord), 0.5 * glm::length(chord)).value_or(q);
  };
  for (const double agree : kAgree) {
    arc.curve = polynomial_approximation(point, pieces, agree * size_);
    if (arc.curve) break;
  }
  if (arc.curve)
    result_.arcs.push_back(std::move(arc));
  else
    result_.complete = false;
}

bool Collector::lead_on(std::vector<Vec3>& nodes) {
  const Vec3 end = nodes.back();
  if (region_.misses({end, end})) return false;
  const Box3* nearest = nullptr;
  double least = kNearSingular * size_;
  for (const Box3& box : open_) {
    const double distance = glm::length(end - glm::clamp(end, box.lo, box.hi));
    if (distance <= least) nearest = &box, least = distance;
  }
  if (!nearest) {
    result_.complete = false;
    return false;
  }
  const SecondOrder<double> f = second_order(formula_, end);
  const auto second = condition_.at(f, triple(end));
  const auto along = cross(f.gradient, second.gradient);
  Vec3 way{along.x, along.y, along.z};
  if (glm::dot(way, end - nodes[nodes.size() - 2]) < 0) way = -way;
  Vec3 to;
  if (const auto node = singular_point(*nearest)) {
    to = *node;
  } else {
    if (!(glm::length(way) > 0)) return false;
    way = glm::normalize(way);
    to = end + std::max(0.0, glm::dot(way, nearest->center() - end)) * way;
  }
  if (to == end) return false;
  nodes.push_back(to);
  return true;
}

std::optional<Vec3> Collector::singular_point(const Box3& box) const {
  constexpr int kMostSteps = 12;
  Vec3 p = box.center();
  const double reach = box.diameter() + kLeast * size_;
  for (int step = 0; step < kMostSteps; ++step) {
    const SecondOrder<double> f = second_order(formula_, p);
    root_search::Matrix<3> inverse;
    if (!root_search::invert<3>({{{f.xx, f.xy, f.xz}, {f.xy, f.yy, f.yz}, {f.xz, f.yz, f.zz}}}, inverse))
      return std::nullopt;
    const double g[] = {f.gradient.x, f.gradient.y, f.gradient.z};
    Vec3 by(0);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) by[i] += inverse[i][k] * g[k];
    p -= by;
    if (!(glm::length(p - box.center()) <= reach)) return std::nullopt;
    if (glm::length(by) > 1e-15 * size_) continue;
    const Interval value = thin(formula_, p).value;
    return std::abs(f.value) <= 4 * value.width() ? std::optional(p) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace lekalo::geometry::implicit_arc
