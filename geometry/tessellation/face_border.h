// The border of a face where its grid and its edges' polygons meet.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "geometry/tessellation/body_mesh.h"

namespace lekalo::geometry {

// Grid lines at whole numbers; a line that stands twice (a crease) counts once.
class LinePlane {
 public:
  LinePlane(const SurfaceGrid& grid, const Surface& surface) : u_(unique(grid.u)), v_(unique(grid.v)) {
    // Where neither direction has lines of its own the metric is the surface's.
    if (u_.size() == 2 && v_.size() == 2) {
      const SurfaceJet jet = surface.evaluate(0.5 * (u_[0] + u_[1]), 0.5 * (v_[0] + v_[1]), 1);
      const double width = glm::length(jet.du()) * (u_[1] - u_[0]), height = glm::length(jet.dv()) * (v_[1] - v_[0]);
      if (width > 0 && height > 0) scale_ = {1, height / width};
    }
  }

  Vec2 place(const Vec2& uv) const { return scale_ * Vec2(position(u_, uv.x), position(v_, uv.y)); }
  Vec2 parameters(const Vec2& place) const { return {value(u_, place.x / scale_.x), value(v_, place.y / scale_.y)}; }

 private:
  static std::vector<double> unique(std::vector<double> lines) {
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    return lines;
  }
  static double position(const std::vector<double>& lines, double x) {
    const auto after = std::upper_bound(lines.begin() + 1, lines.end() - 1, x);
    const auto before = after - 1;
    return static_cast<double>(before - lines.begin()) + (x - *before) / (*after - *before);
  }
  static double value(const std::vector<double>& lines, double x) {
    const int k = std::clamp(static_cast<int>(std::floor(x)), 0, static_cast<int>(lines.size()) - 2);
    return lines[k] + (x - k) * (lines[k + 1] - lines[k]);
  }
  std::vector<double> u_, v_;
  Vec2 scale_{1};
};

// The places of all polygon points along a loop, each with the edge and its point's number.
struct BorderPoint {
  Vec2 uv;
  int edge;
  size_t index;
};

// With the face on the left: in the order of the loop, or backwards.
std::vector<BorderPoint> border_of(const Body& body, int loop, bool with_face_on_left,
                                   const std::vector<EdgePolygon>& edges);

// The grid node at a place of the border of an untrimmed face's rectangle, (-1, -1) if there is none. Of a line that
// stands twice it is the second.
std::array<int, 2> border_node(const SurfaceGrid& grid, const Vec2& uv);

// +1 where triangles counterclockwise in the parameter plane look outward.
double side_of(const Body& body, int face);

// Which sides of an untrimmed face's rectangle have border points exactly at the grid's nodes: u_min, u_max, v_min,
// v_max.
std::array<bool, 4> matched_sides(const SurfaceGrid& grid, const std::vector<BorderPoint>& border);

}  // namespace lekalo::geometry
