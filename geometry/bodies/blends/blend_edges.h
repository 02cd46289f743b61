// Which edges are blended: those that are asked for and those that go on smoothly from them.
#pragma once

#include <set>
#include <stdexcept>
#include <vector>

#include "geometry/bodies/blends/blend_band.h"
#include "geometry/bodies/blends/edge_fans.h"

namespace lekalo::geometry {

// Why an edge is not blended; where a size is at fault a smaller one may do.
class BlendError : public std::invalid_argument {
 public:
  BlendError(int edge, const std::string& message, bool too_large = true)
      : std::invalid_argument(message), edge(edge), too_large(too_large) {}
  int edge;
  bool too_large;
  std::string name = {};  // what messages call the edge
};

struct BlendRequest {
  std::vector<int> edges;
  BlendRule rule;
  std::set<int> first_faces;  // on which the first of two sizes counts; none: the right ones
  bool goes_on = true;        // along edges that continue the given ones smoothly
};

// Conjugate edges (Golovanov 2016, 6.9): they meet in a vertex with a common tangent, and what other edges end there
// are smooth. The index in the fan of the half-edge that continues the first one, or 0.
size_t continuation(const Body& body, const Fan& fan);

// The faces beside an edge have one tangent plane where it ends.
bool is_smooth_end(const Body& body, const HalfEdge& half);

// One for each edge, in the order in which they are asked for; `rules`: those of the requests, and more for edges that
// lead from one radius to another. Throws BlendError for an edge that is smooth or free or asked for twice.
std::vector<BlendEdge> blend_edges(const Body& body, const std::vector<BlendRequest>& requests,
                                   std::vector<BlendRule>& rules);

// The faces beside a half-edge: counterclockwise after it (the left one where it leaves the vertex), and before it.
inline int side_after(const HalfEdge& half) { return half.at_end ? 0 : 1; }
inline int side_before(const HalfEdge& half) { return half.at_end ? 1 : 0; }

}  // namespace lekalo::geometry
