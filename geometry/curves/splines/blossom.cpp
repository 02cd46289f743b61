#include "geometry/curves/splines/blossom.h"

#include <vector>

namespace lekalo::geometry {

void bezier_points(int degree, std::span<const double> knots, int span, const Vec4* points, int stride, double a,
                   double b, Vec4* result, int result_stride) {
  std::vector<Vec4> level(degree + 1);
  for (int count_b = 0; count_b <= degree; ++count_b) {
    for (int j = 0; j <= degree; ++j) level[j] = points[(span - degree + j) * stride];
    for (int k = 1; k <= degree; ++k) {
      const double x = k <= count_b ? b : a;
      for (int j = degree; j >= k; --j) {
        const double left = knots[span - degree + j];
        const double right = knots[span + 1 + j - k];
        const double width = right - left;
        level[j] = affine_mix((right - x) / width, level[j - 1], (x - left) / width, level[j]);
      }
    }
    result[count_b * result_stride] = level[degree];
  }
}

}  // namespace lekalo::geometry
