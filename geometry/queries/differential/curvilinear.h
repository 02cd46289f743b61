// Local bases of curvilinear coordinates: of space, or of a surface in its two parameters (Golovanov 2016, A.1-A.4).
#pragma once

#include <array>
#include <optional>

#include "geometry/surface.h"

namespace lekalo::geometry {

template <int D>
using Components = std::array<double, D>;
template <int D>
using Matrix = std::array<Components<D>, D>;

// r_i = dr/du^i (not of unit length) and the derivatives of those; all symmetric.
template <int D>
struct LocalBasis {
  Vec3 point{0};
  std::array<Vec3, D> r;
  std::array<std::array<Vec3, D>, D> second;
  std::array<std::array<std::array<Vec3, D>, D>, D> third;
};

// In the parameters of a surface; the jet is of order >= 3.
LocalBasis<2> local_basis(const SurfaceJet& jet);

// What the metric g_ij = r_i . r_j and its derivatives tell.
template <int D>
struct Connection {
  Matrix<D> metric, inverse;  // g_ij, g^ij
  double determinant = 0;
  std::array<Vec3, D> reciprocal;          // r^k, r_i . r^k = delta
  std::array<Matrix<D>, D> first, second;  // [k][i][j]: Gamma_ij,k (A.2.4) and Gamma^k_ij (A.2.5)
  // [r][j][i][n]: R_rji^n = d_j Gamma^n_ir - d_r Gamma^n_ij + Gamma^m_ir Gamma^n_mj - Gamma^m_ij Gamma^n_mr (A.4.6)
  std::array<std::array<Matrix<D>, D>, D> riemann;
  Matrix<D> ricci;    // R_ji = R_nji^n
  double scalar = 0;  // g^ji R_ji; with these signs -2 K on a surface

  Components<D> lowered(const Components<D>& a) const;
  Components<D> raised(const Components<D>& a) const;
  // [i][j]: nabla_j a^i = d_j a^i + a^n Gamma^i_nj, from partial[i][j] = d_j a^i (A.3.1).
  Matrix<D> covariant_derivative(const Components<D>& a, const Matrix<D>& partial) const;
  // Of displacements a^i with nabla[i][j] = nabla_j a^i: (nabla_i a_j + nabla_j a_i + nabla_i a^n nabla_j a_n) / 2
  // (A.4.1), or without the last term.
  Matrix<D> strain(const Matrix<D>& nabla, bool is_small) const;
};

// None where the r_i are not independent.
template <int D>
std::optional<Connection<D>> connection(const LocalBasis<D>& basis);

}  // namespace lekalo::geometry
