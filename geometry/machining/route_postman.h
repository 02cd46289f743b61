// The shortest closed way through all edges of a graph (Chinese postman), and the shorter open one that visits all
// vertices (Zavyalov et al. 1985, V.2; Edmonds, Johnson 1973).
//
// Vertices of an odd number of edges are paired so that the sum of their distances is least; the edges of the shortest
// ways between the pairs are walked once more. Then a closed way runs through all of them (Euler, by Hierholzer 1873).
#pragma once

#include <string>
#include <vector>

#include "geometry/machining/route_graph.h"
#include "geometry/machining/route_matching.h"

namespace lekalo::geometry {

struct WalkStep {
  int edge = 0;
  int from = 0, to = 0;
};
using Walk = std::vector<WalkStep>;

struct PostmanRoute {
  std::vector<int> odd;        // vertices, increasing
  Grid<double> distances;      // between them
  Pairs matching;              // of vertices
  double matching_weight = 0;  // its sum
  bool exact = true;           // false: by exchanges, it may be longer than the least
  std::vector<int> again;      // edges that are walked a second time
  Walk cycle;                  // closed, through all of these, from `start`
  double weight = 0;           // of the cycle
};

// Throws std::invalid_argument where the graph has no edges or falls apart, or has more odd vertices than
// kMaxExchangeMatching.
PostmanRoute postman_route(const RouteGraph& graph, int start = 0);

// Of closed ways through the same edges, what visits every vertex and no more: it begins at a vertex of one edge, ends
// at the last new vertex, and what runs back to a vertex through visited ones alone is left out. The shortest of some
// hundred closed ways from all vertices of one edge (from `start` alone if it is not negative; from all vertices if
// none has one edge); of equals the one whose numbers come first.
Walk shortened_walk(const RouteGraph& graph, const PostmanRoute& route, int start = -1);

// The vertices in order, one more than steps.
std::vector<int> vertices_of(const Walk& walk, int start);
double weight(const Walk& walk, const RouteGraph& graph);
// Of the steps that lead to vertices visited before.
double repeated_weight(const Walk& walk, const RouteGraph& graph);

}  // namespace lekalo::geometry
