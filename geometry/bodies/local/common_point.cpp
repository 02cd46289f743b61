#include "geometry/bodies/local/common_point.h"

#include <Eigen/Dense>
#include <cmath>

namespace lekalo::geometry {

namespace {

constexpr int kSteps = 60;
// Of the size: what is left of a gap where Newton's method has converged.
constexpr double kMet = 1e-12;

std::optional<Vec3> common_point_of_planes(const std::array<SurfaceNear, 3>& of, double size) {
  std::array<Vec3, 3> n;
  for (int k = 0; k < 3; ++k) n[k] = of[k].plane->z;
  const double volume = glm::dot(n[0], glm::cross(n[1], n[2]));
  if (!(std::abs(volume) > 1e-9)) return std::nullopt;
  // About a point near by, for the sake of rounding.
  const Vec3 o = of[0].surface->point(of[0].near.x, of[0].near.y);
  Vec3 sum(0);
  for (int k = 0; k < 3; ++k)
    sum += glm::dot(of[k].plane->origin - o, n[k]) * glm::cross(n[(k + 1) % 3], n[(k + 2) % 3]);
  const Vec3 p = o + sum / volume;
  return glm::length(p - o) < 1e6 * size ? std::optional(p) : std::nullopt;
}

// Solves r_0 = r_k for all the others by least squares, minimal steps: Newton's method for three surfaces, the nearest
// point of the curve of intersection for two.
template <size_t N>
std::optional<Vec3> solved(const std::array<SurfaceNear, N>& of, double size) {
  std::array<Vec2, N> at;
  for (size_t k = 0; k < N; ++k) at[k] = of[k].near;
  double last = kInfinity;
  for (int step = 0; step < kSteps; ++step) {
    std::array<SurfaceJet, N> s;
    for (size_t k = 0; k < N; ++k) s[k] = of[k].surface->evaluate(at[k].x, at[k].y, 1);
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3 * (N - 1), 2 * N);
    Eigen::VectorXd gap(3 * (N - 1));
    // Columns in units of length, so that steps of least length are that in space.
    std::array<Vec2, N> scale;
    for (size_t k = 0; k < N; ++k) {
      scale[k] = {glm::length(s[k].du()), glm::length(s[k].dv())};
      if (!(scale[k].x > 0 && scale[k].y > 0)) return std::nullopt;
    }
    for (size_t k = 1; k < N; ++k)
      for (int i = 0; i < 3; ++i) {
        const auto row = static_cast<Eigen::Index>(3 * (k - 1)) + i;
        gap[row] = s[k].point()[i] - s[0].point()[i];
        a(row, 0) = s[0].du()[i] / scale[0].x, a(row, 1) = s[0].dv()[i] / scale[0].y;
        a(row, static_cast<Eigen::Index>(2 * k)) = -s[k].du()[i] / scale[k].x;
        a(row, static_cast<Eigen::Index>(2 * k) + 1) = -s[k].dv()[i] / scale[k].y;
      }
    const double left = gap.norm();
    // Rounding alone moves it now.
    if (left <= kMet * size && left >= 0.5 * last) return s[0].point();
    if (left == 0) return s[0].point();
    last = left;
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> system;
    system.setThreshold(1e-10);
    system.compute(a);
    if (system.rank() < a.rows()) return std::nullopt;
    const Eigen::VectorXd by = system.solve(gap);
    if (!(by.norm() < 1e3 * size)) return std::nullopt;
    for (size_t k = 0; k < N; ++k)
      at[k] += Vec2(by[static_cast<Eigen::Index>(2 * k)] / scale[k].x,
                    by[static_cast<Eigen::Index>(2 * k) + 1] / scale[k].y);
  }
  return std::nullopt;
}

}  // namespace

std::optional<Vec3> common_point(const std::array<SurfaceNear, 3>& of, double size) {
  if (of[0].plane && of[1].plane && of[2].plane) return common_point_of_planes(of, size);
  return solved(of, size);
}

std::optional<Vec3> nearest_common_point(const SurfaceNear& a, const SurfaceNear& b, double size) {
  return solved(std::array{a, b}, size);
}

std::optional<Vec3> piercing_point(const Surface& surface, const Curve& image, double t, const SurfaceNear& other,
                                   double size) {
  Vec2 at = other.near;
  for (int step = 0; step < kSteps; ++step) {
    const CurveJet c = image.evaluate(t, 1);
    const SurfaceJet s = surface.evaluate(c.d[0].x, c.d[0].y, 1), o = other.surface->evaluate(at.x, at.y, 1);
    const Vec3 along = c.d[1].x * s.du() + c.d[1].y * s.dv(), gap = o.point() - s.point();
    const Vec3 normal = glm::cross(o.du(), o.dv());
    const double det = glm::dot(along, normal);
    if (!(std::abs(det) > 1e-9 * glm::length(along) * glm::length(normal))) return std::nullopt;
    const double by = glm::dot(gap, normal) / det;
    t += by;
    at = near_foot(*other.surface, s.point() + by * along, at).place;
    if (std::abs(by) * glm::length(along) <= 1e-14 * size) {
      const Vec3 uv = image.point(t);
      const Vec3 p = surface.point(uv.x, uv.y);
      return distance_from({other.surface, other.plane, at}, p) <= kMet * size ? std::optional(p) : std::nullopt;
    }
    if (!(std::abs(by) * glm::length(along) < 1e3 * size)) return std::nullopt;
  }
  return std::nullopt;
}

double distance_from(const SurfaceNear& of, const Vec3& point) {
  if (of.plane) return std::abs(glm::dot(of.plane->z, point - of.plane->origin));
  const Vec2 at = near_foot(*of.surface, point, of.near).place;
  return glm::length(of.surface->point(at.x, at.y) - point);
}

}  // namespace lekalo::geometry
