// Where faces of a closed body come together in a point: its vertices, and the wounds that faces leave behind which are
// taken away, each of which is to close to a point, or to a tree of edges (Golovanov 2016, 6.7 and 6.12).
#pragma once

#include <vector>

#include "geometry/body.h"

namespace lekalo::geometry {

// A face's part of a corner, between two edges that stay. `out` leaves the corner along the face's loop, `in` arrives.
struct Sector {
  int face;
  int out, in;  // coedges
};

// Sectors in cyclic order: `in` of each and `out` of the next are the two uses of one edge, the spoke between them. At
// a pole an edge of no length is both.
struct Corner {
  std::vector<Sector> sectors;
  int vertex = -1;  // the body's; -1 of a wound
};

// Of a closed body without the faces that are removed; those that only touch removed faces in loops of their own have
// no corner there. In the order of the vertices. Throws std::invalid_argument where an edge has not two uses.
std::vector<Corner> corners_of(const Body& body, const std::vector<char>& removed);

// The coedge before and after another one in its loop, the other use of its edge (of a pole edge itself), the vertex
// that it leaves.
int coedge_before(const Body& body, int coedge);
int coedge_after(const Body& body, int coedge);
int coedge_partner(const Body& body, int coedge);
int vertex_before(const Body& body, int coedge);
int vertex_after(const Body& body, int coedge);
int face_of_coedge(const Body& body, int coedge);

}  // namespace lekalo::geometry
