#include "geometry/queries/bezier_patch.h"

#include "geometry/curves/bspline_basis.h"
#include "geometry/numerics/instruction_sets.h"
#include "geometry/numerics/lanes.h"

namespace lekalo::geometry {

namespace {

// Bernstein functions of degree n and their derivatives at s, by the recurrence (Golovanov 2016, 2.4.4); written out up
// to degree 3.
inline void bernstein(int n, double s, double* b, double* d) {
  const double r = 1 - s;
  switch (n) {
    case 1:
      b[0] = r, b[1] = s;
      d[0] = -1, d[1] = 1;
      return;
    case 2:
      b[0] = r * r, b[1] = 2 * r * s, b[2] = s * s;
      d[0] = -2 * r, d[1] = 2 * (r - s), d[2] = 2 * s;
      return;
    case 3: {
      const double rr = r * r, rs = 2 * r * s, ss = s * s;
      b[0] = rr * r, b[1] = 3 * rr * s, b[2] = 3 * r * ss, b[3] = ss * s;
      d[0] = -3 * rr, d[1] = 3 * (rr - rs), d[2] = 3 * (rs - ss), d[3] = 3 * ss;
      return;
    }
    default:
      break;
  }
  double lower[kMaxDegree + 1] = {1};
  b[0] = 1;
  for (int k = 1; k <= n; ++k) {
    if (k == n)
      for (int i = 0; i < n; ++i) lower[i] = b[i];
    double carry = 0;
    for (int i = 0; i < k; ++i) {
      const double value = b[i];
      b[i] = carry + (1 - s) * value;
      carry = s * value;
    }
    b[k] = carry;
  }
  if (n == 0) {
    d[0] = 0;
    return;
  }
  d[0] = -n * lower[0];
  for (int i = 1; i < n; ++i) d[i] = n * (lower[i - 1] - lower[i]);
  d[n] = n * lower[n - 1];
}

// Halves one row of n + 1 points that stand `stride` apart.
void halve_row(const Vec4* row, int n, int stride, Vec4* first, Vec4* second) {
  Vec4 work[kMaxDegree + 1];
  for (int i = 0; i <= n; ++i) work[i] = row[i * stride];
  for (int k = 0; k <= n; ++k) {
    first[k * stride] = work[0];
    second[(n - k) * stride] = work[n - k];
    for (int i = 0; i < n - k; ++i) work[i] = 0.5 * (work[i] + work[i + 1]);
  }
}

}  // namespace

namespace {

// The degrees that most models have get loops of known length.
template <int kQ>
inline PatchPoint evaluate_rows(const PatchView& patch, double s, double t) {
  const int p = patch.degree_u, q = kQ > 0 ? kQ : patch.degree_v;
  double bu[kMaxDegree + 1], du[kMaxDegree + 1], bv[kMaxDegree + 1], dv[kMaxDegree + 1];
  bernstein(p, s, bu, du);
  bernstein(q, t, bv, dv);
  Lanes sum{}, sum_s{}, sum_t{};
  const Vec4* point = patch.points;
  for (int i = 0; i <= p; ++i) {
    Lanes row{}, row_t{};
    for (int j = 0; j <= q; ++j, ++point) {
      Lanes c;
      load(*point, c);
      row += bv[j] * c;
      row_t += dv[j] * c;
    }
    sum += bu[i] * row;
    sum_s += du[i] * row;
    sum_t += bu[i] * row_t;
  }
  const double inverse = 1 / sum[3];
  PatchPoint result;
  result.point = {inverse * sum[0], inverse * sum[1], inverse * sum[2]};
  result.ds = inverse * (Vec3(sum_s[0], sum_s[1], sum_s[2]) - sum_s[3] * result.point);
  result.dt = inverse * (Vec3(sum_t[0], sum_t[1], sum_t[2]) - sum_t[3] * result.point);
  return result;
}

}  // namespace

LEKALO_WIDE PatchPoint evaluate(const PatchView& patch, double s, double t) {
  switch (patch.degree_v) {
    case 1:
      return evaluate_rows<1>(patch, s, t);
    case 2:
      return evaluate_rows<2>(patch, s, t);
    case 3:
      return evaluate_rows<3>(patch, s, t);
    default:
      return evaluate_rows<0>(patch, s, t);
  }
}

void halve_u(const PatchView& patch, Vec4* first, Vec4* second) {
  const int columns = patch.degree_v + 1;
  for (int j = 0; j < columns; ++j) halve_row(patch.points + j, patch.degree_u, columns, first + j, second + j);
}

void halve_v(const PatchView& patch, Vec4* first, Vec4* second) {
  const int columns = patch.degree_v + 1;
  for (int i = 0; i <= patch.degree_u; ++i)
    halve_row(patch.points + i * columns, patch.degree_v, 1, first + i * columns, second + i * columns);
}

}  // namespace lekalo::geometry
