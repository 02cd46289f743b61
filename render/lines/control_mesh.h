// The net that controls a surface: of a NURBS surface or of a surface that is one, of a Bezier triangle, of a T-spline.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "geometry/surface.h"
#include "render/model/look.h"

namespace lekalo::render {

struct ControlMesh {
  struct Point {
    geometry::Vec3 at;
    std::array<double, 3> counters{};  // of a grid (i, j), of a triangle (i, j, k), of a T-spline its number
    bool is_corner = false;
  };
  struct Line {
    std::vector<int> points;
    bool closed = false;
  };
  std::vector<Point> points;
  std::vector<Line> lines;
};

// Points at infinity are left out. None of a surface without such a net.
std::optional<ControlMesh> control_mesh(const geometry::Surface& surface);

// What a helper shows beside the surface: `control_net` that, `t_mesh` of a T-spline its mesh at (u, v, 0).
std::optional<ControlMesh> shown_mesh(const geometry::Surface& surface, const Helper& helper);

// Whether a helper shows the mesh of a T-spline on the surface itself.
bool is_mesh_on_surface(const Helper& helper);

}  // namespace lekalo::render
