// Local basis, metric, connection and fields of curvilinear coordinates at a place (Golovanov 2016, A.1-A.4).
#include <cmath>

#include "command.h"
#include "evaluate.h"
#include "geometry/numerics/jet3.h"
#include "geometry/queries/differential/curvilinear.h"

namespace lekalo::command {

namespace {

using geometry::Components;
using geometry::Connection;
using geometry::CurvilinearSystem;
using geometry::Expression;
using geometry::Matrix;
using geometry::Vec3;
using Space = geometry::Jet3<double, 3>;
using Path = geometry::Jet<double, 2>;

// d^n f by the axes named.
double derivative(const Space& f, std::initializer_list<int> axes) {
  int count[3] = {0, 0, 0};
  double factor = 1;
  for (const int axis : axes) factor *= ++count[axis];
  return factor * f.c[Space::index(count[0], count[1], count[2])];
}

std::vector<Space> fields_at(const std::vector<Expression>& formulas, const Components<3>& at) {
  std::vector<Space> result;
  for (const Expression& one : formulas)
    result.push_back(one(Space::variable(at[0], 0), Space::variable(at[1], 1), Space::variable(at[2], 2)));
  return result;
}

geometry::LocalBasis<3> basis_at(const CurvilinearSystem& system, const geometry::Affine& map,
                                 const Components<3>& at) {
  const std::vector<Space> x = fields_at(system.point, at);
  const auto vector = [&](std::initializer_list<int> axes) {
    return map.direction(Vec3(derivative(x[0], axes), derivative(x[1], axes), derivative(x[2], axes)));
  };
  geometry::LocalBasis<3> b;
  b.point = map.point({x[0].c[0], x[1].c[0], x[2].c[0]});
  for (int i = 0; i < 3; ++i) {
    b.r[i] = vector({i});
    for (int j = 0; j < 3; ++j) {
      b.second[i][j] = vector({i, j});
      for (int k = 0; k < 3; ++k) b.third[i][j][k] = vector({i, j, k});
    }
  }
  return b;
}

template <class T, size_t N>
ordered_json list(const std::array<T, N>& values) {
  ordered_json out = ordered_json::array();
  for (const auto& value : values) {
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Vec3>)
      out.push_back(finite_or_null(value));
    else
      out.push_back(list(value));
  }
  return out;
}

Components<3> values_of(const std::vector<Space>& a) { return {a[0].c[0], a[1].c[0], a[2].c[0]}; }

Vec3 sum(const Components<3>& a, const std::array<Vec3, 3>& basis) {
  return a[0] * basis[0] + a[1] * basis[1] + a[2] * basis[2];
}

double trace(const Matrix<3>& m) { return m[0][0] + m[1][1] + m[2][2]; }

// Contravariant components of e^ijk p_i q_j / sqrt(g), from antisymmetric differences of m = p q.
Components<3> axial(const Matrix<3>& m, double volume) {
  return {(m[1][2] - m[2][1]) / volume, (m[2][0] - m[0][2]) / volume, (m[0][1] - m[1][0]) / volume};
}

// `volume`: the signed one of the basis.
struct Place {
  Components<3> at;
  geometry::LocalBasis<3> basis;
  Connection<3> c;
  double volume;
};

void put_scalar(ordered_json& out, const Expression& scalar, const Place& place) {
  const Space f = fields_at({scalar}, place.at)[0];
  Components<3> gradient;
  double laplacian = 0;
  for (int i = 0; i < 3; ++i) gradient[i] = derivative(f, {i});
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double second = derivative(f, {i, j});
      for (int k = 0; k < 3; ++k) second -= place.c.second[k][i][j] * gradient[k];
      laplacian += place.c.inverse[i][j] * second;
    }
  out["scalar"] = finite_or_null(f.c[0]);
  out["gradient_components"] = list(gradient);
  out["gradient"] = finite_or_null(sum(gradient, place.c.reciprocal));
  out["laplacian"] = finite_or_null(laplacian);
}

