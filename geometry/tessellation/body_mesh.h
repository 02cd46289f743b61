// Parts of the tessellation of bodies: edge polygons that faces share, and the mesh of one face.
#pragma once

#include <set>
#include <stdexcept>
#include <unordered_set>

#include "geometry/body.h"
#include "geometry/tessellation/grid_lines.h"

namespace lekalo::geometry {

// The polygon of an edge: parameters and the mesh points at them. A pole edge has one point throughout.
struct EdgePolygon {
  std::vector<double> t;
  std::vector<int32_t> point;
};

// Pairs of mesh points, in any order.
class PointPairs {
 public:
  void add(int32_t a, int32_t b) { pairs_.insert(key(a, b)); }
  bool contains(int32_t a, int32_t b) const { return pairs_.count(key(a, b)) > 0; }

 private:
  static uint64_t key(int32_t a, int32_t b) {
    return (static_cast<uint64_t>(static_cast<uint32_t>(std::min(a, b))) << 32) | static_cast<uint32_t>(std::max(a, b));
  }
  std::unordered_set<uint64_t> pairs_;
};

// What the faces of a body mesh share.
struct BodyMesh {
  Mesh mesh;
  std::vector<EdgePolygon> edges;
  int32_t border_points = 0;  // points below this number lie on edges
  PointPairs border_sides;    // sides of edge polygons
  PointPairs chords;          // other triangle sides between border points: no second face may use one
};

// The border polygons of a face cross each other in its parameter plane: its edges' polygons are too coarse.
struct CoarseBorder : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

// Parameter rectangle that a face's grid covers: the domain of an untrimmed face, else a box around its loops.
Rectangle grid_box(const Body& body, int face);

// Where the coordinate of a strictly monotone image takes the value.
double parameter_at(const Curve& image, int coordinate, double value);

// 0 or 1: the image runs at a constant value of that coordinate; -1: neither.
int constant_coordinate(const Curve& image);

// Gives faces that meet along whole sides the same lines there.
void share_lines(const Body& body, const TessellationTolerance& tolerance, std::vector<SurfaceGrid>& grids);

// Adds the triangles of a face to the mesh; the polygons of its edges are there.
void add_face_mesh(const Body& body, int face, const SurfaceGrid& grid, const TessellationTolerance& tolerance,
                   BodyMesh& result);

// True when the polygons of the edges of an untrimmed face end exactly at its grid's lines, so that it needs no band.
bool is_all_grid(const Body& body, int face, const SurfaceGrid& grid, const std::vector<EdgePolygon>& edges);

}  // namespace lekalo::geometry
