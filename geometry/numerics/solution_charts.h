// Charts of the curves of solutions of N - 1 equations in N unknowns, or of M > N - 1 in the sense of least squares:
// one unknown as the parameter, and what a box of derivatives allows the others (geometry/numerics/solution_curves.h
// has the statement).
#pragma once

#include <optional>

#include "geometry/numerics/root_search.h"

namespace lekalo::geometry {

namespace solution_curves {

template <int M>
double determinant(root_search::Matrix<M> a) {
  if constexpr (M == 3)
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
  double result = 1;
  for (int column = 0; column < M; ++column) {
    int pivot = column;
    for (int row = column + 1; row < M; ++row)
      if (std::abs(a[row][column]) > std::abs(a[pivot][column])) pivot = row;
    if (!(std::abs(a[pivot][column]) > 0)) return 0;
    if (pivot != column) std::swap(a[pivot], a[column]), result = -result;
    result *= a[column][column];
    for (int row = column + 1; row < M; ++row) {
      const double factor = a[row][column] / a[column][column];
      for (int k = column; k < M; ++k) a[row][k] -= factor * a[column][k];
    }
  }
  return result;
}

template <int N, int M = N - 1>
using Derivatives = std::array<std::array<double, N>, M>;

// The vector that a symmetric positive matrix shortens most, largest component 1, by inverse iteration; false if the
// matrix has no finite inverse even with a little added.
template <int K>
bool weakest_direction(root_search::Matrix<K> gram, std::array<double, K>& vector) {
  double trace = 0;
  for (int a = 0; a < K; ++a) trace += gram[a][a];
  for (int a = 0; a < K; ++a) gram[a][a] += 1e-14 * trace;
  root_search::Matrix<K> inverse;
  if (!root_search::invert<K>(gram, inverse)) return false;
  for (int time = 0; time < 4; ++time) {
    std::array<double, K> next{};
    double most = 0;
    for (int a = 0; a < K; ++a) {
      for (int b = 0; b < K; ++b) next[a] += inverse[a][b] * vector[b];
      most = std::max(most, std::abs(next[a]));
    }
    if (!(most > 0) || !std::isfinite(most)) return false;
    for (int a = 0; a < K; ++a) vector[a] = next[a] / most;
  }
  return true;
}

// The direction in which all equations stay, of unit length in units of `scale`; zero where the rank is lost. With
// N - 1 equations its sign is that of the minors, so that it does not jump along a curve.
template <int N, int M = N - 1>
ParameterPoint<N> direction_of(const Derivatives<N, M>& j, const std::array<double, N>& scale) {
  if constexpr (M > N - 1) {
    root_search::Matrix<N> gram{};
    for (int a = 0; a < N; ++a)
      for (int b = 0; b < N; ++b)
        for (int k = 0; k < M; ++k) gram[a][b] += j[k][a] * scale[a] * j[k][b] * scale[b];
    ParameterPoint<N> direction;
    for (int i = 0; i < N; ++i) direction[i] = 1 + 0.1 * i;
    if (!weakest_direction<N>(gram, direction)) return {};
    double square = 0;
    for (const double x : direction) square += x * x;
    for (double& x : direction) x /= std::sqrt(square);
    return direction;
  } else {
    ParameterPoint<N> result{};
    double square = 0;
    for (int left_out = 0; left_out < N; ++left_out) {
      root_search::Matrix<N - 1> minor;
      for (int k = 0; k < N - 1; ++k)
        for (int i = 0, to = 0; i < N; ++i)
          if (i != left_out) minor[k][to++] = j[k][i] * scale[i];
      result[left_out] = (left_out % 2 ? -1 : 1) * determinant<N - 1>(minor);
      square += result[left_out] * result[left_out];
    }
    const double length = std::sqrt(square);
    if (!(length > 0) || !std::isfinite(length)) return {};
    for (double& x : result) x /= length;
    return result;
  }
}

// One unknown as the parameter and the (pseudo-)inverse of the derivatives by the others.
template <int N, int M>
struct Chart {
  int along = 0;
  std::array<int, N - 1> others{};
  std::array<std::array<double, M>, N - 1> inverse{};  // [of others][equation]
};

template <int N, int M>
std::optional<Chart<N, M>> chart_of(const Derivatives<N, M>& j, int along) {
  Chart<N, M> chart;
  chart.along = along;
  for (int i = 0, to = 0; i < N; ++i)
    if (i != along) chart.others[to++] = i;
  std::array<std::array<double, N - 1>, M> by_others;
  for (int k = 0; k < M; ++k)
    for (int i = 0; i < N - 1; ++i) by_others[k][i] = j[k][chart.others[i]];
  if (!root_search::solve_for<N - 1, M>(by_others, chart.inverse)) return std::nullopt;
  return chart;
}

template <int N>
int largest(const ParameterPoint<N>& direction) {
  int best = 0;
  for (int i = 1; i < N; ++i)
    if (std::abs(direction[i]) > std::abs(direction[best])) best = i;
  return best;
}

// A chart over a box: what its derivatives allow.
template <int N, int M>
struct ChartBox {
  static constexpr int kOthers = N - 1;
  static constexpr double kRounding = 1e-14;  // more than that of a few sums
  Chart<N, M> chart;
  ParameterBox<N> box;
  std::array<std::array<double, kOthers>, kOthers> error{};  // |I - C F_y(X)|
  std::array<Interval, kOthers> slope;                       // C F_a(X)
  double shrinks = 0;                                        // the largest weighed sum of a row of `error`