void put_vector(ordered_json& out, const CurvilinearSystem& system, const Place& place) {
  const std::vector<Space> field = fields_at(system.vector, place.at);
  const Components<3> a = values_of(field), low = place.c.lowered(a);
  Matrix<3> partial;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) partial[i][j] = derivative(field[i], {j});
  const Matrix<3> nabla = place.c.covariant_derivative(a, partial);
  Matrix<3> lowered{};  // [i][j]: nabla_i a_j
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int n = 0; n < 3; ++n) lowered[i][j] += place.c.metric[j][n] * nabla[n][i];
  const Components<3> curl = axial(lowered, place.volume);
  out["vector"] = finite_or_null(sum(a, place.basis.r));
  out["vector_components"] = list(a);
  out["vector_covariant"] = list(low);
  out["covariant_derivative"] = list(nabla);
  out["divergence"] = finite_or_null(trace(nabla));
  out["curl_components"] = list(curl);
  out["curl"] = finite_or_null(sum(curl, place.basis.r));
  out["strain"] = list(place.c.strain(nabla, false));
  out["small_strain"] = list(place.c.strain(nabla, true));
  if (system.second_vector.empty()) return;
  const Components<3> b = values_of(fields_at(system.second_vector, place.at)), low_b = place.c.lowered(b);
  double dot = 0;
  Matrix<3> both;
  for (int i = 0; i < 3; ++i) {
    dot += a[i] * low_b[i];
    for (int j = 0; j < 3; ++j) both[i][j] = low[i] * low_b[j];
  }
  const Components<3> cross = axial(both, place.volume);
  out["dot"] = finite_or_null(dot);
  out["cross_components"] = list(cross);
  out["cross"] = finite_or_null(sum(cross, place.basis.r));
}

// [k][i][j]: nabla_j t^ki (A.3.4).
void put_tensor(ordered_json& out, const std::vector<Expression>& tensor, const Place& place) {
  const std::vector<Space> t = fields_at(tensor, place.at);
  const auto& gamma = place.c.second;
  std::array<Matrix<3>, 3> nabla;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        double value = derivative(t[3 * k + i], {j});
        for (int n = 0; n < 3; ++n) value += t[3 * n + i].c[0] * gamma[k][n][j] + t[3 * k + n].c[0] * gamma[i][n][j];
        nabla[k][i][j] = value;
      }
  out["tensor_derivative"] = list(nabla);
}

// A^k'_i = du^k'/du^i; r_k' = A^i_k' r_i, g_k'n' = A^i_k' A^j_n' g_ij (A.1.6).
void put_change(ordered_json& out, const CurvilinearSystem& system, const Place& place) {
  const std::vector<Space> other = fields_at(system.change, place.at);
  geometry::Mat3 forth(0);
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) forth[i][k] = derivative(other[k], {i});
  const double determinant = glm::determinant(forth);
  if (!(std::abs(determinant) > 0)) throw UsageError("'change' is singular at this place");
  const geometry::Mat3 back = glm::inverse(forth);
  std::array<Vec3, 3> basis;
  Matrix<3> metric;
  for (int k = 0; k < 3; ++k) basis[k] = sum({back[k][0], back[k][1], back[k][2]}, place.basis.r);
  for (int k = 0; k < 3; ++k)
    for (int n = 0; n < 3; ++n) metric[k][n] = glm::dot(basis[k], basis[n]);
  out["other_coordinates"] = list(values_of(other));
  out["other_derivatives"] = to_json(forth);
  out["other_basis"] = list(basis);
  out["other_metric"] = list(metric);
  if (system.vector.empty()) return;
  const Components<3> a = values_of(fields_at(system.vector, place.at));
  const Vec3 there = forth * Vec3(a[0], a[1], a[2]);
  out["other_components"] = finite_or_null(there);
}

