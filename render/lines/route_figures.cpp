#include "render/lines/route_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "geometry/curves/analytic/polyline.h"
#include "geometry/machining/drilling_order.h"
#include "geometry/machining/pocket_plan.h"
#include "geometry/machining/turning_pass.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Points of a line that is drawn beside an edge.
constexpr int kPlaces = 32;
// Where along a step its head stands.
constexpr double kHead = 0.58;

void add_line(RouteFigure& figure, std::vector<Vec3> points, bool arrow = false) {
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 2) return;
  figure.lines.push_back({std::make_shared<NurbsCurve>(polyline(points)), arrow});
}

// So many points of a polyline, evenly along it.
std::vector<Vec3> even_points(const std::vector<Vec3>& points, int count) {
  std::vector<double> length{0};
  for (size_t k = 1; k < points.size(); ++k) length.push_back(length.back() + glm::length(points[k] - points[k - 1]));
  std::vector<Vec3> result;
  size_t side = 1;
  for (int i = 0; i <= count; ++i) {
    const double at = length.back() * i / count;
    while (side + 1 < points.size() && length[side] < at) ++side;
    const double whole = length[side] - length[side - 1];
    result.push_back(glm::mix(points[side - 1], points[side], whole > 0 ? (at - length[side - 1]) / whole : 0.0));
  }
  return result;
}

// From end to end beside the line, to its right by `distance` in the middle; the plane is x, y.
std::vector<Vec3> beside(const std::vector<Vec3>& line, double distance) {
  const std::vector<Vec3> points = even_points(line, kPlaces);
  std::vector<Vec3> result;
  for (int k = 0; k <= kPlaces; ++k) {
    const auto at = [&](int i) { return points[static_cast<size_t>(std::clamp(i, 0, kPlaces))]; };
    const Vec3 along = at(k + 4) - at(k - 4), across(along.y, -along.x, 0.0);
    const double size = glm::length(across);
    result.push_back(at(k) + (size > 0 ? distance * std::sin(kPi * k / kPlaces) / size : 0.0) * across);
  }
  return result;
}

Vec3 middle(const std::vector<Vec3>& line) { return even_points(line, 2)[1]; }

std::string roman(int number) {
  static constexpr std::pair<int, const char*> kDigits[] = {{100, "C"}, {90, "XC"}, {50, "L"}, {40, "XL"}, {10, "X"},
                                                            {9, "IX"},  {5, "V"},   {4, "IV"}, {1, "I"}};
  std::string words;
  for (const auto& [value, digit] : kDigits)
    for (; number >= value; number -= value) words += digit;
  return words;
}

std::string name_of(size_t vertex, const Fields& f) {
  const int number = static_cast<int>(vertex) + f.integer("first");
  return f.text("labels") == "roman" && number > 0 ? roman(number) : fmt::format("{}", number);
}

double size_of(const RouteGraph& graph) {
  Box3 box;
  for (const Vec3& place : graph.places) box.include(place);
  return box.diameter();
}

void add_graph(RouteFigure& figure, const RouteGraph& graph, const Fields& f) {
  for (const RouteEdge& edge : graph.edges) {
    const std::vector<Vec3> line = points_of(edge, graph, edge.a);
    add_line(figure, line);
    if (f.boolean("weights")) figure.texts.push_back({middle(line), fmt::format("{:.4g}", edge.weight)});
  }
  figure.points = graph.places;
  if (f.text("labels") == "none") return;
  for (size_t v = 0; v < graph.size(); ++v) figure.texts.push_back({graph.places[v], name_of(v, f)});
}

RouteFigure whole_graph(const RoutePlan& plan, const Fields& f) {
  RouteFigure figure;
  add_graph(figure, plan.graph, f);
  return figure;
}

RouteFigure reduced_graph(const RoutePlan& plan, const Fields& f) {
  RouteFigure figure;
  add_graph(figure, plan.reduced.graph, f);
  return figure;
}

