// d_l g_ij = r_il . r_j + r_i . r_jl, d_l g^kn = -g^ka g^nb d_l g_ab, d_l Gamma_ij,k = r_ijl . r_k + r_ij . r_kl: so
// that no metric is differentiated by differences.
#include "geometry/queries/differential/curvilinear.h"

#include <Eigen/LU>

namespace lekalo::geometry {

namespace {

// Volume of the basis, of the product of its lengths.
constexpr double kIndependent = 1e-12;

template <int D, class F>
void each(const F& f) {
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      for (int k = 0; k < D; ++k) f(i, j, k);
}

template <int D>
void add_christoffel(const LocalBasis<D>& b, Connection<D>& c) {
  each<D>([&](int i, int j, int k) { c.first[k][i][j] = glm::dot(b.second[i][j], b.r[k]); });
  for (auto& matrix : c.second) matrix = {};
  each<D>([&](int i, int j, int k) {
    for (int n = 0; n < D; ++n) c.second[k][i][j] += c.inverse[k][n] * c.first[n][i][j];
  });
}

// d_l Gamma^k_ij as [l][k][i][j].
template <int D>
std::array<std::array<Matrix<D>, D>, D> derivatives_of_christoffel(const LocalBasis<D>& b, const Connection<D>& c) {
  std::array<std::array<Matrix<D>, D>, D> result{};
  for (int l = 0; l < D; ++l) {
    Matrix<D> by{};  // d_l g^kn
    each<D>([&](int k, int n, int p) {
      for (int q = 0; q < D; ++q)
        by[k][n] -=
            c.inverse[k][p] * c.inverse[n][q] * (glm::dot(b.second[p][l], b.r[q]) + glm::dot(b.r[p], b.second[q][l]));
    });
    each<D>([&](int k, int i, int j) {
      for (int n = 0; n < D; ++n)
        result[l][k][i][j] +=
            by[k][n] * c.first[n][i][j] +
            c.inverse[k][n] * (glm::dot(b.third[i][j][l], b.r[n]) + glm::dot(b.second[i][j], b.second[n][l]));
    });
  }
  return result;
}

template <int D>
void add_curvature(const LocalBasis<D>& b, Connection<D>& c) {
  const auto by = derivatives_of_christoffel(b, c);
  const auto& gamma = c.second;
  for (int r = 0; r < D; ++r)
    each<D>([&](int j, int i, int n) {
      double sum = by[j][n][i][r] - by[r][n][i][j];
      for (int m = 0; m < D; ++m) sum += gamma[m][i][r] * gamma[n][m][j] - gamma[m][i][j] * gamma[n][m][r];
      c.riemann[r][j][i][n] = sum;
    });
  c.ricci = {};
  each<D>([&](int j, int i, int n) { c.ricci[j][i] += c.riemann[n][j][i][n]; });
  c.scalar = 0;
  for (int j = 0; j < D; ++j)
    for (int i = 0; i < D; ++i) c.scalar += c.inverse[j][i] * c.ricci[j][i];
}

template <int D>
Components<D> product(const Matrix<D>& m, const Components<D>& a) {
  Components<D> result{};
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) result[i] += m[i][j] * a[j];
  return result;
}

}  // namespace

LocalBasis<2> local_basis(const SurfaceJet& jet) {
  LocalBasis<2> b;
  b.point = jet.point();
  // By the number of indices that are v.
  for (int i = 0; i < 2; ++i) {
    b.r[i] = jet.d(1 - i, i);
    for (int j = 0; j < 2; ++j) {
      b.second[i][j] = jet.d(2 - i - j, i + j);
      for (int k = 0; k < 2; ++k) b.third[i][j][k] = jet.d(3 - i - j - k, i + j + k);
    }
  }
  return b;
}

template <int D>
Components<D> Connection<D>::lowered(const Components<D>& a) const {
  return product<D>(metric, a);
}
template <int D>
Components<D> Connection<D>::raised(const Components<D>& a) const {
  return product<D>(inverse, a);
}
template <int D>
Matrix<D> Connection<D>::covariant_derivative(const Components<D>& a, const Matrix<D>& partial) const {
  Matrix<D> result = partial;
  each<D>([&](int i, int j, int n) { result[i][j] += a[n] * second[i][n][j]; });
  return result;
}

template <int D>
Matrix<D> Connection<D>::strain(const Matrix<D>& nabla, bool is_small) const {
  Matrix<D> low{}, result{};  // low[i][j] = nabla_j a_i
  each<D>([&](int i, int j, int n) { low[i][j] += metric[i][n] * nabla[n][j]; });
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      double sum = low[j][i] + low[i][j];
      for (int n = 0; n < D && !is_small; ++n) sum += nabla[n][i] * low[n][j];
      result[i][j] = 0.5 * sum;
    }
  return result;
}

template <int D>
std::optional<Connection<D>> connection(const LocalBasis<D>& basis) {
  Connection<D> c;
  Eigen::Matrix<double, D, D> g;
  double lengths = 1;
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) g(i, j) = c.metric[i][j] = glm::dot(basis.r[i], basis.r[j]);
    lengths *= g(i, i);
  }
  c.determinant = g.determinant();
  if (!(c.determinant > kIndependent * kIndependent * lengths)) return std::nullopt;
  const Eigen::Matrix<double, D, D> inverse = g.inverse();
  for (int i = 0; i < D; ++i) {
    c.reciprocal[i] = Vec3(0);
    for (int j = 0; j < D; ++j) {
      c.inverse[i][j] = inverse(i, j);
      c.reciprocal[i] += inverse(i, j) * basis.r[j];
    }
  }
  add_christoffel(basis, c);
  add_curvature(basis, c);
  return c;
}

template struct Connection<2>;
template struct Connection<3>;
template std::optional<Connection<2>> connection(const LocalBasis<2>&);
template std::optional<Connection<3>> connection(const LocalBasis<3>&);

}  // namespace lekalo::geometry
