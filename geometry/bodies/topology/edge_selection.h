// Which edges of a body a scene means: { between: [a, b] }, { of_face: f }, { parallel: z }, { named: edge.3 }.
#pragma once

#include <vector>

#include "geometry/body.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

FieldType edge_selector();

// The regular edges that meet all conditions of an edge_selector, sharp ones where it has none. Throws FieldError
// (field edges) for names of no face or edge, and where no edge is left.
std::vector<int> selected_edges(const Body& body, const Fields& selector);

// Its faces do not meet smoothly all along it.
bool is_sharp(const Body& body, int edge);

}  // namespace lekalo::geometry
