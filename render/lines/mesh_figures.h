// What helpers draw of a plane triangulation: circles and cells of its triangles (Golovanov 2016, 8.6), in the mesh's
// own coordinates.
#pragma once

#include <string>
#include <vector>

#include "geometry/curve.h"
#include "geometry/mesh.h"
#include "render/model/look.h"

namespace lekalo::render {

struct MeshFigure {
  std::vector<geometry::CurvePtr> lines;
  std::vector<geometry::Vec3> points;  // that get the helper's marker
};

// circumcircles, voronoi, greedy_edges
bool is_mesh_figure(const std::string& helper);

// Triangles without a circumcircle have none.
MeshFigure mesh_figure(const geometry::Mesh& mesh, const Helper& helper);

}  // namespace lekalo::render