Place place_at(const CurvilinearSystem& system, const geometry::Affine& map, const Components<3>& at) {
  const geometry::LocalBasis<3> basis = basis_at(system, map, at);
  const auto c = geometry::connection(basis);
  if (!c) throw UsageError("the coordinates are singular there: their local basis has no volume");
  return {at, basis, *c, glm::dot(basis.r[0], glm::cross(basis.r[1], basis.r[2]))};
}

void put_place(ordered_json& out, const Place& place) {
  out["coordinates"] = list(place.at);
  out["point"] = finite_or_null(place.basis.point);
  out["basis"] = list(place.basis.r);
  out["jacobian"] = finite_or_null(place.volume);
  out["reciprocal_basis"] = list(place.c.reciprocal);
  out["basis_derivatives"] = list(place.basis.second);
  put_connection(out, place.c);
}

}  // namespace

template <int D>
void put_connection(ordered_json& out, const Connection<D>& c) {
  out["metric"] = list(c.metric);
  out["inverse_metric"] = list(c.inverse);
  out["volume_element"] = finite_or_null(std::sqrt(c.determinant));
  out["christoffel_first"] = list(c.first);
  out["christoffel"] = list(c.second);
  out["riemann"] = list(c.riemann);
  out["ricci"] = list(c.ricci);
  out["scalar_curvature"] = finite_or_null(c.scalar);
}
template void put_connection(ordered_json&, const Connection<2>&);
template void put_connection(ordered_json&, const Connection<3>&);

ordered_json evaluate_system(const CurvilinearSystem& system, const geometry::Affine& map,
                             const std::vector<double>& at) {
  const Place place = place_at(system, map, {at[0], at[1], at[2]});
  ordered_json out;
  put_place(out, place);
  if (system.scalar) put_scalar(out, *system.scalar, place);
  if (!system.vector.empty()) put_vector(out, system, place);
  if (!system.tensor.empty()) put_tensor(out, system.tensor, place);
  if (!system.change.empty()) put_change(out, system, place);
  return out;
}

// D a/dt = (da^i/dt + a^n Gamma^i_nj du^j/dt) r_i (A.2.6), and with a = du/dt the second derivative of the curve.
ordered_json evaluate_path(const CurvilinearSystem& system, const geometry::Affine& map, double t) {
  if (system.path.empty())
    throw UsageError("--at takes U,V,W of the coordinates, or U,V of the surface: there is no 'path'");
  Path variable(t);
  variable.c[1] = 1;
  std::array<Path, 3> u, a;
  for (size_t k = 0; k < 3; ++k) u[k] = system.path[k](variable);
  const Place place = place_at(system, map, {u[0].c[0], u[1].c[0], u[2].c[0]});
  const auto along = [&](const Components<3>& value, const Components<3>& rate) {
    Components<3> result = rate;
    for (int i = 0; i < 3; ++i)
      for (int n = 0; n < 3; ++n)
        for (int j = 0; j < 3; ++j) result[i] += value[n] * place.c.second[i][n][j] * u[j].c[1];
    return result;
  };
  const Components<3> speed{u[0].c[1], u[1].c[1], u[2].c[1]};
  const Components<3> second = along(speed, {2 * u[0].c[2], 2 * u[1].c[2], 2 * u[2].c[2]});
  ordered_json out;
  out["t"] = t;
  put_place(out, place);
  out["first_derivative_components"] = list(speed);
  out["first_derivative"] = finite_or_null(sum(speed, place.basis.r));
  out["second_derivative_components"] = list(second);
  out["second_derivative"] = finite_or_null(sum(second, place.basis.r));
  if (system.carried.empty()) return out;
  for (size_t k = 0; k < 3; ++k) a[k] = system.carried[k](variable);
  const Components<3> value{a[0].c[0], a[1].c[0], a[2].c[0]};
  const Components<3> rate = along(value, {a[0].c[1], a[1].c[1], a[2].c[1]});
  out["carried"] = finite_or_null(sum(value, place.basis.r));
  out["carried_derivative_components"] = list(rate);
  out["carried_derivative"] = finite_or_null(sum(rate, place.basis.r));
  return out;
}

}  // namespace lekalo::command
