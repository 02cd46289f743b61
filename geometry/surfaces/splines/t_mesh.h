// T-meshes: rectangles of the parameter plane cut into rectangles by lines that may end at one another (Sederberg et
// al. 2003; Golovanov 2016, 3.9).
#pragma once

#include <array>
#include <vector>

#include "geometry/surface.h"

namespace lekalo::geometry {

// Vertices and the axis-parallel edges between them; no vertex lies inside an edge, no edges cross.
struct TMesh {
  std::vector<Vec2> vertices;             // u, v
  std::vector<std::array<int, 2>> edges;  // numbers of vertices; the first has the lower u or v
  // A closed mesh goes on round and round: vertex i + k count is vertex i, some periods farther.
  int count = 0;
  Periods periods;
  // Edges of the vertices 0 .. count - 1 alone.
  std::vector<std::array<int, 2>> own_edges() const;
};

// The mesh of these vertices and lines, each a list of the numbers of vertices that it joins; vertices that a line
// passes belong to it. Throws FieldError (fields at, lines) unless the mesh is a rectangle cut into rectangles: lines
// parallel to the axes, a vertex wherever they meet, no loose ends or corners inside, all in one piece; and unless
// vertices that face each other across a cell are joined. In a direction with a period the mesh is closed: its lines
// run towards higher parameters, from the last vertex over the seam to the first. Throws FieldError (field period)
// where the vertices are farther apart than that.
TMesh t_mesh(const std::vector<Vec3>& at, const std::vector<std::vector<int>>& lines, const Periods& periods = {});

// The knots of the two functions of one vertex, degree + 2 each.
struct LocalKnots {
  std::vector<double> u, v;
};

// Of each vertex its own parameter, and (degree + 1)/2 to both sides: those of the edges across that a line from the
// vertex meets; the last one again where there are no more. The degree is odd.
std::vector<LocalKnots> inferred_knots(const TMesh& mesh, int degree);

}  // namespace lekalo::geometry
