// Curvatures of what a hit is on, from its own second derivatives.
#pragma once

#include "geometry/queries/differential/curvature.h"
#include "render/trace/world.h"

namespace lekalo::render {

// At `point`, which the hit shows, signed by its normal; in world space. Of a mesh that stands for surfaces those of
// the surface. Not regular where nothing is known: on meshes of mere triangles, at tips, where second derivatives are
// missing.
geometry::SurfaceCurvature curvature_at(const World& world, const Hit& hit, const SurfacePoint& point);

}  // namespace lekalo::render
