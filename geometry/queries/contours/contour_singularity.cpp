#include "geometry/queries/contours/contour_singularity.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace lekalo::geometry {

namespace {

// Matrices of any size: those of fixed sizes take a minute to compile.
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxSteps = 15;

// d^2 F (v, w) at x, by polarisation.
template <int N>
VectorXd second_derivative(const ContourEquations<N>& equations, const ParameterPoint<N>& x, const ParameterPoint<N>& v,
                           const ParameterPoint<N>& w) {
  const ParameterBox<N> domain = equations.domain();
  VectorXd result = VectorXd::Zero(N - 1);
  for (const double sign : {1.0, -1.0}) {
    std::array<Jet<double, kMaxContourOrder>, N> way;
    for (int i = 0; i < N; ++i) way[i].c[0] = domain[i].clamp(x[i]), way[i].c[1] = v[i] + sign * w[i];
    const auto series = equations.series(way);
    for (int k = 0; k < N - 1; ++k) result[k] += 0.25 * sign * 2 * series.equations[k].c[2];
  }
  return result;
}

// The foot point of one surface's point on the other, whose parameters are x[first] and the next.
void move_below(const ContourEquations<4>& equations, int first, ParameterPoint<4>& x) {
  const ParameterBox<4> domain = equations.domain();
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto there = equations.evaluate(x);
    MatrixXd j(3, 2);
    VectorXd f(3);
    for (int k = 0; k < 3; ++k) {
      f[k] = there.value[k];
      for (int i = 0; i < 2; ++i) j(k, i) = there.derivative[k][first + i] * domain[first + i].width();
    }
    if (!j.allFinite()) return;
    const VectorXd by = j.jacobiSvd(Eigen::ComputeThinU | Eigen::ComputeThinV).solve(-f);
    if (!by.allFinite()) return;
    for (int i = 0; i < 2; ++i)
      x[first + i] = domain[first + i].clamp(x[first + i] + by[i] * domain[first + i].width());
    if (by.lpNorm<Eigen::Infinity>() < 1e-15) return;
  }
}

}  // namespace

template <int N>
ParameterPoint<N> singular_solution(const ContourEquations<N>& equations, const ParameterBox<N>& box, double near) {
  constexpr int M = N - 1;
  const ParameterBox<N> domain = equations.domain();
  ParameterPoint<N> scale, start;
  for (int i = 0; i < N; ++i) scale[i] = domain[i].width(), start[i] = box[i].middle();
  ParameterPoint<N> x = start;
  bool converged = false;
  for (int step = 0; step < kMaxSteps && !converged; ++step) {
    const auto there = equations.evaluate(x);
    MatrixXd j(M, N), a(N + 1, N);
    for (int k = 0; k < M; ++k)
      for (int i = 0; i < N; ++i) j(k, i) = there.derivative[k][i] * scale[i];
    if (!j.allFinite()) break;  // the decomposition has no vectors
    const Eigen::JacobiSVD<MatrixXd> svd(j, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const VectorXd left = svd.matrixU().col(M - 1);
    VectorXd f(N + 1);
    for (int k = 0; k < M; ++k) f[k] = there.value[k];
    a.topRows(M) = j;
    for (int c = 0; c < 2; ++c) {
      const VectorXd v = svd.matrixV().col(N - 2 + c);
      f[M + c] = left.dot(j * v);
      ParameterPoint<N> way;
      for (int i = 0; i < N; ++i) way[i] = v[i] * scale[i];
      for (int i = 0; i < N; ++i) {
        ParameterPoint<N> unit{};
        unit[i] = scale[i];
        a(M + c, i) = left.dot(second_derivative<N>(equations, x, way, unit));
      }
    }
    if (!a.allFinite()) break;
    const Eigen::JacobiSVD<MatrixXd> least(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const VectorXd by = least.solve(-f);
    double most = 0;
    for (int i = 0; i < N; ++i) {
      x[i] += by[i] * scale[i];
      most = std::max(most, std::abs(by[i]));
    }
    if (!std::isfinite(most)) break;
    converged = most < 1e-13;
  }
  bool stays = true;
  for (int i = 0; i < N; ++i) {
    const double reach = 2 * box[i].width() + 1e-5 * scale[i];
    stays = stays && std::abs(x[i] - start[i]) <= reach;
    x[i] = domain[i].clamp(x[i]);
  }
  if (!stays) x = start;
  // At a pole the equations say little.
  for (int i = 0; i < N; ++i)
    for (const bool upper : {false, true}) {
      if (!equations.is_pole(i, upper)) continue;
      ParameterPoint<N> at = x;
      at[i] = upper ? domain[i].hi : domain[i].lo;
      if constexpr (N == 4) move_below(equations, i < 2 ? 2 : 0, at);
      if (glm::length(equations.point(at) - equations.point(x)) <= near &&
          equations.distance(at) <= equations.distance(x) + near)
        x = at;
    }
  return x;
}
template ParameterPoint<2> singular_solution<2>(const ContourEquations<2>&, const ParameterBox<2>&, double);
template ParameterPoint<4> singular_solution<4>(const ContourEquations<4>&, const ParameterBox<4>&, double);

}  // namespace lekalo::geometry
