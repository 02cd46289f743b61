// Catmull's and Clark's rules of subdivision (Catmull, Clark 1978).
#pragma once

#include "geometry/bodies/triangulations/connected_mesh.h"

namespace lekalo::geometry {

// Each face of n corners in n of four; corner k of child k of a face is that of the face.
RefinedMesh refined_by_catmull_clark(const ConnectedMesh& mesh);

// What a vertex becomes when faces are divided again and again; all faces around it have four corners. At the end of
// a single sharp edge nearly so, the nearer the smaller the faces.
Vec3 catmull_clark_limit(const ConnectedMesh& mesh, int v);

// The control points of the bicubic B-spline patch that a face of four corners is in the limit; (i, j) at i * 4 + j,
// i from its corner 0 to corner 1. Where it is none, for the sake of one corner, the point beyond that corner means
// nothing.
struct PatchNet {
  std::array<Vec3, 16> points;
  std::vector<int> irregular;  // corners
};
PatchNet patch_net(const ConnectedMesh& mesh, int face);

}  // namespace lekalo::geometry