  ChartBox(const Chart<N, M>& chart, const ParameterBox<N>& box, const SystemValue<Interval, N, M>& range)
      : chart(chart), box(box) {
    // By middles and radii: |I - C J| <= |I - C m| + |C| r, with the rounding of the sums.
    std::array<std::array<double, kOthers>, M> middles, radii;
    for (int k = 0; k < M; ++k)
      for (int j = 0; j < kOthers; ++j) {
        const Interval& d = range.derivative[k][chart.others[j]];
        middles[k][j] = 0.5 * d.lo + 0.5 * d.hi;
        radii[k][j] = std::max(d.hi - middles[k][j], middles[k][j] - d.lo);
      }
    for (int i = 0; i < kOthers; ++i) {
      double reach = 0;
      for (int j = 0; j < kOthers; ++j) {
        double off = i == j ? 1 : 0, spread = 0, size = off;
        for (int k = 0; k < M; ++k) {
          const double c = chart.inverse[i][k], by = c * middles[k][j];
          off -= by, size += std::abs(by), spread += std::abs(c) * radii[k][j];
        }
        error[i][j] = std::abs(off) + spread + kRounding * (size + spread);
        if (!std::isfinite(error[i][j])) error[i][j] = std::numeric_limits<double>::infinity();
        reach = next_up(reach + next_up(error[i][j] * box[chart.others[j]].width()));
      }
      slope[i] = Interval(0);
      for (int k = 0; k < M; ++k) slope[i] += Interval(chart.inverse[i][k]) * range.derivative[k][chart.along];
      const double side = box[chart.others[i]].width();
      const double part = side > 0 ? reach / side : reach > 0 ? 2.0 : 0.0;
      shrinks = std::isfinite(part) ? std::max(shrinks, part) : 2.0;
    }
  }
  bool is_one_to_one() const { return shrinks < 0.7; }

  // About where the solution near x goes on to.
  ParameterPoint<N> along_slope(ParameterPoint<N> x, double to) const {
    const double by = to - x[chart.along];
    for (int i = 0; i < kOthers; ++i) {
      double& y = x[chart.others[i]];
      y = box[chart.others[i]].clamp(y - slope[i].middle() * by);
    }
    x[chart.along] = to;
    return x;
  }

  // Where solutions in the box with the parameter in `slice` can lie, seen from the place x with the values f.
  ParameterBox<N> reachable(const Interval& slice, const ParameterPoint<N>& x, const std::array<Interval, M>& f,
                            const ParameterBox<N>& within, int times) const {
    ParameterBox<N> y = within;
    y[chart.along] = slice;
    std::array<Interval, kOthers> base;
    for (int i = 0; i < kOthers; ++i) {
      base[i] = Interval(x[chart.others[i]]) - slope[i] * (slice - Interval(x[chart.along]));
      for (int k = 0; k < M; ++k) base[i] -= Interval(chart.inverse[i][k]) * f[k];
    }
    for (int time = 0; time < times; ++time) {
      std::array<double, kOthers> from;
      for (int j = 0; j < kOthers; ++j) {
        const Interval& of = y[chart.others[j]];
        from[j] = std::max(of.hi - x[chart.others[j]], x[chart.others[j]] - of.lo);
      }
      bool shrinks_on = false;
      for (int i = 0; i < kOthers; ++i) {
        double reach = 0;
        for (int j = 0; j < kOthers; ++j) reach += error[i][j] * from[j];
        reach += kRounding * reach;
        Interval& own = y[chart.others[i]];
        const double width = own.width();
        own = intersect(own, base[i] + Interval(-reach, reach));
        if (own.empty()) return y;
        shrinks_on = shrinks_on || own.width() < 0.97 * width;
      }
      if (!shrinks_on) break;
    }
    return y;
  }
};

}  // namespace solution_curves

}  // namespace lekalo::geometry
