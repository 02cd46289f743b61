// The edge curve of surfaces on triangulations (Golovanov 2016, 3.17.1; Vlachos et al. 2001).
#pragma once

#include <vector>

#include "geometry/vectors.h"

namespace lekalo::geometry {

// Bezier points of the cubic from p to q whose end tangents are the chord without its parts along the unit normals m
// and n there: p, p + v/3, q + w/3, q with v = (q - p) - m (m.(q - p)), w = (p - q) - n (n.(p - q)). From q to p it is
// the same curve, so that neighbours share it.
std::vector<Vec3> hermite_edge(const Vec3& p, const Vec3& m, const Vec3& q, const Vec3& n);

}  // namespace lekalo::geometry
