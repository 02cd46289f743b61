// The edge curve of surfaces on triangulations (Golovanov 2016, 3.17.1; Vlachos et al. 2001).
#pragma once

#include <vector>

#include "geometry/vectors.h"

namespace lekalo::geometry {

// Lengths of the tangents: those of the projected chord; or |q - p|/cos^2(f/2), f the angle from the chord, which takes
// the error over an arc of the angle 2f from O(f^4) to O(f^6).
enum class EdgeTangents { projected, arc };

// Bezier points of the cubic from p to q whose end tangents are along the chord without its parts along the unit
// normals m and n there: p, p + v/3, q + w/3, q with v = (q - p) - m (m.(q - p)), w = (p - q) - n (n.(p - q)) or others
// along these. From q to p it is the same curve, so that neighbours share it.
std::vector<Vec3> hermite_edge(const Vec3& p, const Vec3& m, const Vec3& q, const Vec3& n,
                               EdgeTangents tangents = EdgeTangents::projected);

}  // namespace lekalo::geometry
