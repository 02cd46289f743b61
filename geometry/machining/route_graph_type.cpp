// The scene type of weighted graphs and ways through them (Zavyalov et al. 1985, V.2).
#include <fmt/format.h>

#include <cmath>

#include "geometry/describe.h"
#include "geometry/machining/route_path.h"

namespace lekalo::geometry {

namespace {

// Sides of the polygon that stands for a bent edge.
constexpr int kSidesOfBend = 24;

// Inner points of the arc over a chord whose middle stands to the left of the chord by `bend` chords:
//   (h^2 + 1/4) / 2 |h| chords is its radius, 4 atan(2 h) its angle.
std::vector<Vec3> arc_over(const Vec3& a, const Vec3& b, double bend) {
  std::vector<Vec3> points;
  if (bend == 0) return points;
  const Vec3 chord = b - a, left(-chord.y, chord.x, 0.0);
  const double half_angle = 2 * std::atan(2 * std::abs(bend)), radius = 0.5 / std::sin(half_angle);
  const double center = std::abs(bend) - radius;  // beside the chord, towards the arc
  for (int k = 1; k < kSidesOfBend; ++k) {
    const double angle = half_angle * (2.0 * k / kSidesOfBend - 1);
    const double along = 0.5 + radius * std::sin(angle), across = center + radius * std::cos(angle);
    points.push_back(a + along * chord + std::copysign(across, bend) * left);
  }
  return points;
}

int vertex(const Fields& f, const char* field, size_t count) {
  const int number = f.integer(field);
  if (static_cast<size_t>(number) >= count)
    throw FieldError(field, fmt::format("there is no vertex {}", number), fmt::format("the last is {}", count - 1));
  return number;
}

void check_count(const Fields& f, const char* field, size_t edges) {
  if (f.has(field) && f.numbers(field).size() != edges)
    throw FieldError(field, fmt::format("{} numbers for {} edges", f.numbers(field).size(), edges),
                     "one number for each edge, in their order");
}

void add_edges(RouteGraph& graph, const Fields& f) {
  const std::vector<std::vector<int>>& edges = f.indices("edges");
  check_count(f, "weights", edges.size());
  check_count(f, "bends", edges.size());
  for (size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].size() != 2)
      throw FieldError("edges", fmt::format("edge {} has {} vertices", e, edges[e].size()), "each is [from, to]");
    for (const int v : edges[e])
      if (v < 0 || static_cast<size_t>(v) >= graph.size())
        throw FieldError("edges",
                         fmt::format("edge {} names vertex {}; there are vertices 0 to {}", e, v, graph.size() - 1));
    const int a = edges[e][0], b = edges[e][1];
    if (a == b) throw FieldError("edges", fmt::format("edge {} leads from vertex {} to itself", e, a));
    const Vec3 &from = graph.places[static_cast<size_t>(a)], &to = graph.places[static_cast<size_t>(b)];
    const double weight = f.has("weights") ? f.numbers("weights")[e] : glm::length(to - from);
    graph.edges.push_back({a, b, weight, arc_over(from, to, f.has("bends") ? f.numbers("bends")[e] : 0)});
  }
}

void add_matrix(RouteGraph& graph, const Grid<double>& matrix) {
  const int n = static_cast<int>(graph.size());
  if (matrix.rows != n || matrix.columns != n)
    throw FieldError("matrix", fmt::format("{} rows of {} numbers for {} places", matrix.rows, matrix.columns, n),
                     "a row for each place, with the weights of the edges to all places");
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double weight = matrix.at(i, j);
      if (!(weight >= 0)) throw FieldError("matrix", fmt::format("the weight {:g} is negative", weight));
      if (weight != matrix.at(j, i))
        throw FieldError(
            "matrix",
            fmt::format("row {} column {} is {:g}, row {} column {} is {:g}", i, j, weight, j, i, matrix.at(j, i)),
            "the same weight both ways");
      if (i == j && weight != 0) throw FieldError("matrix", fmt::format("vertex {} has an edge to itself", i));
      if (i < j && weight > 0) graph.edges.push_back({i, j, weight, {}});
    }
}

