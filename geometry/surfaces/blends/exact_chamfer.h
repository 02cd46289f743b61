// Chamfers that are planes or cones (Golovanov 2016, 4.10): those of two planes, of surfaces of revolution about one
// axis.
#pragma once

#include <memory>

#include "geometry/surfaces/blends/contacts.h"

namespace lekalo::geometry {

// Both contacts run along parallel lines, or circles about one axis (to 1e-11 of the size, looked at in some places):
// the plane or cone. Its u runs with the guide, v from the first contact to the second. Null where it is neither.
std::shared_ptr<Surface> exact_chamfer(const Contacts& contacts);

}  // namespace lekalo::geometry
