#include "geometry/queries/bezier_patch.h"

#include "geometry/curves/bspline_basis.h"

namespace lekalo::geometry {

namespace {

// Bernstein functions of degree n and their derivatives at s, by the recurrence (Golovanov 2016, 2.4.4).
void bernstein(int n, double s, double* b, double* d) {
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

PatchPoint evaluate(const PatchView& patch, double s, double t) {
  double bu[kMaxDegree + 1], du[kMaxDegree + 1], bv[kMaxDegree + 1], dv[kMaxDegree + 1];
  bernstein(patch.degree_u, s, bu, du);
  bernstein(patch.degree_v, t, bv, dv);
  Vec4 p(0), ps(0), pt(0);
  const Vec4* point = patch.points;
  for (int i = 0; i <= patch.degree_u; ++i) {
    Vec4 row(0), row_t(0);
    for (int j = 0; j <= patch.degree_v; ++j, ++point) {
      row += bv[j] * *point;
      row_t += dv[j] * *point;
    }
    p += bu[i] * row;
    ps += du[i] * row;
    pt += bu[i] * row_t;
  }
  const double inverse = 1 / p.w;
  PatchPoint result;
  result.point = inverse * Vec3(p);
  result.ds = inverse * (Vec3(ps) - ps.w * result.point);
  result.dt = inverse * (Vec3(pt) - pt.w * result.point);
  return result;
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
