// Graphs and ways through them against brute force (Zavyalov et al. 1985, V.2).
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

#include "geometry/machining/route_postman.h"

namespace lekalo::geometry::route_test {

namespace {

Grid<double> random_distances(int n, std::mt19937& random) {
  std::uniform_real_distribution<double> place(0, 10);
  std::vector<Vec2> points;
  for (int i = 0; i < n; ++i) points.push_back({place(random), place(random)});
  Grid<double> result{n, n, std::vector<double>(static_cast<size_t>(n * n), 0.0)};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      result.at(i, j) = glm::length(points[static_cast<size_t>(i)] - points[static_cast<size_t>(j)]);
  return result;
}

// All matchings one after the other; how many there are.
double least_of_all(const Grid<double>& distances, std::vector<int> left, double sum, double& least) {
  if (left.empty()) {
    least = std::min(least, sum);
    return 1;
  }
  double count = 0;
  for (size_t k = 1; k < left.size(); ++k) {
    std::vector<int> rest;
    for (size_t i = 1; i < left.size(); ++i)
      if (i != k) rest.push_back(left[i]);
    count += least_of_all(distances, rest, sum + distances.at(left[0], left[k]), least);
  }
  return count;
}

// A connected graph of so many vertices, with some edges more than a tree.
RouteGraph random_graph(int n, int more, std::mt19937& random) {
  RouteGraph graph;
  std::uniform_int_distribution<int> weight(1, 20), any(0, n - 1);
  for (int v = 0; v < n; ++v) {
    graph.places.push_back(Vec3(v, v * v, 0));
    if (v > 0)
      graph.edges.push_back({std::uniform_int_distribution<int>(0, v - 1)(random), v, 1.0 * weight(random), {}});
  }
  while (more > 0) {
    const int a = any(random), b = any(random);
    if (a == b) continue;
    graph.edges.push_back({a, b, 1.0 * weight(random), {}});
    --more;
  }
  return graph;
}

TEST(Matching, IsTheLeastOfAll) {
  std::mt19937 random(1);
  for (const int n : {2, 4, 6, 8, 10}) {
    const Grid<double> distances = random_distances(n, random);
    std::vector<int> all;
    for (int i = 0; i < n; ++i) all.push_back(i);
    double least = std::numeric_limits<double>::infinity();
    EXPECT_EQ(least_of_all(distances, all, 0, least), matching_count(n));
    EXPECT_NEAR(weight(minimum_matching(distances), distances), least, 1e-12);
    const Pairs exchanged = matching_by_exchange(distances);
    std::set<int> vertices;
    for (const auto& [a, b] : exchanged) vertices.insert({a, b});
    EXPECT_EQ(static_cast<int>(vertices.size()), n);
    EXPECT_GE(weight(exchanged, distances), least - 1e-12);
    if (n <= 6) {
      EXPECT_NEAR(weight(exchanged, distances), least, 1e-12);
    }
  }
  EXPECT_EQ(matching_count(8), 105);
  EXPECT_EQ(matching_count(10), 945);
  EXPECT_EQ(matching_count(12), 10395);
}

TEST(ShortestPaths, AreThoseOfFloydAndWarshall) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 10; ++trial) {
    const int n = 12;
    const RouteGraph graph = random_graph(n, 10, random);
    Grid<double> all{n, n, std::vector<double>(n * n, std::numeric_limits<double>::infinity())};
    for (int i = 0; i < n; ++i) all.at(i, i) = 0;
    for (const RouteEdge& edge : graph.edges)
      all.at(edge.a, edge.b) = all.at(edge.b, edge.a) = std::min(all.at(edge.a, edge.b), edge.weight);
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) all.at(i, j) = std::min(all.at(i, j), all.at(i, k) + all.at(k, j));
    const ShortestPaths paths = shortest_paths(graph, 3);
    for (int j = 0; j < n; ++j) {
      EXPECT_EQ(paths.distance[static_cast<size_t>(j)], all.at(3, j));
      double sum = 0;
      for (const int e : edges_to(graph, paths, j)) sum += graph.edges[static_cast<size_t>(e)].weight;
      EXPECT_EQ(sum, all.at(3, j));
    }
  }
}

TEST(Postman, WalksEveryEdgeAndNoMoreThanTwice) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const RouteGraph graph = random_graph(14, trial % 7, random);
    const PostmanRoute route = postman_route(graph);
    std::vector<int> times(graph.edges.size(), 0);
    int at = route.cycle.front().from;
    for (const WalkStep& step : route.cycle) {
      EXPECT_EQ(step.from, at);
      EXPECT_EQ(graph.edges[static_cast<size_t>(step.edge)].from(step.from), step.to);
      ++times[static_cast<size_t>(step.edge)];
      at = step.to;
    }
    EXPECT_EQ(at, route.cycle.front().from);
    for (const int count : times) {
      EXPECT_GE(count, 1);
      EXPECT_LE(count, 2);
    }
    EXPECT_NEAR(route.weight, graph.weight() + route.matching_weight, 1e-9);
    const Walk visit = shortened_walk(graph, route);
    const std::vector<int> vertices = vertices_of(visit, 0);
    EXPECT_EQ(std::set<int>(vertices.begin(), vertices.end()).size(), graph.size());
    EXPECT_LE(weight(visit, graph), route.weight + 1e-9);
    EXPECT_NEAR(repeated_weight(visit, graph) <= weight(visit, graph), 1, 0);
  }
}

TEST(ReducedGraph, KeepsDistancesAndWeight) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 20; ++trial) {
    const RouteGraph graph = random_graph(16, trial % 4, random);
    const ReducedGraph small = reduced(graph);
    EXPECT_NEAR(small.graph.weight(), graph.weight(), 1e-9);
    for (size_t i = 0; i < small.graph.size(); ++i) {
      const ShortestPaths whole = shortest_paths(graph, small.vertex[i]),
                          part = shortest_paths(small.graph, static_cast<int>(i));
      for (size_t j = 0; j < small.graph.size(); ++j)
        EXPECT_EQ(part.distance[j], whole.distance[static_cast<size_t>(small.vertex[j])]);
    }
    for (const RouteEdge& edge : small.graph.edges) EXPECT_NE(edge.a, edge.b);
  }
}

TEST(ReducedGraph, ARingKeepsTwoVertices) {
  RouteGraph ring;
  for (int v = 0; v < 5; ++v) {
    ring.places.push_back(Vec3(v, v * v, 0));
    ring.edges.push_back({v, (v + 1) % 5, 1.0 + v, {}});
  }
  const ReducedGraph small = reduced(ring);
  EXPECT_EQ(small.graph.size(), 2u);
  EXPECT_EQ(small.graph.edges.size(), 2u);
  EXPECT_EQ(small.graph.weight(), 15);
}

}  // namespace
}  // namespace lekalo::geometry::route_test
