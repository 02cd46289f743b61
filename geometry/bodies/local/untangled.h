// Polyhedra that pass through themselves, cleared of what is inside out (Golovanov 2016, 6.7 step 6).
#pragma once

#include <vector>

#include "geometry/body.h"

namespace lekalo::geometry {

struct Untangled {
  Body body;
  std::vector<int> faces;  // of the tangled body
  bool changed = false;    // false: the body did not pass through itself, and is left as it is
};

// The points that the faces enclose once or oftener, bounded by as few faces as can be: faces in one plane that lie
// side by side become one. All faces plane, all edges straight. An empty body where nothing is enclosed. Throws
// std::invalid_argument where the result touches itself along an edge.
Untangled untangled(const Body& body);

}  // namespace lekalo::geometry
