#include "geometry/curves/splines/bspline_basis.h"

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

namespace {

// The degree may be known.
template <int kDegree>
void make_span_basis(std::span<const double> knots, int span, double t, int order, SpanBasis& basis) {
  const int degree = kDegree > 0 ? kDegree : basis.degree;
  // row[j] is N_{span-d+j}^d, d growing to the degree; the last rows are kept.
  double row[kMaxDegree + 1];
  row[0] = 1;
  if (degree <= order) basis.values[degree][0] = 1;
  for (int d = 1; d <= degree; ++d) {
    const int k = degree - d;  // the derivative whose sums take this row; its differences' factors belong to k + 1
    double carried = 0;
    for (int j = 0; j < d; ++j) {
      const double left = knots[span - d + 1 + j], right = knots[span + 1 + j];
      const double reciprocal = 1 / (right - left);
      if (k < order) basis.factors[k + 1][j] = d * reciprocal;
      const double share = row[j] * reciprocal;
      row[j] = carried + (right - t) * share;
      carried = (t - left) * share;
    }
    row[d] = carried;
    if (k > order) continue;
    for (int j = 0; j <= d; ++j) basis.values[k][j] = row[j];
  }
}

}  // namespace

SpanBasis span_basis(int degree, std::span<const double> knots, int span, double t, int order) {
  SpanBasis basis;
  basis.degree = degree;
  if (degree == 3)
    make_span_basis<3>(knots, span, t, order, basis);
  else
    make_span_basis<0>(knots, span, t, order, basis);
  return basis;
}

void basis_derivative(int degree, std::span<const double> knots, int span, double t, int k, std::span<double> result) {
  std::fill_n(result.begin(), degree + 1, 0.0);
  if (k > degree) return;
  const SpanBasis basis = span_basis(degree, knots, span, t, k);
  std::copy_n(basis.values[k], degree - k + 1, result.begin());
  // Each step differentiates and raises the degree by one.
  for (int step = k; step >= 1; --step) {
    double previous = 0;
    for (int j = 0; j <= degree - step; ++j) {
      const double share = basis.factors[step][j] * result[j];
      result[j] = previous - share;
      previous = share;
    }
    result[degree - step + 1] = previous;
  }
}

}  // namespace lekalo::geometry
