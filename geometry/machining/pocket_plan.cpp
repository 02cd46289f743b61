#include "geometry/machining/pocket_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lekalo::geometry {

namespace {

constexpr double kFinishing = 0.1;  // of the allowance's range: how near the way of the finishing tool is
constexpr size_t kMaxTrapezoids = 2000;

Affine frame_of(const Vec3& upright) {
  const Vec3 y(upright.x, upright.y, 0.0);
  if (!(glm::length(y) > 1e-9))
    throw FieldError("direction", "the lines of the split lie in the plane of the pocket", "a direction in x, y");
  const Vec3 along = glm::normalize(y);
  return {Mat3(Vec3(along.y, -along.x, 0.0), along, Vec3(0, 0, 1)), Vec3(0)};
}

PocketRegion in_split_coordinates(const PocketRegion& region, const Affine& to_plane) {
  const Affine back = to_plane.inverse();
  PocketRegion result = region;
  for (Polygon2& rim : result.rims)
    for (Vec2& corner : rim) corner = Vec2(back.point(Vec3(corner, 0.0)));
  return result;
}

RouteGraph contact_graph(const PocketPlan& plan) {
  RouteGraph graph;
  for (const Trapezoid& one : plan.split.trapezoids) graph.places.push_back(plan.at(one.center()));
  for (const TrapezoidContact& contact : plan.split.contacts) {
    const auto center = [&](int k) { return graph.places[static_cast<size_t>(k)]; };
    graph.edges.push_back({contact.a, contact.b, glm::length(center(contact.b) - center(contact.a)), {}});
  }
  return graph;
}

RoutePlan route_of(const PocketPlan& plan) {
  RoutePlan route;
  route.graph = contact_graph(plan);
  if (const int parts = component_count(route.graph); parts > 1)
    throw FieldError("allowance", fmt::format("the tool does not come through: the region falls into {} parts", parts),
                     "take a smaller tool or allowance");
  if (route.graph.edges.empty()) return route;
  route.postman = postman_route(route.graph);
  route.reduced = reduced(route.graph);
  route.walk = shortened_walk(route.graph, *route.postman);
  route.start = route.walk.front().from;
  return route;
}

// Along upright rows of a trapezoid, beginning at its left or right, at the end of the first row that is nearer.
std::vector<Vec2> zigzag(const Trapezoid& one, double step, bool from_left, const Vec2& from) {
  const int rows = std::max(1, static_cast<int>(std::ceil(one.x.width() / step - 1e-9)));
  std::vector<Vec2> points;
  Vec2 before = from;
  for (int k = 0; k < rows; ++k) {
    const double x = one.x.lo + one.x.width() * ((from_left ? k : rows - 1 - k) + 0.5) / rows;
    Vec2 a(x, one.lower_at(x)), b(x, one.upper_at(x));
    if (glm::length(b - before) < glm::length(a - before)) std::swap(a, b);
    points.push_back(a);
    points.push_back(b);
    before = b;
  }
  return points;
}

// Moves through trapezoids, which are convex: between points of each it stays inside, and it goes from one to the next
// where what they have in common is nearest upright.
class Path {
 public:
  Path(const PocketPlan& plan, double step) : plan_(plan), step_(step), cleared_(plan.split.trapezoids.size(), false) {}

  void clear(int trapezoid, bool from_left, const Vec2& from) {
    cleared_[static_cast<size_t>(trapezoid)] = true;
    const auto rows = zigzag(plan_.split.trapezoids[static_cast<size_t>(trapezoid)], step_, from_left, from);
    move(rows.front());
    for (size_t k = 1; k < rows.size(); ++k) {
      cut += glm::length(rows[k] - rows[k - 1]);
      points.push_back(rows[k]);
    }
  }
  void go(const WalkStep& step) {
    const TrapezoidContact& contact = plan_.split.contacts[static_cast<size_t>(step.edge)];
    const Vec2 gate(contact.x, contact.y.clamp(points.back().y));
    move(gate);
    if (!cleared_[static_cast<size_t>(step.to)]) clear(step.to, step.to == contact.b, gate);
  }

  std::vector<Vec2> points;
  double cut = 0, air = 0;

 private:
  void move(const Vec2& to) {
    if (!points.empty()) air += glm::length(to - points.back());
    points.push_back(to);
  }
  const PocketPlan& plan_;
  double step_;
  std::vector<bool> cleared_;
};

}  // namespace

PocketPlan pocket_plan(const PocketContours& contours, const PocketTools& tools, const Vec3& upright,
                       std::vector<Vec3>& path) {
  PocketPlan plan;
  plan.to_plane = frame_of(upright);
  plan.height = contours.outer->point(contours.outer->domain().lo).z;
  plan.region = inset_region(*contours.outer, contours.islands, tools.radius + tools.allowance.lo,
                             tools.radius + tools.allowance.hi);
  plan.finishing = inset_region(*contours.outer, contours.islands, tools.finishing_radius,
                                tools.finishing_radius + kFinishing * tools.allowance.width(), "finishing_radius");
  plan.split = trapezoid_split(in_split_coordinates(plan.region, plan.to_plane));
  if (plan.split.trapezoids.size() > kMaxTrapezoids)
    throw FieldError("allowance", fmt::format("the pocket falls into {} trapezoids", plan.split.trapezoids.size()),
                     "widen the allowance");
  plan.route = route_of(plan);
  Path way(plan, tools.step);
  const bool leaves_left = !plan.route.walk.empty() &&
                           plan.split.contacts[static_cast<size_t>(plan.route.walk.front().edge)].b == plan.route.start;
  const Trapezoid& first = plan.split.trapezoids[static_cast<size_t>(plan.route.start)];
  const double beginning = leaves_left ? first.x.hi : first.x.lo;
  way.clear(plan.route.start, !leaves_left, Vec2(beginning, first.lower_at(beginning)));
  for (const WalkStep& step : plan.route.walk) way.go(step);
  plan.cut_length = way.cut;
  plan.air_length = way.air;
  path.clear();
  for (const Vec2& point : way.points) path.push_back(plan.at(point));
  return plan;
}

}  // namespace lekalo::geometry
