// What helpers draw of paths that were planned, in the path's own coordinates (Zavyalov et al. 1985, V.2, V.3).
//
//   graph, reduced_graph, added_edges, matching, walk      of a graph and the way through it
//   region, trapezoids, finishing                          of a pocket
//   feed_points, drilling                                  of a pass of turning, of an order of holes
#pragma once

#include <string>
#include <vector>

#include "geometry/curve.h"
#include "render/model/look.h"

namespace lekalo::render {

struct RouteFigure {
  struct Line {
    geometry::CurvePtr curve;
    bool arrow = false;  // a head at its end
  };
  struct Text {
    geometry::Vec3 point;
    std::string words;
  };
  std::vector<Line> lines;
  std::vector<Text> texts;
  std::vector<geometry::Vec3> points;  // that get the helper's marker
};

// Whether a helper is one of these.
bool is_route_figure(const std::string& helper);

// Nothing for curves that are no planned path.
RouteFigure route_figure(const geometry::Curve& curve, const Helper& helper);

}  // namespace lekalo::render
