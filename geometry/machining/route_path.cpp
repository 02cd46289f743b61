#include "geometry/machining/route_path.h"

#include <algorithm>

#include "geometry/curves/analytic/polyline.h"

namespace lekalo::geometry {

CurvePtr path_through(std::vector<Vec3> points) {
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return std::make_shared<NurbsCurve>(polyline(points));
}

std::vector<Vec3> points_of(const RouteEdge& edge, const RouteGraph& graph, int from) {
  std::vector<Vec3> points{graph.places[static_cast<size_t>(edge.a)]};
  points.insert(points.end(), edge.bends.begin(), edge.bends.end());
  points.push_back(graph.places[static_cast<size_t>(edge.b)]);
  if (from != edge.a) std::reverse(points.begin(), points.end());
  return points;
}

std::vector<Vec3> points_of(const Walk& walk, const RouteGraph& graph) {
  std::vector<Vec3> points;
  for (const WalkStep& step : walk) {
    const std::vector<Vec3> some = points_of(graph.edges[static_cast<size_t>(step.edge)], graph, step.from);
    points.insert(points.end(), some.begin(), some.end());
  }
  return points;
}

}  // namespace lekalo::geometry
