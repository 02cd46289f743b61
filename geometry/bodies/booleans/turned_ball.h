// Whole balls whose poles and seam stand where the other body cuts them.
#pragma once

#include <optional>

#include "geometry/body.h"

namespace lekalo::geometry {

// The same ball with its poles on the common axis of the circles in which `other` cuts it, which are then parallels;
// else with poles and seam away from the curves that elementary faces cut, so that no edge runs over them. Nothing
// where the body is no whole ball, where it stands so already, or where there is no such place.
std::optional<Body> turned_ball(const Body& body, const Body& other);

}  // namespace lekalo::geometry
