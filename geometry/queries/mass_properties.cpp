// Mass properties by surface integrals (Golovanov 2016, 8.9): by the divergence theorem, with m dS = (s_u x s_v) du dv,
//
//   V = 1/3 int r.m dS,   V c_x = 1/4 int x r.m dS,   int x y dV = 1/5 int x y r.m dS.
//
// The origin is first moved to the middle of the body, so that r.m does not cancel.
#include "geometry/queries/mass_properties.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include "geometry/queries/face_integral.h"

namespace lekalo::geometry {

namespace {

// area, its three moments, volume, its three moments, xx yy zz xy yz zx
constexpr int kAreaIntegrals = 4;
constexpr int kAllIntegrals = 14;

void area_integrands(const SurfaceJet& jet, const Vec3& origin, std::span<double> values) {
  const double element = glm::length(glm::cross(jet.du(), jet.dv()));
  const Vec3 r = jet.point() - origin;
  values[0] = element;
  for (int k = 0; k < 3; ++k) values[1 + k] = element * r[k];
}

void mass_integrands(const SurfaceJet& jet, const Vec3& origin, std::span<double> values) {
  area_integrands(jet, origin, values);
  const Vec3 r = jet.point() - origin;
  const double flux = glm::dot(r, glm::cross(jet.du(), jet.dv()));
  values[4] = flux / 3;
  for (int k = 0; k < 3; ++k) values[5 + k] = flux * r[k] / 4;
  for (int k = 0; k < 3; ++k) values[8 + k] = flux * r[k] * r[k] / 5;
  values[11] = flux * r.x * r.y / 5;
  values[12] = flux * r.y * r.z / 5;
  values[13] = flux * r.z * r.x / 5;
}

SurfaceMeasures area_of(const Integral& integral, const Vec3& origin) {
  SurfaceMeasures result;
  result.area = {integral.value[0], integral.error[0]};
  result.centroid = origin + Vec3(integral.value[1], integral.value[2], integral.value[3]) / integral.value[0];
  return result;
}

// From the integrals about `origin` to the properties about the centroid.
MassProperties properties_of(const std::array<double, kAllIntegrals>& value,
                             const std::array<double, kAllIntegrals>& error, const Vec3& origin, double size) {
  MassProperties result;
  result.area = {value[0], error[0]};
  result.volume = {value[4], error[4]};
  const double volume = value[4];
  if (volume == 0) return result;
  const Vec3 c = Vec3(value[5], value[6], value[7]) / volume;
  result.centroid = origin + c;
  result.centroid_error =
      (glm::length(Vec3(error[5], error[6], error[7])) + glm::length(c) * error[4]) / std::abs(volume);
  const double xx = value[8] - volume * c.x * c.x, yy = value[9] - volume * c.y * c.y,
               zz = value[10] - volume * c.z * c.z;
  const double xy = value[11] - volume * c.x * c.y, yz = value[12] - volume * c.y * c.z,
               zx = value[13] - volume * c.z * c.x;
  result.inertia = Mat3(Vec3(yy + zz, -xy, -zx), Vec3(-xy, zz + xx, -yz), Vec3(-zx, -yz, xx + yy));
  double worst = 0;
  for (int k = 8; k < kAllIntegrals; ++k) worst = std::max(worst, error[k]);
  result.inertia_error = 2 * worst + std::abs(volume) * result.centroid_error * size;
  principal_moments(result.inertia, result.principal_moments, result.principal_axes);
  return result;
}

std::vector<double> smooth_breaks(const Curve& curve, const Interval& range) {
  std::vector<double> breaks{range.lo};
  for (const CurvePiece& piece : curve.pieces())
    if (piece.domain.lo > breaks.back() && piece.domain.lo < range.hi) breaks.push_back(piece.domain.lo);
  breaks.push_back(range.hi);
  return breaks;
}

void require_bounded(const Interval& range) {
  if (!(range.lo > -kInfinity && range.hi < kInfinity))
    throw std::invalid_argument("an unbounded curve has no length; give it a range");
}

bool has_free_borders(const Body& body) {
  for (const Edge& edge : body.edges)
    if (edge.kind != EdgeKind::pole && edge.coedges.size() != 2) return true;
  return false;
}

}  // namespace

CurveMeasures measure(const Curve& curve) {
  require_bounded(curve.domain());
  const Vec3 origin = curve.point(curve.domain().middle());
  const auto integrand = [&](double t, std::span<double> values) {
    const CurveJet jet = curve.evaluate(t, 1);
    const double speed = glm::length(jet.d[1]);
    values[0] = speed;
    for (int k = 0; k < 3; ++k) values[1 + k] = speed * (jet.d[0][k] - origin[k]);
  };
  const Integral integral =
      integrate(integrand, 4, smooth_breaks(curve, curve.domain()), {0, kMeasureAccuracy, 1000000});
  CurveMeasures result;
  result.length = {integral.value[0], integral.error[0]};
  result.centroid = origin + Vec3(integral.value[1], integral.value[2], integral.value[3]) / integral.value[0];
  return result;
}

Measure arc_length(const Curve& curve, double a, double b) {
  require_bounded({std::min(a, b), std::max(a, b)});
  if (a == b) return {};
  const Interval range{std::min(a, b), std::max(a, b)};
  const Integral integral = integrate(
      [&](double t, std::span<double> values) { values[0] = glm::length(curve.evaluate(t, 1).d[1]); }, 1,
      smooth_breaks(curve, range), {0, kMeasureAccuracy, 1000000});
  return {a < b ? integral.value[0] : -integral.value[0], integral.error[0]};
}

SurfaceMeasures measure(const Surface& surface) {
  if (!surface.bounded()) throw std::invalid_argument("an unbounded surface has no area; give it a domain");
  const Rectangle domain = surface.domain();
  const Vec3 origin = surface.point(domain.u.middle(), domain.v.middle());
  return area_of(integrate_over(
                     surface, domain,
                     [&](const SurfaceJet& jet, std::span<double> values) { area_integrands(jet, origin, values); },
                     kAreaIntegrals, {0, kMeasureAccuracy, 4000000}),
                 origin);
}

SurfaceMeasures measure_face(const Body& body, int face) {
  const Vec3 origin = bounds(body).center();
  return area_of(integrate_over(
                     body, face,
                     [&](const SurfaceJet& jet, std::span<double> values) { area_integrands(jet, origin, values); },
                     kAreaIntegrals, {0, kMeasureAccuracy, 4000000}),
                 origin);
}

MassProperties measure(const Body& body, double accuracy) {
  const Box3 box = bounds(body);
  const Vec3 origin = box.center();
  std::array<double, kAllIntegrals> value{}, error{};
  for (size_t face = 0; face < body.faces.size(); ++face) {
    const Integral integral = integrate_over(
        body, static_cast<int>(face),
        [&](const SurfaceJet& jet, std::span<double> values) { mass_integrands(jet, origin, values); }, kAllIntegrals,
        {0, accuracy, 4000000});
    const double outward = body.faces[face].forward == (body.faces[face].surface->normal_sign() > 0) ? 1 : -1;
    for (int k = 0; k < kAllIntegrals; ++k) {
      value[k] += k < kAreaIntegrals ? integral.value[k] : outward * integral.value[k];
      error[k] += integral.error[k];
    }
  }
  MassProperties result = properties_of(value, error, origin, box.diameter());
  result.closed = !has_free_borders(body);
  return result;
}

double signed_volume(const Body& body, int shell, double accuracy) {
  const Vec3 origin = bounds(body).center();
  double volume = 0;
  for (int face : body.shells[shell].faces) {
    const Integral integral = integrate_over(
        body, face,
        [&](const SurfaceJet& jet, std::span<double> values) {
          values[0] = glm::dot(jet.point() - origin, glm::cross(jet.du(), jet.dv())) / 3;
        },
        1, {0, accuracy, 200000});
    const double outward = body.faces[face].forward == (body.faces[face].surface->normal_sign() > 0) ? 1 : -1;
    volume += outward * integral.value[0];
  }
  return volume;
}

// A tetrahedron from the origin to a triangle a b c: with d = det(a, b, c),
//   V = d/6,   V c = d/24 s,   int r r^T = d/120 (s s^T + a a^T + b b^T + c c^T),   s = a + b + c    (Mirtich 1996)
MassProperties measure(const Mesh& mesh) {
  const Box3 box = bounds(mesh);
  if (box.empty()) return {};
  const Vec3 origin = box.center();
  std::array<double, kAllIntegrals> value{}, size{};
  const auto add = [&](int k, double term) {
    value[k] += term;
    size[k] += std::abs(term);
  };
  for (const Mesh::Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.points[t.point[0]] - origin, b = mesh.points[t.point[1]] - origin,
               c = mesh.points[t.point[2]] - origin, s = a + b + c;
    const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
    const double d = glm::dot(a, glm::cross(b, c));
    add(0, area);
    add(4, d / 6);
    const auto product = [&](int i, int j) { return s[i] * s[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]; };
    for (int k = 0; k < 3; ++k) {
      add(1 + k, area * s[k] / 3);
      add(5 + k, d * s[k] / 24);
      add(8 + k, d * product(k, k) / 120);
      add(11 + k, d * product(k, (k + 1) % 3) / 120);
    }
  }
  constexpr double kRoundings = 16;
  for (double& each : size) each *= kRoundings * std::numeric_limits<double>::epsilon();
  MassProperties result = properties_of(value, size, origin, box.diameter());
  result.closed = is_closed(mesh);
  return result;
}

Mat3 inertia_about(const MassProperties& properties, const Vec3& point) {
  const Vec3 d = properties.centroid - point;
  return properties.inertia + properties.volume.value * (glm::dot(d, d) * Mat3(1.0) - glm::outerProduct(d, d));
}

void principal_moments(const Mat3& inertia, Vec3& moments, Mat3& axes) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) matrix(i, j) = 0.5 * (inertia[i][j] + inertia[j][i]);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  for (int k = 0; k < 3; ++k) {
    moments[k] = solver.eigenvalues()[k];
    for (int i = 0; i < 3; ++i) axes[k][i] = solver.eigenvectors()(i, k);
  }
  if (glm::determinant(axes) < 0) axes[2] = -axes[2];
}

}  // namespace lekalo::geometry
