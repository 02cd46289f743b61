// Table 3 of Zavyalov, Leus, Skorospelov 1985: points of a blade section (t, z) and the printed locally smoothed z.
#pragma once

#include <vector>

#include "geometry/vectors.h"

namespace lekalo::geometry {

inline const std::vector<double> kBladeT = {-55.245, -50.634, -46.110, -41.671, -37.319, -33.053, -28.875, -24.783,
                                            -20.778, -16.856, -12.991, -9.177,  -5.413,  -1.668,  2.370,   6.783,
                                            11.567,  16.721,  22.239,  28.118,  34.353,  40.937,  47.865};
inline const std::vector<double> kBladeZ = {-135.257, -123.455, -111.621, -99.758, -87.862, -75.937, -63.983, -52.000,
                                            -39.989,  -27.952,  -15.899,  -3.831,  8.252,   20.369,  32.454,  44.406,
                                            56.211,   67.857,   79.331,   90.616,  101.702, 112.573, 123.218};
inline const std::vector<double> kBladeSmoothed = {
    -135.249, -123.448, -111.619, -99.754, -87.859, -75.928, -63.969, -51.976, -39.961, -27.932, -15.844, -3.731,
    8.352,    20.269,   32.354,   44.396,  56.280,  67.957,  79.430,  90.690,  101.737, 112.570, 123.210};

inline std::vector<Vec3> blade_points() {
  std::vector<Vec3> points;
  for (size_t i = 0; i < kBladeT.size(); ++i) points.push_back({kBladeT[i], kBladeZ[i], 0});
  return points;
}

}  // namespace lekalo::geometry
