// Surfaces that are planes, quadrics or tori by the way they were made.
#pragma once

#include <optional>

#include "geometry/queries/quadrics/canonical_surface.h"

namespace lekalo::geometry {

// The surface itself where canonical() knows it; else the plane, cylinder, cone, sphere or torus with the same points
// and parameters of its own: of an extrusion or revolution of a segment or an arc, and of a spline whose control points
// lie in a plane. It is bounded as the surface is, but a plane has no bounds. Nothing where it is none of these: a
// torus that passes its axis is none.
std::optional<CanonicalSurface> elementary_surface(const SurfacePtr& surface);

}  // namespace lekalo::geometry
