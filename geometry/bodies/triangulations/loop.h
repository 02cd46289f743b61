// Loop's rules of subdivision of meshes of triangles (Loop 1987; sharp edges: Hoppe et al. 1994).
#pragma once

#include "geometry/bodies/triangulations/connected_mesh.h"
#include "geometry/surfaces/triangles/triangular_net.h"

namespace lekalo::geometry {

// Each triangle in four: child k < 3 holds corner k as its own, child 3 is the middle one, its corner k on the side
// opposite to corner k.
RefinedMesh refined_by_loop(const ConnectedMesh& mesh);

// What a vertex becomes when triangles are divided again and again. At the end of a single sharp edge nearly so, the
// nearer the smaller the triangles.
Vec3 loop_limit(const ConnectedMesh& mesh, int v);

// Whether all triangles at a vertex are polynomial there: six without sharp edges, or three on each side of a crease.
bool is_regular_for_loop(const ConnectedMesh& mesh, int v);

// The quartic Bezier net that a triangle is in the limit, a, b, c = 1 at its corners. Where one corner is not regular
// it only holds the limit of that corner, and shares its sides with the triangles beside it.
TriangularNet loop_net(const ConnectedMesh& mesh, int face);

}  // namespace lekalo::geometry
