// Weighted graphs in the plane or in space, shortest paths, and the graph that is left without vertices of two edges
// (Zavyalov et al. 1985, V.2).
#pragma once

#include <vector>

#include "geometry/vectors.h"

namespace lekalo::geometry {

// An edge may be one of several between its vertices; a != b.
struct RouteEdge {
  int a = 0, b = 0;
  double weight = 0;        // not negative
  std::vector<Vec3> bends;  // where it is drawn between its ends, from a to b; none: straight
  int from(int vertex) const { return vertex == a ? b : a; }
};

struct RouteGraph {
  std::vector<Vec3> places;  // of the vertices
  std::vector<RouteEdge> edges;

  size_t size() const { return places.size(); }
  // Numbers of the edges at each vertex.
  std::vector<std::vector<int>> edges_at() const;
  std::vector<int> degrees() const;
  double weight() const;  // of all edges
};

// From one vertex to all others: distance infinity and edge -1 where there is no way.
struct ShortestPaths {
  int from = 0;
  std::vector<double> distance;
  std::vector<int> last_edge;  // by which the shortest way arrives
};
// Dijkstra 1959 (Z 185).
ShortestPaths shortest_paths(const RouteGraph& graph, int from);
// The edges of the way to a vertex, in order.
std::vector<int> edges_to(const RouteGraph& graph, const ShortestPaths& paths, int to);

// How many parts without a way between them.
int component_count(const RouteGraph& graph);

// The graph without the vertices of two edges: what ran through them is one edge with the sum of the weights. A ring
// without other vertices keeps one of its own, and one more where else its edge would lead back to itself.
struct ReducedGraph {
  RouteGraph graph;
  std::vector<int> vertex;               // of the whole graph, for each of its vertices
  std::vector<std::vector<int>> chains;  // edges of the whole graph, for each of its edges, from a to b
};
ReducedGraph reduced(const RouteGraph& whole);

}  // namespace lekalo::geometry