RouteGraph graph_of(const Fields& f) {
  if (f.has("edges") == f.has("matrix"))
    throw FieldError(f.has("matrix") ? "matrix" : "edges", "the edges are given by 'edges' or by 'matrix'",
                     "give one of both");
  for (const char* field : {"weights", "bends"})
    if (f.has("matrix") && f.has(field))
      throw FieldError(field, "the matrix says all of the edges", fmt::format("leave out '{}'", field));
  RouteGraph graph;
  graph.places = f.points("places");
  f.has("edges") ? add_edges(graph, f) : add_matrix(graph, f.number_grid("matrix"));
  return graph;
}

Walk shortest_walk(const RouteGraph& graph, int from, int to) {
  if (from == to) throw FieldError("to", "the way ends where it begins", "name two vertices: 'start' and 'to'");
  const ShortestPaths paths = shortest_paths(graph, from);
  if (!(paths.distance[static_cast<size_t>(to)] < kInfinity))
    throw FieldError("to", fmt::format("there is no way from vertex {} to vertex {}", from, to),
                     "edges that join the parts of the graph");
  Walk walk;
  int here = from;
  for (const int e : edges_to(graph, paths, to)) {
    const int next = graph.edges[static_cast<size_t>(e)].from(here);
    walk.push_back({e, here, next});
    here = next;
  }
  return walk;
}

PostmanRoute postman_of(const RoutePlan& plan, const Fields& f) {
  try {
    return postman_route(plan.graph, plan.start);
  } catch (const std::invalid_argument& error) {
    throw FieldError(f.has("edges") ? "edges" : "matrix", error.what(),
                     "all vertices are joined by edges, and few have an odd number of them");
  }
}

Walk walk_of(const RoutePlan& plan, const Fields& f) {
  const std::string& route = f.text("route");
  if (f.has("to") != (route == "shortest"))
    throw FieldError("to", route == "shortest" ? "the shortest way leads to a vertex" : "this way has no given end",
                     route == "shortest" ? "say 'to'" : "route: shortest");
  if (route == "shortest") return shortest_walk(plan.graph, plan.start, vertex(f, "to", plan.graph.size()));
  if (route == "visit") return shortened_walk(plan.graph, *plan.postman, f.has("start") ? plan.start : -1);
  return plan.postman->cycle;
}

}  // namespace

TypeDeclaration route_graph_type() {
  return declare(
             Category::curve, "route_graph",
             "A way through a graph with weights: the shortest closed one through all edges (Chinese postman), what "
             "is enough of it to visit all vertices, or the shortest between two vertices (Zavyalov et al. 1985, "
             "V.2). Vertices and edges are numbered from 0.")
      .example("places: [[0, 0], [2, 0], [2, 2], [0, 2]], edges: [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]]")
      .field("places", points().count(2, 2000), "the vertices")
      .optional("edges", indices().count(1), "pairs of vertices; several may join the same")
      .optional("weights", numbers().at_least(0), "of the edges; without it their lengths, straight")
      .optional("bends", numbers().between(-1, 1),
                "of the edges: they are drawn as arcs that stand to the left by so many chords, 0 for straight ones")
      .optional("matrix", number_grid(), "in place of edges: the weights between any two vertices, 0 for no edge")
      .field("route", choice({"postman", "visit", "shortest"}),
             "postman: closed, through all edges; visit: open, through all vertices by the edges of that; shortest: "
             "from 'start' to 'to'",
             "postman")
      .optional("start", integer().at_least(0), "vertex where the way begins; 0, or that of the shortest way to visit")
      .optional("to", integer().at_least(0), "vertex where the shortest way ends")
      .shows({"graph", "reduced_graph", "added_edges", "matching", "walk"})
      .built_by([](const Fields& f) -> std::any {
        RoutePlan plan;
        plan.graph = graph_of(f);
        if (f.has("start")) plan.start = vertex(f, "start", plan.graph.size());
        if (f.text("route") != "shortest") plan.postman = postman_of(plan, f);
        plan.reduced = reduced(plan.graph);
        plan.walk = walk_of(plan, f);
        try {
          CurvePtr path = path_through(points_of(plan.walk, plan.graph));
          return CurvePtr(std::make_shared<PlannedPath<RoutePlan>>(std::move(path), std::move(plan)));
        } catch (const FieldError&) {
          throw FieldError("places", "all vertices of the way lie at one place");
        }
      });
}

}  // namespace lekalo::geometry
