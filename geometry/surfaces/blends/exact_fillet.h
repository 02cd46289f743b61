// Fillets that are tori or cylinders (Golovanov 2016, 4.9): those of two planes, of surfaces of revolution about one
// axis, of a cylinder and a plane across it or along it.
#pragma once

#include <memory>

#include "geometry/surfaces/blends/contacts.h"

namespace lekalo::geometry {

// The ball's center runs along a circle or a straight line, and the contacts keep their places beside it (to 1e-11 of
// the size, looked at in some places): the torus or cylinder, with its own parameters; v of the torus and u of the
// cylinder, the angles across the guide, begin at the contact with the first surface. Null where it is neither.
std::shared_ptr<Surface> exact_fillet(const Contacts& contacts);

}  // namespace lekalo::geometry
