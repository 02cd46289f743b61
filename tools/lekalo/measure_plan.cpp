// Paths that were planned (geometry/machining): graphs and the ways through them, pockets, passes, orders of holes.
#include <fmt/format.h>

#include "command.h"
#include "geometry/machining/drilling_order.h"
#include "geometry/machining/pocket_plan.h"
#include "geometry/machining/turning_pass.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::DrillingPlan;
using geometry::PocketPlan;
using geometry::RoutePlan;
using geometry::TurningPlan;

constexpr double kDegrees = 180 / geometry::kPi;

ordered_json rows_of(const geometry::Grid<double>& grid) {
  ordered_json rows = ordered_json::array();
  for (int i = 0; i < grid.rows; ++i) {
    ordered_json row = ordered_json::array();
    for (int j = 0; j < grid.columns; ++j) row.push_back(grid.at(i, j));
    rows.push_back(row);
  }
  return rows;
}

ordered_json edges_of(const geometry::ReducedGraph& reduced) {
  ordered_json edges = ordered_json::array();
  for (const geometry::RouteEdge& edge : reduced.graph.edges)
    edges.push_back(
        {reduced.vertex[static_cast<size_t>(edge.a)], reduced.vertex[static_cast<size_t>(edge.b)], edge.weight});
  return edges;
}

void add_postman(ordered_json& out, const geometry::PostmanRoute& postman) {
  ordered_json matching = ordered_json::array();
  for (const auto& [a, b] : postman.matching) matching.push_back({a, b});
  out["odd"] = postman.odd;
  out["distances"] = rows_of(postman.distances);
  out["matchings"] = geometry::matching_count(static_cast<int>(postman.odd.size()));
  out["matching"] = matching;
  out["matching_weight"] = postman.matching_weight;
  out["method"] = postman.exact ? "least of all matchings" : "exchanges of three pairs";
  out["postman_weight"] = postman.weight;
}

ordered_json json_of(const RoutePlan& plan) {
  const std::vector<int> walk = geometry::vertices_of(plan.walk, plan.start);
  const double length = geometry::weight(plan.walk, plan.graph),
               repeated = geometry::repeated_weight(plan.walk, plan.graph);
  ordered_json out = {{"vertices", plan.graph.size()},
                      {"edges", plan.graph.edges.size()},
                      {"weight_of_edges", plan.graph.weight()},
                      {"reduced_vertices", plan.reduced.vertex},
                      {"reduced_edges", edges_of(plan.reduced)}};
  if (plan.postman) add_postman(out, *plan.postman);
  out["walk"] = walk;
  out["visits"] = walk.size();
  out["ratio"] = static_cast<double>(walk.size()) / static_cast<double>(plan.graph.size());
  out["walk_weight"] = length;
  out["repeated_share"] = length > 0 ? repeated / length : 0.0;
  return out;
}

ordered_json json_of(const PocketPlan& plan) {
  ordered_json areas = ordered_json::array();
  for (const geometry::Trapezoid& one : plan.split.trapezoids) areas.push_back(one.area());
  const double length = plan.cut_length + plan.air_length;
  return {{"rims", plan.region.rims.size()},
          {"area", geometry::area(plan.region)},
          {"trapezoids", plan.split.trapezoids.size()},
          {"areas", areas},
          {"contacts", plan.split.contacts.size()},
          {"finishing_rims", plan.finishing.rims.size()},
          {"finishing_area", geometry::area(plan.finishing)},
          {"path_length", length},
          {"cut_length", plan.cut_length},
          {"air_length", plan.air_length},
          {"air_share", length > 0 ? plan.air_length / length : 0.0}};
}

ordered_json json_of(const TurningPlan& plan) {
  const geometry::Measured removed = geometry::removed_volume(*plan.before, *plan.profile);
  ordered_json out{{"passes", plan.passes},
                   {"pass", plan.pass},
                   {"removed_volume", removed.value},
                   {"removed_volume_error", removed.error},
                   {"steepest", plan.steepest * kDegrees},
                   {"steepest_at", plan.steepest_at}};
  if (plan.feed_points.empty()) return out;
  ordered_json places = ordered_json::array();
  for (const geometry::FeedPoint& one : plan.feed_points)
    places.push_back({one.point.x, one.point.y, one.slope * kDegrees, one.depth, one.step});
  out["feed_points"] = places;
  return out;
}

ordered_json json_of(const DrillingPlan& plan) {
  return {{"holes", plan.task.holes.size()},    {"order", plan.order},
          {"time", plan.task.time(plan.order)}, {"tool_changes", plan.task.tool_changes(plan.order)},
          {"nearest_order", plan.nearest},      {"nearest_time", plan.task.time(plan.nearest)}};
}

std::string words_of(const ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_integer()) return fmt::format("{}", value.get<int64_t>());
  if (value.is_number()) return digits(value.get<double>());
  std::string words;
  for (const ordered_json& one : value)
    words += fmt::format("{}{}", words.empty() ? "" : " ", one.is_array() ? "(" + words_of(one) + ")" : words_of(one));
  return words;
}

}  // namespace

void put_plan(ordered_json& out, const geometry::Curve& curve) {
  if (const auto turning = geometry::plan_of<TurningPlan>(curve); turning.plan) out["turning"] = json_of(*turning.plan);
  if (const auto drilling = geometry::plan_of<DrillingPlan>(curve); drilling.plan)
    out["drilling"] = json_of(*drilling.plan);
  if (const auto pocket = geometry::plan_of<PocketPlan>(curve); pocket.plan) {
    out["pocket"] = json_of(*pocket.plan);
    if (!pocket.plan->route.walk.empty()) out["route"] = json_of(pocket.plan->route);
  }
  if (const auto route = geometry::plan_of<RoutePlan>(curve); route.plan) out["route"] = json_of(*route.plan);
}

void print_plan(const ordered_json& plan) {
  for (const auto& [key, value] : plan.items()) {
    std::string label = key;
    std::replace(label.begin(), label.end(), '_', ' ');
    fmt::print("{:<18} {}\n", label, words_of(value));
  }
}

}  // namespace lekalo::command
