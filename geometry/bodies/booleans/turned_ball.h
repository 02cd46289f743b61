// Whole balls whose poles and seam stand where the other body cuts them.
#pragma once

#include <optional>

#include "geometry/body.h"

namespace lekalo::geometry {

// The same ball with its poles on the common axis of the circles in which `other` cuts it: circles that are its
// parallels, so that none runs through a pole or over the seam more than once, and images are straight lines. Nothing
// where the body is no whole ball, where it stands so already, or where there is no such axis.
std::optional<Body> turned_ball(const Body& body, const Body& other);

}  // namespace lekalo::geometry
