#include "geometry/curves/bspline_basis.h"

#include <algorithm>

namespace lekalo::geometry {

int find_span(int degree, std::span<const double> knots, double t) {
  const int last = static_cast<int>(knots.size()) - 1 - degree;
  const auto begin = knots.begin();
  // The last knot not above t, kept below the domain's end, then back over an empty span at that end.
  int span = static_cast<int>(std::upper_bound(begin + degree + 1, begin + last, t) - begin) - 1;
  while (span > degree && !(knots[span] < knots[span + 1])) --span;
  while (span < last - 1 && !(knots[span] < knots[span + 1])) ++span;
  return span;
}

void basis_derivatives(int degree, std::span<const double> knots, int span, double t, int order,
                       BasisDerivatives& result) {
  // values[d][j] is N_{span-d+j}^d; reciprocal[d][j] is 1/(t_{i+d} - t_i) with i = span - d + 1 + j.
  double values[kMaxDegree + 1][kMaxDegree + 1];
  double reciprocal[kMaxDegree + 1][kMaxDegree + 1];
  values[0][0] = 1;
  for (int d = 1; d <= degree; ++d) {
    double carried = 0;
    for (int j = 0; j < d; ++j) {
      const double left = knots[span - d + 1 + j], right = knots[span + 1 + j];
      reciprocal[d][j] = 1 / (right - left);
      const double share = values[d - 1][j] * reciprocal[d][j];
      values[d][j] = carried + (right - t) * share;
      carried = (t - left) * share;
    }
    values[d][d] = carried;
  }

  std::copy_n(values[degree], degree + 1, result.d[0].begin());
  for (int k = 1; k <= order; ++k) {
    auto& row = result.d[k];
    if (k > degree) {
      std::fill_n(row.begin(), degree + 1, 0.0);
      continue;
    }
    // Differentiate k times, raising the degree by one each time.
    std::copy_n(values[degree - k], degree - k + 1, row.begin());
    for (int d = degree - k + 1; d <= degree; ++d) {
      double previous = 0;
      for (int j = 0; j < d; ++j) {
        const double share = d * row[j] * reciprocal[d][j];
        row[j] = previous - share;
        previous = share;
      }
      row[d] = previous;
    }
  }
}

}  // namespace lekalo::geometry