RouteFigure added_edges(const RoutePlan& plan, const Fields& f) {
  RouteFigure figure;
  if (!plan.postman) return figure;
  const double distance = f.has("distance") ? f.number("distance") : 0.03 * size_of(plan.graph);
  for (const int e : plan.postman->again) {
    const RouteEdge& edge = plan.graph.edges[static_cast<size_t>(e)];
    add_line(figure, beside(points_of(edge, plan.graph, edge.a), distance));
  }
  return figure;
}

RouteFigure matching(const RoutePlan& plan, const Fields&) {
  RouteFigure figure;
  if (!plan.postman) return figure;
  for (const auto& [a, b] : plan.postman->matching) {
    figure.points.push_back(plan.graph.places[static_cast<size_t>(a)]);
    figure.points.push_back(plan.graph.places[static_cast<size_t>(b)]);
    add_line(figure, {figure.points[figure.points.size() - 2], figure.points.back()});
  }
  return figure;
}

// Steps of edges that are walked more than once stand to the right of the edge, the second of one direction to its
// left.
RouteFigure walk(const RoutePlan& plan, const Fields& f) {
  RouteFigure figure;
  const double distance = f.has("distance") ? f.number("distance") : 0.02 * size_of(plan.graph);
  std::map<int, int> times;
  std::map<std::pair<int, int>, int> same_way;
  for (const WalkStep& step : plan.walk) ++times[step.edge];
  for (size_t k = 0; k < plan.walk.size(); ++k) {
    const WalkStep& step = plan.walk[k];
    const RouteEdge& edge = plan.graph.edges[static_cast<size_t>(step.edge)];
    std::vector<Vec3> line = points_of(edge, plan.graph, step.from);
    const double side = same_way[{step.edge, step.from}]++ % 2 == 0 ? distance : -distance;
    line = times[step.edge] > 1 ? beside(line, side) : even_points(line, kPlaces);
    const auto head = static_cast<std::ptrdiff_t>(kHead * kPlaces);
    add_line(figure, {line.begin(), line.begin() + head + 1}, true);
    add_line(figure, {line.begin() + head, line.end()});
    if (f.boolean("numbers")) figure.texts.push_back({line[kPlaces / 2], fmt::format("{}", k + 1)});
  }
  return figure;
}

std::vector<Vec3> closed_line(const Polygon2& rim, double height) {
  std::vector<Vec3> line;
  for (const Vec2& corner : rim) line.push_back(Vec3(corner, height));
  line.push_back(line.front());
  return line;
}

RouteFigure region(const PocketPlan& plan, const Fields&) {
  RouteFigure figure;
  for (const Polygon2& rim : plan.region.rims) {
    add_line(figure, closed_line(rim, plan.height));
    for (const Vec2& corner : rim) figure.points.push_back(Vec3(corner, plan.height));
  }
  return figure;
}

RouteFigure finishing(const PocketPlan& plan, const Fields&) {
  RouteFigure figure;
  for (const Polygon2& rim : plan.finishing.rims) add_line(figure, closed_line(rim, plan.height));
  return figure;
}

// The lines in which trapezoids have contact, from rim to rim.
RouteFigure trapezoids(const PocketPlan& plan, const Fields& f) {
  RouteFigure figure;
  const auto& all = plan.split.trapezoids;
  for (const TrapezoidContact& contact : plan.split.contacts) {
    const Trapezoid &a = all[static_cast<size_t>(contact.a)], &b = all[static_cast<size_t>(contact.b)];
    const double lower = std::min(a.lower[1], b.lower[0]), upper = std::max(a.upper[1], b.upper[0]);
    add_line(figure, {plan.at({contact.x, lower}), plan.at({contact.x, upper})});
  }
  if (f.boolean("numbers"))
    for (size_t k = 0; k < all.size(); ++k)
      figure.texts.push_back({plan.at(all[k].center()), fmt::format("{}", static_cast<int>(k) + f.integer("first"))});
  return figure;
}

using DrawPocket = std::function<RouteFigure(const PocketPlan&, const Fields&)>;

