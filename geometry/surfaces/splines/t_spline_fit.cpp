// Least squares for the points of a T-spline (declared in t_spline.h).
#include <fmt/format.h>

#include <Eigen/SparseQR>
#include <algorithm>
#include <iterator>

#include "geometry/curves/splines/bspline_basis.h"
#include "geometry/describe.h"
#include "geometry/numerics/quadrature.h"
#include "geometry/surfaces/splines/t_spline.h"

namespace lekalo::geometry {

std::vector<Vec3> fitted_points(const std::vector<LocalKnots>& functions, const std::vector<double>& weights,
                                const Rectangle& domain, const Surface& of, const Periods& periods) {
  const Rectangle all = of.domain();
  if (!(all.u.contains(domain.u.lo) && all.u.contains(domain.u.hi) && all.v.contains(domain.v.lo) &&
        all.v.contains(domain.v.hi)))
    throw FieldError(
        "of",
        fmt::format("the surface goes over u {:.6g}..{:.6g}, v {:.6g}..{:.6g}, the T-spline over u "
                    "{:.6g}..{:.6g}, v {:.6g}..{:.6g}",
                    all.u.lo, all.u.hi, all.v.lo, all.v.hi, domain.u.lo, domain.u.hi, domain.v.lo, domain.v.hi),
        "draw the mesh over the surface's own parameters");
  const int degree = static_cast<int>(functions.front().u.size()) - 2, count = static_cast<int>(functions.size());
  const RepeatedFunctions everywhere = repeated(functions, domain, periods);
  const std::vector<LocalKnots>& all_functions = everywhere.functions;
  // Twice as many places as a spline on all knots has points, two in each span at least.
  const auto places = [&](bool along_u, const Interval& range) {
    const std::vector<double> knots = all_knots(all_functions, along_u, range);
    std::vector<double> ends;
    std::unique_copy(knots.begin(), knots.end(), std::back_inserter(ends));
    const int spans = static_cast<int>(ends.size()) - 1, of_all = static_cast<int>(knots.size()) - degree - 1;
    const auto rule = gauss_legendre(std::clamp((2 * of_all + spans - 1) / spans, 2, degree + 1));
    std::vector<double> at;
    for (int k = 0; k < spans; ++k)
      for (const double node : rule.nodes) at.push_back(0.5 * (ends[k] + ends[k + 1] + node * (ends[k + 1] - ends[k])));
    return at;
  };
  const std::vector<double> at_u = places(true, domain.u), at_v = places(false, domain.v);
  // Values of one function at the places, between the first and last that it reaches.
  const auto values = [&](const std::vector<double>& knots, const std::vector<double>& at) {
    std::vector<double> padded(degree, knots.front());
    padded.insert(padded.end(), knots.begin(), knots.end());
    padded.insert(padded.end(), degree, knots.back());
    std::vector<std::pair<int, double>> result;
    std::vector<double> basis(degree + 1);
    for (size_t k = 0; k < at.size(); ++k) {
      if (!(at[k] > knots.front() && at[k] < knots.back())) continue;
      const int span = static_cast<int>(std::upper_bound(padded.begin(), padded.end(), at[k]) - padded.begin()) - 1;
      basis_derivative(degree, padded, span, at[k], 0, basis);
      result.emplace_back(static_cast<int>(k), basis[degree - (span - degree)]);
    }
    return result;
  };
  const size_t columns = at_v.size(), height = at_u.size() * columns;
  std::vector<double> sums(height, 0.0);
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<int> fitted;  // functions that are not zero all over the domain
  std::vector<int> columns_of(count, -1);
  for (size_t r = 0; r < all_functions.size(); ++r) {
    const int i = everywhere.of[r];
    const auto a = values(all_functions[r].u, at_u), b = values(all_functions[r].v, at_v);
    if (a.empty() || b.empty()) continue;
    int& column = columns_of[i];
    if (column < 0) {
      column = static_cast<int>(fitted.size());
      fitted.push_back(i);
    }
    for (const auto& [k, x] : a)
      for (const auto& [l, y] : b) {
        const size_t row = k * columns + l;
        const double value = x * y * (weights.empty() ? 1 : weights[i]);
        entries.emplace_back(static_cast<int>(row), column, value);
        sums[row] += value;
      }
  }
  for (auto& entry : entries) entry = {entry.row(), entry.col(), entry.value() / sums[entry.row()]};
  Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(height), static_cast<Eigen::Index>(fitted.size()));
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::MatrixX3d right(height, 3);
  for (size_t k = 0; k < at_u.size(); ++k)
    for (size_t l = 0; l < columns; ++l) {
      const Vec3 p = of.point(at_u[k], at_v[l]);
      right.row(static_cast<Eigen::Index>(k * columns + l)) << p.x, p.y, p.z;
    }
  const Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> factors(matrix);
  if (factors.rank() < matrix.cols())
    throw FieldError("lines", fmt::format("{} functions of the mesh depend on others", matrix.cols() - factors.rank()),
                     "lines that end opposite to one another, or cross in their continuations, do this");
  const Eigen::MatrixX3d solution = factors.solve(right);
  // The others are free: points of the surface.
  std::vector<Vec3> points;
  for (const LocalKnots& function : functions)
    points.push_back(
        of.point(domain.u.clamp(function.u[function.u.size() / 2]), domain.v.clamp(function.v[function.v.size() / 2])));
  for (size_t k = 0; k < fitted.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    points[fitted[k]] = {solution(row, 0), solution(row, 1), solution(row, 2)};
  }
  return points;
}

}  // namespace lekalo::geometry
