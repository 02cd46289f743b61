// Neighbours and normals of measured points.
#pragma once

#include <span>
#include <vector>

#include "geometry/vectors.h"

namespace lekalo::geometry {

// The numbers of the k nearest other points of each, the nearest first, of points as near as each other the first.
std::vector<std::vector<int>> nearest_neighbours(std::span<const Vec3> points, int k);

// Unit normals of the planes that fit each point and its neighbours best, turned alike along a shortest tree between
// neighbours (Hoppe et al. 1992); the highest point's looks up. Throws std::invalid_argument where the neighbours of a
// point lie on one line.
std::vector<Vec3> estimated_normals(std::span<const Vec3> points, const std::vector<std::vector<int>>& neighbours);

}  // namespace lekalo::geometry
