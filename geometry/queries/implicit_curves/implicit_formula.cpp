#include "geometry/queries/implicit_curves/implicit_formula.h"

#include <cmath>

#include "geometry/numerics/jet2.h"

namespace lekalo::geometry {

Interval ImplicitFormula::enclose(const Box3& box) const {
  return (*this)(Interval(box.lo.x, box.hi.x), Interval(box.lo.y, box.hi.y), Interval(box.lo.z, box.hi.z));
}

bool ImplicitFormula::has_sheets(const Vec3& p, bool positive) const {
  using Pair = Jet2<double, 2>;
  double h[3][3], slope[3], largest = 0, steepest = 0;
  for (int k = 0; k < 3; ++k) {
    const int other = (k + 1) % 3;
    const auto at = [&](int axis) {
      return axis == k ? Pair::u_variable(p[axis]) : axis == other ? Pair::v_variable(p[axis]) : Pair(p[axis]);
    };
    const Pair pair = (*this)(at(0), at(1), at(2));
    const double sign = positive ? 1 : -1;
    slope[k] = pair.derivative(1, 0);
    h[k][k] = sign * pair.derivative(2, 0);
    h[k][other] = h[other][k] = sign * pair.derivative(1, 1);
    steepest = std::max(steepest, std::abs(slope[k]));
    largest = std::max({largest, std::abs(h[k][k]), std::abs(h[k][other])});
  }
  constexpr double kSmall = 1e-6;
  if (!(steepest < kSmall * largest)) return true;  // a silhouette, a kink, or a singular point of higher order
  // The form takes the other sign if one of its principal minors is negative.
  double determinant = 0;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    if (h[k][k] < -kSmall * largest) return true;
    if (h[i][i] * h[j][j] - h[i][j] * h[i][j] < -kSmall * largest * largest) return true;
    determinant += h[0][k] * (h[1][i] * h[2][j] - h[1][j] * h[2][i]);
  }
  return determinant < -kSmall * largest * largest * largest;
}

}  // namespace lekalo::geometry
