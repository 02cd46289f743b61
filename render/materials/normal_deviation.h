// Rough surface by random deviation of the normals (Golovanov 2016, 8.5):
//
//   m' = norm(m + sigma (xi_1 t_1 + xi_2 t_2)),   xi in [-1, 1)
//
// t_1, t_2 unit tangents, t_1 along r_u; xi from a hash of the cell of (u, v), so that the picture is repeatable.
#pragma once

#include <string_view>

#include "geometry/describe.h"
#include "render/ray.h"

namespace lekalo::render {

struct NormalDeviation {
  double amplitude = 0;  // sigma: tangent of the largest deviation along one tangent; 0: smooth
  Vec2 spacing{0.01};    // size of a cell in u and v
  int seed = 0;
};

Vec3 deviated_normal(const SurfacePoint& point, const NormalDeviation& deviation);

// Number of the point's cell; 0 without deviation.
uint64_t deviation_cell(const SurfacePoint& point, const NormalDeviation& deviation);

// The optional field `normal_deviation` of materials.
void declare_normal_deviation(geometry::TypeDeclaration& type);
NormalDeviation normal_deviation(const geometry::Fields& fields);

}  // namespace lekalo::render
