#include "geometry/queries/rays/bezier_patch.h"

#include "geometry/numerics/instruction_sets.h"
#include "geometry/queries/rays/bezier_sums.h"

namespace lekalo::geometry {

namespace {

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

template <int kP, int kQ>
inline PatchPoint evaluate_as(const PatchView& patch, double s, double t) {
  const PatchSums<Lanes> at = sums<kP, kQ, double, Lanes>(patch, s, t);
  const double inverse = 1 / at.point[3];
  const Lanes point = inverse * at.point, ds = inverse * (at.ds - at.ds[3] * point),
              dt = inverse * (at.dt - at.dt[3] * point);
  return {{point[0], point[1], point[2]}, {ds[0], ds[1], ds[2]}, {dt[0], dt[1], dt[2]}};
}

}  // namespace

LEKALO_WIDE PatchPoint evaluate(const PatchView& patch, double s, double t) {
  return for_degrees(patch, [&]<int kP, int kQ>() { return evaluate_as<kP, kQ>(patch, s, t); });
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
