#include "geometry/machining/route_graph.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace lekalo::geometry {

std::vector<std::vector<int>> RouteGraph::edges_at() const {
  std::vector<std::vector<int>> at(size());
  for (size_t e = 0; e < edges.size(); ++e) {
    at[static_cast<size_t>(edges[e].a)].push_back(static_cast<int>(e));
    at[static_cast<size_t>(edges[e].b)].push_back(static_cast<int>(e));
  }
  return at;
}

std::vector<int> RouteGraph::degrees() const {
  std::vector<int> degree(size(), 0);
  for (const RouteEdge& edge : edges) {
    ++degree[static_cast<size_t>(edge.a)];
    ++degree[static_cast<size_t>(edge.b)];
  }
  return degree;
}

double RouteGraph::weight() const {
  double sum = 0;
  for (const RouteEdge& edge : edges) sum += edge.weight;
  return sum;
}

// f(s) = 0; of the vertices that are reached the nearest is fixed, and l(x) = min(l(x), l(c) + c(c, x)) for those
// beside it.
ShortestPaths shortest_paths(const RouteGraph& graph, int from) {
  ShortestPaths paths{from, std::vector<double>(graph.size(), std::numeric_limits<double>::infinity()),
                      std::vector<int>(graph.size(), -1)};
  const auto at = graph.edges_at();
  std::vector<bool> fixed(graph.size(), false);
  using Reached = std::pair<double, int>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> reached;
  paths.distance[static_cast<size_t>(from)] = 0;
  reached.push({0, from});
  while (!reached.empty()) {
    const int c = reached.top().second;
    reached.pop();
    if (fixed[static_cast<size_t>(c)]) continue;
    fixed[static_cast<size_t>(c)] = true;
    for (const int e : at[static_cast<size_t>(c)]) {
      const RouteEdge& edge = graph.edges[static_cast<size_t>(e)];
      const auto x = static_cast<size_t>(edge.from(c));
      const double length = paths.distance[static_cast<size_t>(c)] + edge.weight;
      if (!(length < paths.distance[x])) continue;
      paths.distance[x] = length;
      paths.last_edge[x] = e;
      reached.push({length, static_cast<int>(x)});
    }
  }
  return paths;
}

std::vector<int> edges_to(const RouteGraph& graph, const ShortestPaths& paths, int to) {
  std::vector<int> way;
  for (int at = to; at != paths.from;) {
    const int e = paths.last_edge[static_cast<size_t>(at)];
    if (e < 0) return {};
    way.push_back(e);
    at = graph.edges[static_cast<size_t>(e)].from(at);
  }
  std::reverse(way.begin(), way.end());
  return way;
}

int component_count(const RouteGraph& graph) {
  const auto at = graph.edges_at();
  std::vector<bool> seen(graph.size(), false);
  int count = 0;
  for (size_t first = 0; first < graph.size(); ++first) {
    if (seen[first]) continue;
    ++count;
    seen[first] = true;
    std::vector<int> waiting{static_cast<int>(first)};
    while (!waiting.empty()) {
      const int here = waiting.back();
      waiting.pop_back();
      for (const int e : at[static_cast<size_t>(here)]) {
        const int next = graph.edges[static_cast<size_t>(e)].from(here);
        if (seen[static_cast<size_t>(next)]) continue;
        seen[static_cast<size_t>(next)] = true;
        waiting.push_back(next);
      }
    }
  }
  return count;
}

namespace {

// Follows edges through vertices that are not kept; marks those it takes.
struct Chain {
  std::vector<int> edges;
  std::vector<Vec3> bends;
  double weight = 0;
  int end = 0;
};

Chain chain_from(const RouteGraph& whole, const std::vector<std::vector<int>>& at, const std::vector<bool>& kept,
                 int start, int first, std::vector<bool>& taken) {
  Chain chain;
  int here = start, e = first;
  while (true) {
    const RouteEdge& edge = whole.edges[static_cast<size_t>(e)];
    taken[static_cast<size_t>(e)] = true;
    chain.edges.push_back(e);
    chain.weight += edge.weight;
    std::vector<Vec3> bends = edge.bends;
    if (edge.a != here) std::reverse(bends.begin(), bends.end());
    chain.bends.insert(chain.bends.end(), bends.begin(), bends.end());
    here = edge.from(here);
    if (kept[static_cast<size_t>(here)]) break;
    chain.bends.push_back(whole.places[static_cast<size_t>(here)]);
    const auto& both = at[static_cast<size_t>(here)];
    e = both[0] == e ? both[1] : both[0];
  }
  chain.end = here;
  return chain;
}

// Vertices of other than two edges, and of rings what keeps every edge from leading back to where it began.
std::vector<bool> kept_vertices(const RouteGraph& whole) {
  const auto at = whole.edges_at();
  std::vector<bool> kept(whole.size()), seen(whole.edges.size(), false);
  for (size_t v = 0; v < whole.size(); ++v) kept[v] = at[v].size() != 2;
  const auto keep_of_rings = [&](size_t v) {
    for (const int e : at[v]) {
      if (seen[static_cast<size_t>(e)]) continue;
      const Chain chain = chain_from(whole, at, kept, static_cast<int>(v), e, seen);
      if (chain.end != static_cast<int>(v)) continue;
      const int second = whole.edges[static_cast<size_t>(chain.edges[0])].from(static_cast<int>(v));
      kept[static_cast<size_t>(second)] = true;
    }
  };
  for (size_t v = 0; v < whole.size(); ++v)
    if (kept[v]) keep_of_rings(v);
  for (size_t v = 0; v < whole.size(); ++v)
    if (!kept[v] && !seen[static_cast<size_t>(at[v][0])]) {
      kept[v] = true;
      keep_of_rings(v);
    }
  return kept;
}

}  // namespace

ReducedGraph reduced(const RouteGraph& whole) {
  const std::vector<bool> kept = kept_vertices(whole);
  const auto at = whole.edges_at();
  ReducedGraph result;
  std::vector<int> number(whole.size(), -1);
  for (size_t v = 0; v < whole.size(); ++v) {
    if (!kept[v]) continue;
    number[v] = static_cast<int>(result.vertex.size());
    result.vertex.push_back(static_cast<int>(v));
    result.graph.places.push_back(whole.places[v]);
  }
  std::vector<bool> taken(whole.edges.size(), false);
  for (const int v : result.vertex)
    for (const int e : at[static_cast<size_t>(v)]) {
      if (taken[static_cast<size_t>(e)]) continue;
      Chain chain = chain_from(whole, at, kept, v, e, taken);
      result.graph.edges.push_back({number[static_cast<size_t>(v)], number[static_cast<size_t>(chain.end)],
                                    chain.weight, std::move(chain.bends)});
      result.chains.push_back(std::move(chain.edges));
    }
  return result;
}

}  // namespace lekalo::geometry
