// Collocation: sum_j N_j^(k)(t_i) p_j = value_i (Golovanov 2016, 2.14; Zavyalov et al. 1985, I.8, I.10). The matrix
// has degree + 1 entries in a row; rows are divided by their largest one, so that derivatives of any order weigh alike.
#include "geometry/curves/interpolation/collocation.h"

#include <Eigen/SparseLU>
#include <stdexcept>

#include "geometry/curves/splines/bspline_basis.h"

namespace lekalo::geometry {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

struct System {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d right;
};

// Values are relative to the origin: where the sum of the functions is 1, points move with it, derivatives do not.
void add_row(const SplineAxis& axis, const SplineCondition& condition, const Vec3& origin, int row, System& system) {
  const int p = axis.degree();
  const SplineAxis::Place place = axis.place(condition.t);
  std::vector<double> values(p + 1);
  basis_derivative(p, axis.knots(), place.span, place.t, condition.order, values);
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  const double scale = largest > 0 ? 1 / largest : 1;
  for (int m = 0; m <= p; ++m)
    system.entries.emplace_back(row, (place.span - p + m) % axis.distinct(), scale * values[m]);
  const Vec3 value = scale * (condition.order == 0 ? condition.value - origin : condition.value);
  system.right.row(row) << value.x, value.y, value.z;
}

}  // namespace

SplineAxis clamped_axis(int degree, double lo, double hi, std::span<const double> inner) {
  std::vector<double> knots(degree + 1, lo);
  knots.insert(knots.end(), inner.begin(), inner.end());
  knots.insert(knots.end(), degree + 1, hi);
  return SplineAxis(degree, std::move(knots), Extension::tangent);
}

SplineAxis periodic_axis(int degree, std::span<const double> knots, double period) {
  const int count = static_cast<int>(knots.size());
  std::vector<double> all;
  for (int i = -degree; i <= count + degree; ++i) {
    const int turns = (i + degree * count) / count - degree;
    all.push_back(knots[i - turns * count] + turns * period);
  }
  return SplineAxis(degree, std::move(all), Extension::periodic);
}

NurbsCurve spline_with(SplineAxis axis, std::span<const SplineCondition> conditions) {
  const int count = axis.distinct();
  if (static_cast<int>(conditions.size()) != count)
    throw std::logic_error("a spline needs as many conditions as it has control points");
  const Vec3 origin = conditions.front().order == 0 ? conditions.front().value : Vec3(0);
  System system{{}, Eigen::MatrixX3d(count, 3)};
  for (int row = 0; row < count; ++row) add_row(axis, conditions[row], origin, row, system);
  Matrix matrix(count, count);
  matrix.setFromTriplets(system.entries.begin(), system.entries.end());
  Eigen::SparseLU<Matrix> factors(matrix);
  Eigen::MatrixX3d solution;
  if (factors.info() == Eigen::Success) {
    solution = factors.solve(system.right);
    solution += factors.solve(Eigen::MatrixX3d(system.right - matrix * solution));
  }
  if (factors.info() != Eigen::Success || !solution.allFinite())
    throw FieldError("points", "these conditions do not determine a spline",
                     "another degree, or fewer tangents, leaves one curve alone");
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.push_back(origin + Vec3(solution(i, 0), solution(i, 1), solution(i, 2)));
  return NurbsCurve(std::move(axis), points);
}

}  // namespace lekalo::geometry
