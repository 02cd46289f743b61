#include "geometry/queries/implicit_curves/implicit_arc_collector.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/operations/curve_part.h"
#include "geometry/curves/splines/polynomial_approximation.h"

namespace lekalo::geometry::implicit_arc {

namespace {

// Of the region's diameter: ends of arcs from the place at which they end, the shortest arc, and how well polynomials
// agree with it.
constexpr double kNearSingular = 1e-4, kShortest = 1e-9;
constexpr double kTimesRounding = 4;
constexpr double kSolvedToNode = 0.95;  // of the way to a node that is known
constexpr double kAgree[] = {1e-14, 1e-13, 1e-11, 1e-9};

// Solves F = level, the second equation, and n . (p - q) = 0 near q, n a unit vector; none where Newton's iteration
// leads farther away than `reach`.
std::optional<Vec3> solved(const ImplicitFormula& formula, const ImplicitCondition& condition, const Vec3& q,
                           const Vec3& n, double reach) {
  constexpr int kMaxSteps = 20;
  constexpr double kRounding = 1e-6;  // Newton's steps as short would be followed by much shorter ones
  Vec3 p = q;
  double before = kInfinity;
  for (int step = 0; step < kMaxSteps; ++step) {
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
    if (length == 0 || (length < kRounding * reach && length >= 0.5 * before)) return p;
    before = length;
  }
  return before < kRounding * reach ? std::optional(p) : std::nullopt;
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

Collector::Collector(const ImplicitBranch& branch, const ImplicitRegion& region, const ImplicitCondition& condition,
                     std::span<const ImplicitNode> nodes)
    : branch_(branch),
      formula_(*branch.formula),
      region_(region),
      condition_(condition),
      nodes_(nodes),
      size_(region_.box.diameter()) {}

void Collector::add(std::vector<Vec3> nodes, bool closed, bool begins_singular, bool ends_singular) {
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  if (nodes.size() < 2) return;
  std::optional<LastBit> at_end, at_begin;
  if (ends_singular) at_end = lead_on(nodes);
  std::reverse(nodes.begin(), nodes.end());
  if (begins_singular) at_begin = lead_on(nodes);
  std::reverse(nodes.begin(), nodes.end());
  // Part of a branch between places beside a node that are not decided: the branch was led on over them.
  if (at_begin && at_end && nodes.front() == nodes.back() &&
      std::all_of(nodes.begin(), nodes.end(),
                  [&](const Vec3& p) { return glm::length(p - nodes.front()) < kNearSingular * size_; }))
    return;
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
  arc.regular = {at_begin ? pieces.front().middle() : 0, at_end ? pieces.back().middle() : length};
  const auto point = [&](double t) {
    const auto after =
        std::upper_bound(pieces.begin(), pieces.end(), t, [](double x, const Interval& piece) { return x < piece.hi; });
    const size_t k = std::min(static_cast<size_t>(after - pieces.begin()), pieces.size() - 1);
    const double share = std::clamp((t - pieces[k].lo) / pieces[k].width(), 0.0, 1.0);
    if (at_begin && k == 0) return at_begin->point(nodes[1], nodes[0], 1 - share);
    if (at_end && k + 1 == pieces.size()) return at_end->point(nodes[k], nodes[k + 1], share);
    const Vec3 chord = nodes[k + 1] - nodes[k], q = nodes[k] + share * chord;
    return solved(formula_, condition_, q, chord / glm::length(chord), 0.5 * glm::length(chord)).value_or(q);
  };
  std::vector<std::shared_ptr<const PolynomialCurve>> curves(pieces.size());
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(size_t{0}, pieces.size(), [&](size_t k) {
      const Interval& piece = pieces[k];
      const double rounding = std::max(rounding_at(point(piece.lo)), rounding_at(point(piece.hi)));
      for (const double agree : kAgree) {
        if (agree * size_ < rounding && agree < std::end(kAgree)[-1]) continue;
        curves[k] = polynomial_approximation(point, {&piece, 1}, agree * size_);
        if (curves[k]) break;
      }
    });
  });
  std::vector<PolynomialCurve::Part> parts;
  for (const auto& curve : curves) {
    if (!curve) {
      result_.complete = false;
      return;
    }
    parts.insert(parts.end(), curve->parts().begin(), curve->parts().end());
  }
  arc.curve = std::make_shared<PolynomialCurve>(std::move(parts));
  arc.formula = branch_.formula;
  add(std::move(arc));
}

void Collector::add(ImplicitArc arc) {
  each_kept(*arc.curve, arc.closed, branch_.sides, [&](const Interval& t) {
    if (t == arc.curve->domain()) return result_.arcs.push_back(arc);
    ImplicitArc part = arc;
    part.curve = stretch(arc.curve, t);
    part.closed = false;
    if (arc.closed) part.regular = {-kInfinity, kInfinity};
    result_.arcs.push_back(std::move(part));
  });
}

const ImplicitNode* Collector::node_around(const Box3& box) const {
  for (const ImplicitNode& node : nodes_) {
    const Box3 cube = Box3{node.point, node.point}.inflated(node.reach);
    if (glm::all(glm::lessThanEqual(cube.lo, box.hi)) && glm::all(glm::lessThanEqual(box.lo, cube.hi))) return &node;
  }
  return nullptr;
}

std::optional<LastBit> Collector::lead_on(std::vector<Vec3>& nodes) {
  const Vec3 end = nodes.back();
  if (region_.misses({end, end})) return std::nullopt;
  if (const ImplicitNode* node = node_around({end, end})) return lead_into(*node, nodes);
  const Box3* nearest = nullptr;
  double least = kNearSingular * size_;
  for (const Box3& box : open_) {
    const double distance = glm::length(end - glm::clamp(end, box.lo, box.hi));
    if (distance <= least) nearest = &box, least = distance;
  }
  if (!nearest) {
    result_.complete = false;
    return std::nullopt;
  }
  Vec3 way = tangent(end, end - nodes[nodes.size() - 2]);
  if (!(glm::length(way) > 0)) return std::nullopt;
  const std::optional<Vec3> node = singular_point(*nearest);
  const Vec3 to = node ? *node : end + std::max(0.0, glm::dot(way, nearest->center() - end)) * way;
  if (to == end) return std::nullopt;
  nodes.push_back(to);
  way = glm::normalize(to - end);
  return LastBit{way, way};
}

// Near a node rounding leaves few digits of the place but all of the direction in which the branch leads into it:
// w H w = 0 in the plane w . H s = 0.
std::optional<LastBit> Collector::lead_into(const ImplicitNode& node, std::vector<Vec3>& nodes) {
  const Vec3 end = nodes.back(), chord = node.point - end;
  const Vec3 q = end + kSolvedToNode * chord;
  const std::optional<Vec3> last =
      solved(formula_, condition_, q, glm::normalize(chord), (1 - kSolvedToNode) * glm::length(chord));
  const SecondOrder<double> f = second_order(formula_, node.point);
  const auto normal = condition_.at(f, triple(node.point)).gradient;
  const Frame plane = frame_about(node.point, glm::normalize(Vec3(normal.x, normal.y, normal.z)));
  const auto form = [&](const Vec3& a, const Vec3& b) { return dot(triple(a), f.second(triple(b))); };
  const double a = form(plane.x, plane.x), b = form(plane.x, plane.y), c = form(plane.y, plane.y);
  if (!last || !(b * b > a * c)) {
    result_.complete = false;
    return std::nullopt;
  }
  // cos^2 a + 2 cos sin b + sin^2 c = 0: about the form's axes, at the same angle to both sides.
  const double axis = 0.5 * std::atan2(2 * b, a - c), off = 0.5 * std::acos(-(a + c) / std::hypot(a - c, 2 * b));
  Vec3 way(0);
  for (const double angle : {axis + off, axis - off}) {
    Vec3 along = std::cos(angle) * plane.x + std::sin(angle) * plane.y;
    if (glm::dot(along, chord) < 0) along = -along;
    if (glm::dot(along, chord) > glm::dot(way, chord)) way = along;
  }
  nodes.push_back(*last);
  nodes.push_back(node.point);
  return LastBit{tangent(*last, chord), way};
}

// What the rounding of the equations makes of a point of the curve, times a few.
double Collector::rounding_at(const Vec3& p) const {
  const SecondOrder<double> f = second_order(formula_, p);
  const auto second = condition_.at(f, triple(p)).gradient;
  const Vec3 a(f.gradient.x, f.gradient.y, f.gradient.z), b(second.x, second.y, second.z), n = glm::cross(a, b);
  const SecondOrder<Interval> around = thin(formula_, p);
  const double of_f = around.value.width(), of_second = condition_.at(around, triple(Box3{p, p})).value.width();
  // a . d = f, b . d = g, n . d = 0.
  return kTimesRounding * glm::length(of_f * glm::abs(glm::cross(b, n)) + of_second * glm::abs(glm::cross(n, a))) /
         glm::dot(n, n);
}

// Of the curve at a place on it, of unit length, on the side of `onward`; zero where there is none.
Vec3 Collector::tangent(const Vec3& p, const Vec3& onward) const {
  const SecondOrder<double> f = second_order(formula_, p);
  const auto along = cross(f.gradient, condition_.at(f, triple(p)).gradient);
  const Vec3 way{along.x, along.y, along.z};
  const double length = glm::length(way);
  if (!(length > 0)) return Vec3(0);
  return (glm::dot(way, onward) < 0 ? -1 : 1) / length * way;
}

// Hermite's cubic.
Vec3 LastBit::point(const Vec3& from, const Vec3& to, double share) const {
  const double length = glm::length(to - from), x = share, y = 1 - share;
  return y * y * (1 + 2 * x) * from + x * x * (1 + 2 * y) * to + x * y * length * (y * begin - x * end);
}

std::optional<Vec3> Collector::singular_point(const Box3& box) const {
  constexpr int kMaxSteps = 12;
  Vec3 p = box.center();
  const double reach = box.diameter() + kMinBox * size_;
  for (int step = 0; step < kMaxSteps; ++step) {
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
    // At the origin rounding is smaller than what the last step left: the place counts as known to 1e-15 of the size.
    const Interval value = thin(formula_, p).value;
    const Box3 around = Box3{p, p}.inflated(1e-15 * size_);
    const bool is_on = std::abs(f.value) <= 4 * value.width() || formula_.enclose(around).contains(0);
    return is_on ? std::optional(p) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace lekalo::geometry::implicit_arc

namespace lekalo::geometry {

CurvePtr stretch(const CurvePtr& curve, const Interval& t) {
  const Interval domain = curve->domain();
  const auto* whole = dynamic_cast<const PolynomialCurve*>(curve.get());
  if (!whole || t.hi <= domain.hi) return std::make_shared<CurvePart>(curve, t);
  std::vector<PolynomialCurve::Part> parts = whole->parts();
  for (PolynomialCurve::Part part : whole->parts()) {
    part.t = {part.t.lo + domain.width(), part.t.hi + domain.width()};
    parts.push_back(part);
  }
  return std::make_shared<CurvePart>(std::make_shared<PolynomialCurve>(std::move(parts)), t);
}

}  // namespace lekalo::geometry
