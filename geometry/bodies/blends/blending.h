// Fillets and chamfers of edges of bodies (Golovanov 2016, 6.9 to 6.11).
#pragma once

#include <vector>

#include "geometry/bodies/blends/blend_edges.h"
#include "geometry/body.h"

namespace lekalo::geometry {

// What is made of a corner whose edges are all filleted with one radius: a piece of a sphere, or edges in which the
// fillets meet.
enum class Corners { round, mitred };

// Whether it is looked for that blends run into faces that are no neighbours of their edges: it takes long where they
// nearly touch.
enum class Room { checked, assumed };

// The body with a blend in place of each edge of the requests. Faces keep their surfaces and names; the new ones are
// called by the role of their rule, with a number where there are several. Where edges of different radii, or convex
// and concave ones, meet in a corner one goes after the other. The result is valid. Throws BlendError for an edge that
// cannot be blended, with the reason.
Body blended(const Body& body, const std::vector<BlendRequest>& requests, Corners corners = Corners::round,
             Room room = Room::checked);

// All edges at once; `edges`: the new numbers of the old edges, -1 for those that are gone. Faces keep their numbers.
// New faces and edges have no numbers in their names.
struct Stage {
  Body body;
  std::vector<int> edges;
};
Stage blended_at_once(const Body& body, const std::vector<BlendRequest>& requests, Corners corners);

}  // namespace lekalo::geometry
