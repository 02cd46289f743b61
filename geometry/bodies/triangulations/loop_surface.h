// Limit surfaces of Loop's subdivision.
#pragma once

#include "geometry/bodies/triangulations/connected_mesh.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// Quartic Bezier triangles that lie side by side, those of one triangle of the mesh after the other; towards corners
// that are not regular ever smaller ones, `levels` times. Their parameters are the barycentric coordinates of triangle
// t, (2 t + a, b).
std::vector<SurfacePtr> loop_surface(const ConnectedMesh& mesh, int levels);

}  // namespace lekalo::geometry
