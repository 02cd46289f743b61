// Surfaces that are cheaper on a grid of parameters than point by point.
#pragma once

#include <vector>

#include "geometry/vectors.h"

namespace lekalo::geometry {

class GridPoints {
 public:
  virtual ~GridPoints() = default;
  // The points (u_i, v_j) at i * v.size() + j: those of Surface::point.
  virtual std::vector<Vec3> points_over_grid(std::vector<double> u, std::vector<double> v) const = 0;
};

}  // namespace lekalo::geometry
