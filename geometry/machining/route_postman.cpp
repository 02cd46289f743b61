#include "geometry/machining/route_postman.h"

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

namespace lekalo::geometry {

namespace {

// Orders of the edges at vertices in which closed ways are tried, and how many ways in all where there are many starts.
constexpr int kOrders = 48, kMinOrders = 2;
constexpr int kTriedWays = 2000;
// Weights within this part of each other are the same.
constexpr double kSameWeight = 1e-12;

using EdgesAt = std::vector<std::vector<int>>;

RouteGraph multigraph(const RouteGraph& graph, const std::vector<int>& again) {
  RouteGraph multi = graph;
  for (const int e : again) multi.edges.push_back(graph.edges[static_cast<size_t>(e)]);
  return multi;
}

// Hierholzer: go on until no edge is left, which is where it began; then insert such rounds where edges are left.
Walk euler_cycle(const RouteGraph& multi, const EdgesAt& order, int start) {
  std::vector<size_t> next(multi.size(), 0);
  std::vector<bool> used(multi.edges.size(), false);
  std::vector<WalkStep> stack{{-1, start, start}};
  Walk cycle;
  while (!stack.empty()) {
    const int here = stack.back().to;
    const auto& edges = order[static_cast<size_t>(here)];
    size_t& k = next[static_cast<size_t>(here)];
    while (k < edges.size() && used[static_cast<size_t>(edges[k])]) ++k;
    if (k == edges.size()) {
      if (stack.back().edge >= 0) cycle.push_back(stack.back());
      stack.pop_back();
      continue;
    }
    used[static_cast<size_t>(edges[k])] = true;
    stack.push_back({edges[k], here, multi.edges[static_cast<size_t>(edges[k])].from(here)});
  }
  std::reverse(cycle.begin(), cycle.end());
  return cycle;
}

// Numbers of copies become those of the edges that they are copies of.
void name_originals(Walk& walk, const RouteGraph& graph, const std::vector<int>& again) {
  for (WalkStep& step : walk)
    if (static_cast<size_t>(step.edge) >= graph.edges.size())
      step.edge = again[static_cast<size_t>(step.edge) - graph.edges.size()];
}

// `paths` begin at the vertices, one after another.
Grid<double> distances_between(const std::vector<int>& vertices, const std::vector<ShortestPaths>& paths) {
  const int n = static_cast<int>(vertices.size());
  Grid<double> result{n, n, std::vector<double>(vertices.size() * vertices.size(), 0.0)};
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      result.at(i, j) = result.at(j, i) =
          paths[static_cast<size_t>(i)].distance[static_cast<size_t>(vertices[static_cast<size_t>(j)])];
  return result;
}

// What ends with the last vertex that is new, without rounds through visited vertices alone.
Walk shortened(const Walk& cycle, size_t vertex_count, int start) {
  std::vector<bool> visited(vertex_count, false);
  std::vector<int> left(vertex_count, -1);  // steps of the walk when it was last at a vertex, since the last new one
  visited[static_cast<size_t>(start)] = true;
  left[static_cast<size_t>(start)] = 0;
  Walk walk;
  size_t count = 1, kept = 0;
  for (const WalkStep& step : cycle) {
    if (count == vertex_count) break;
    walk.push_back(step);
    const auto to = static_cast<size_t>(step.to);
    if (!visited[to]) {
      visited[to] = true;
      ++count;
      kept = walk.size();
      std::fill(left.begin(), left.end(), -1);
    } else if (left[to] >= 0) {
      const auto size = static_cast<size_t>(left[to]);
      for (size_t k = size; k < walk.size(); ++k) left[static_cast<size_t>(walk[k].to)] = -1;
      walk.resize(size);
    }
    left[to] = static_cast<int>(walk.size());
  }
  walk.resize(kept);
  return walk;
}

// Turned, reversed and mixed orders of the edges at each vertex, always the same ones.
void vary(EdgesAt& order, int variant) {
  unsigned state = 12345u + static_cast<unsigned>(variant) * 2654435761u;
  const auto random = [&] { return state = state * 1664525u + 1013904223u, state >> 16; };
  for (auto& edges : order) {
    if (variant == 1) std::reverse(edges.begin(), edges.end());
    if (variant < 2 || edges.size() < 2) continue;
    for (size_t k = edges.size() - 1; k > 0; --k) std::swap(edges[k], edges[random() % (k + 1)]);
  }
}

std::vector<int> starts_of(const RouteGraph& graph, int start) {
  if (start >= 0) return {start};
  std::vector<int> starts, all;
  const std::vector<int> degrees = graph.degrees();
  for (size_t v = 0; v < graph.size(); ++v) {
    all.push_back(static_cast<int>(v));
    if (degrees[v] == 1) starts.push_back(static_cast<int>(v));
  }
  return starts.empty() ? all : starts;
}

}  // namespace

std::vector<int> vertices_of(const Walk& walk, int start) {
  std::vector<int> vertices{walk.empty() ? start : walk.front().from};
  for (const WalkStep& step : walk) vertices.push_back(step.to);
  return vertices;
}

double weight(const Walk& walk, const RouteGraph& graph) {
  double sum = 0;
  for (const WalkStep& step : walk) sum += graph.edges[static_cast<size_t>(step.edge)].weight;
  return sum;
}

double repeated_weight(const Walk& walk, const RouteGraph& graph) {
  std::set<int> visited;
  double sum = 0;
  for (const WalkStep& step : walk) {
    visited.insert(step.from);
    if (!visited.insert(step.to).second) sum += graph.edges[static_cast<size_t>(step.edge)].weight;
  }
  return sum;
}

PostmanRoute postman_route(const RouteGraph& graph, int start) {
  if (graph.edges.empty()) throw std::invalid_argument("the graph has no edges");
  if (const int parts = component_count(graph); parts > 1)
    throw std::invalid_argument("the graph falls into " + std::to_string(parts) + " parts without a way between them");
  PostmanRoute route;
  const std::vector<int> degrees = graph.degrees();
  for (size_t v = 0; v < graph.size(); ++v)
    if (degrees[v] % 2 != 0) route.odd.push_back(static_cast<int>(v));
  route.exact = static_cast<int>(route.odd.size()) <= kMaxExactMatching;
  if (static_cast<int>(route.odd.size()) > kMaxExchangeMatching)
    throw std::invalid_argument(std::to_string(route.odd.size()) + " vertices have an odd number of edges, more than " +
                                std::to_string(kMaxExchangeMatching) + " take too long");
  std::vector<ShortestPaths> paths;
  for (const int v : route.odd) paths.push_back(shortest_paths(graph, v));
  route.distances = distances_between(route.odd, paths);
  const Pairs pairs = route.exact ? minimum_matching(route.distances) : matching_by_exchange(route.distances);
  route.matching_weight = weight(pairs, route.distances);
  // An edge that two of the ways share would be walked three times: walked once, the parity is the same.
  std::set<int> again;
  for (const auto& [i, j] : pairs) {
    const int a = route.odd[static_cast<size_t>(i)], b = route.odd[static_cast<size_t>(j)];
    route.matching.push_back({a, b});
    for (const int e : edges_to(graph, paths[static_cast<size_t>(i)], b))
      if (!again.insert(e).second) again.erase(e);
  }
  route.again.assign(again.begin(), again.end());
  const RouteGraph multi = multigraph(graph, route.again);
  route.cycle = euler_cycle(multi, multi.edges_at(), start);
  name_originals(route.cycle, graph, route.again);
  route.weight = weight(route.cycle, graph);
  return route;
}

Walk shortened_walk(const RouteGraph& graph, const PostmanRoute& route, int start) {
  const RouteGraph multi = multigraph(graph, route.again);
  const EdgesAt at = multi.edges_at();
  Walk best;
  double least = std::numeric_limits<double>::infinity();
  const std::vector<int> starts = starts_of(graph, start);
  const int orders = std::clamp(kTriedWays / static_cast<int>(starts.size()), kMinOrders, kOrders);
  for (const int from : starts)
    for (int variant = 0; variant < orders; ++variant) {
      EdgesAt order = at;
      vary(order, variant);
      Walk walk = shortened(euler_cycle(multi, order, from), graph.size(), from);
      name_originals(walk, graph, route.again);
      const double length = weight(walk, graph);
      const bool is_shorter = length < least * (1 - kSameWeight);
      const bool is_same = !is_shorter && length <= least * (1 + kSameWeight);
      if (!is_shorter && !(is_same && vertices_of(walk, from) < vertices_of(best, from))) continue;
      least = std::min(least, length);
      best = std::move(walk);
    }
  return best;
}

}  // namespace lekalo::geometry
