// Boundary representation of bodies: body, shells, faces, loops, coedges, edges, vertices (Golovanov 2016, chapter 5).
//
// Flat arrays linked by integer handles. Every coedge carries the edge's image in its face's parameter plane at the
// edge's own parameter. Seam edges (a closed face meeting itself) are used twice by one loop; pole edges have a curve
// of no length and are used once.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "geometry/curve.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// Where an entity comes from; scene files select by it: feature.role.index, for example blank.side.2.
struct Origin {
  std::string feature;  // name of the operation or primitive, may be empty
  std::string role;     // start, end, side, x_min, ...
  int index = -1;       // number among equals, -1 when there is only one
  std::string text() const;
};

struct Vertex {
  Vec3 point{0};
  double tolerance = 0;  // length
  Origin origin;
};

enum class EdgeKind { regular, seam, pole };

// Runs along its curve's domain from vertex `start` to vertex `end` (equal for a closed edge).
struct Edge {
  CurvePtr curve;
  int start = -1;
  int end = -1;
  EdgeKind kind = EdgeKind::regular;
  double tolerance = 0;  // largest distance of the curve from the faces' images of it
  std::vector<int> coedges;
  Origin origin;
};

// One use of an edge by a loop. The image runs with the edge's parameter: surface(image(t)) = curve(t).
struct Coedge {
  int edge = -1;
  bool forward = true;  // the loop runs along the edge (+) or against it (-)
  int loop = -1;
  Curve2Ptr image;
};

// Closed sequence of coedges with the face on its left, seen against the face normal.
struct Loop {
  int face = -1;
  std::vector<int> coedges;
};

struct Face {
  SurfacePtr surface;
  bool forward = true;     // face normal = surface normal (+) or its opposite (-); outward in a closed body
  std::vector<int> loops;  // outer loop first
  int shell = -1;
  bool trimmed = true;  // false where the loops run along the border of the surface's domain
  Origin origin;
};

struct Shell {
  std::vector<int> faces;
  bool closed = true;
};

// One condition of a valid body that is not met (Golovanov 2016, 5.3), with the entity concerned.
struct Violation {
  std::string condition;
  std::string entity;
};

class Body {
 public:
  std::vector<Vertex> vertices;
  std::vector<Edge> edges;
  std::vector<Coedge> coedges;
  std::vector<Loop> loops;
  std::vector<Face> faces;
  std::vector<Shell> shells;

  int add_vertex(const Vec3& point, Origin origin = {});
  int add_edge(CurvePtr curve, int start, int end, Origin origin = {}, EdgeKind kind = EdgeKind::regular);
  int add_face(SurfacePtr surface, bool forward, Origin origin = {}, bool trimmed = true);
  // uses: (edge, forward, image) in order along the loop. The first loop of a face is the outer one.
  struct Use {
    int edge;
    bool forward;
    Curve2Ptr image;
  };
  int add_loop(int face, const std::vector<Use>& uses);
  // Puts all faces into one shell.
  void close_shell(bool closed = true);

  // All conditions that are not met: links, closed loops, edge uses, coincidence of images with curves within
  // tolerance, orientation. Empty for a valid body.
  std::vector<Violation> violations() const;
  bool is_valid() const { return violations().empty(); }
  bool is_closed() const;

  // F - E + V + (F - L) with pole edges left out (Golovanov 2016, 5.2.1).
  int euler_characteristic() const;

  // Outward unit normal of a face at surface parameters.
  Vec3 normal(int face, double u, double v) const;
};

using BodyPtr = std::shared_ptr<const Body>;

Box3 bounds(const Body& body);
Box3 bounds(const Body& body, int face);

// The body under an affine map; a negative determinant turns faces and loops so that it stays outward-oriented.
Body transformed(const Body& body, const Affine& map);

}  // namespace lekalo::geometry