const std::map<std::string, DrawPocket, std::less<>>& pocket_figures() {
  static const std::map<std::string, DrawPocket, std::less<>> all = {
      {"region", region}, {"finishing", finishing}, {"trapezoids", trapezoids}};
  return all;
}

// Places of the tool, and the allowance before each along the normal.
RouteFigure feed_places(const TurningPlan& plan, const Fields&) {
  RouteFigure figure;
  for (const FeedPoint& one : plan.feed_points) {
    figure.points.push_back(one.point);
    const Vec3 along = plan.profile->evaluate(one.t, 1).d[1], up(-along.y, along.x, 0.0);
    const double allowance = one.depth * std::cos(one.slope);
    if (allowance > 0)
      add_line(figure, {one.point, one.point + (along.x < 0 ? -allowance : allowance) / glm::length(up) * up});
  }
  return figure;
}

// The holes with their places in the order; along the way heads.
RouteFigure drilling(const DrillingPlan& plan, const Fields& f) {
  RouteFigure figure;
  const auto hole = [&](size_t k) { return plan.task.holes[static_cast<size_t>(plan.order[k % plan.order.size()])]; };
  const size_t steps = plan.order.size() - (plan.task.closed ? 0 : 1);
  for (size_t k = 0; k < steps; ++k) {
    const Vec3 head = glm::mix(hole(k), hole(k + 1), kHead);
    add_line(figure, {hole(k), head}, true);
    add_line(figure, {head, hole(k + 1)});
  }
  for (size_t k = 0; k < plan.order.size(); ++k) {
    figure.points.push_back(hole(k));
    if (f.boolean("numbers")) figure.texts.push_back({hole(k), fmt::format("{}", k + 1)});
  }
  return figure;
}

using Draw = std::function<RouteFigure(const RoutePlan&, const Fields&)>;

const std::map<std::string, Draw, std::less<>>& figures() {
  static const std::map<std::string, Draw, std::less<>> all = {{"graph", whole_graph},
                                                               {"reduced_graph", reduced_graph},
                                                               {"added_edges", added_edges},
                                                               {"matching", matching},
                                                               {"walk", walk}};
  return all;
}

void place(RouteFigure& figure, const Affine& map) {
  if (map.is_identity()) return;
  for (RouteFigure::Line& line : figure.lines) line.curve = std::make_shared<TransformedCurve>(line.curve, map);
  for (RouteFigure::Text& text : figure.texts) text.point = map.point(text.point);
  for (Vec3& point : figure.points) point = map.point(point);
}

// Adds what a function draws of the plan behind the curve, if it has such a one.
template <class Plan, class Draw>
void add_of_plan(RouteFigure& figure, const Curve& curve, const Helper& helper, const Draw& draw) {
  const auto found = plan_of<Plan>(curve);
  if (!found.plan) return;
  figure = draw(*found.plan, helper.values);
  place(figure, found.map);
}

}  // namespace

bool is_route_figure(const std::string& helper) {
  return figures().count(helper) > 0 || pocket_figures().count(helper) > 0 || helper == "feed_points" ||
         helper == "drilling";
}

RouteFigure route_figure(const Curve& curve, const Helper& helper) {
  RouteFigure figure;
  if (const auto draw = figures().find(helper.type); draw != figures().end()) {
    add_of_plan<RoutePlan>(figure, curve, helper, draw->second);
    add_of_plan<PocketPlan>(figure, curve, helper,
                            [&](const PocketPlan& pocket, const Fields& f) { return draw->second(pocket.route, f); });
  } else if (const auto draw_pocket = pocket_figures().find(helper.type); draw_pocket != pocket_figures().end()) {
    add_of_plan<PocketPlan>(figure, curve, helper, draw_pocket->second);
  } else if (helper.type == "drilling") {
    add_of_plan<DrillingPlan>(figure, curve, helper, drilling);
  } else {
    add_of_plan<TurningPlan>(figure, curve, helper, feed_places);
  }
  return figure;
}

}  // namespace lekalo::render
