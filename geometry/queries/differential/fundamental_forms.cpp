#include "geometry/queries/differential/fundamental_forms.h"

#include <cmath>

namespace lekalo::geometry {

namespace {

constexpr double kNoCurvature = 1e-9;

// Which of the principal curvatures count as zero.
struct Vanishing {
  bool first, second;
};
Vanishing vanishing(const SurfaceCurvature& c, double size) {
  const double larger = std::max(std::abs(c.principal[0]), std::abs(c.principal[1]));
  const double least = kNoCurvature * std::max(larger, size > 0 ? 1 / size : 0);
  return {std::abs(c.principal[0]) <= least, std::abs(c.principal[1]) <= least};
}

}  // namespace

std::optional<FundamentalForms> fundamental_forms(const SurfaceJet& jet, const Vec3& normal) {
  const Vec3 &a = jet.du(), &b = jet.dv();
  const double area = glm::length(glm::cross(a, b));
  if (!(area > 1e-14 * glm::length(a) * glm::length(b)) || !(area > 0)) return std::nullopt;
  FundamentalForms result;
  const QuadraticForm& g = result.first = {glm::dot(a, a), glm::dot(a, b), glm::dot(b, b)};
  const QuadraticForm& h =
      result.second = {glm::dot(jet.duu(), normal), glm::dot(jet.duv(), normal), glm::dot(jet.dvv(), normal)};
  const double det = area * area;
  auto& w = result.weingarten;
  w[0][0] = (h.uu * g.vv - h.uv * g.uv) / det;
  w[0][1] = (h.uv * g.uu - h.uu * g.uv) / det;
  w[1][0] = (h.uv * g.vv - h.vv * g.uv) / det;
  w[1][1] = (h.vv * g.uu - h.uv * g.uv) / det;
  result.normal_du = -w[0][0] * a - w[0][1] * b;
  result.normal_dv = -w[1][0] * a - w[1][1] * b;
  return result;
}

std::string_view point_type(const SurfaceCurvature& c, double size) {
  const Vanishing none = vanishing(c, size);
  if (none.first && none.second) return "planar";
  if (none.first || none.second) return "parabolic";
  if (c.principal[0] * c.principal[1] < 0) return "hyperbolic";
  const double larger = std::max(std::abs(c.principal[0]), std::abs(c.principal[1]));
  return c.principal[0] - c.principal[1] <= kNoCurvature * larger ? "umbilic" : "elliptic";
}

// Euler's formula set to zero: tan^2 = -k1/k2 (Golovanov 2016, 3.1.14).
std::vector<Vec3> asymptotic_directions(const SurfaceCurvature& c, double size) {
  const Vanishing none = vanishing(c, size);
  if (none.first && none.second) return {};
  if (none.first) return {c.directions[0]};
  if (none.second) return {c.directions[1]};
  if (c.principal[0] * c.principal[1] > 0) return {};
  const double angle = std::atan(std::sqrt(-c.principal[0] / c.principal[1]));
  const Vec3 along = std::cos(angle) * c.directions[0], across = std::sin(angle) * c.directions[1];
  return {along + across, along - across};
}

DirectionalCurvature curvature_along(const SurfaceJet& jet, const Vec3& normal, const FundamentalForms& forms,
                                     const SurfaceCurvature& principal, const Vec2& direction) {
  DirectionalCurvature result;
  const double squared = forms.first(direction), length = std::sqrt(squared);
  result.direction = (direction.x * jet.du() + direction.y * jet.dv()) / length;
  result.normal = forms.second(direction) / squared;
  const Vec3 turn = (direction.x * forms.normal_du + direction.y * forms.normal_dv) / length;
  result.torsion = -glm::dot(turn, glm::cross(normal, result.direction));
  const Vec3& first = principal.directions[0];
  const double sine = glm::dot(normal, glm::cross(first, result.direction)), cosine = glm::dot(first, result.direction);
  result.angle = cosine < 0 ? std::atan2(-sine, -cosine) : std::atan2(sine, cosine);
  return result;
}

CurveOnSurfaceCurvature curvature_on_surface(const CurveJet& jet, const Vec3& normal) {
  const Vec3 &r1 = jet.d[1], &r2 = jet.d[2];
  const double speed = glm::length(r1);
  return {glm::dot(r2, normal) / (speed * speed), glm::dot(glm::cross(normal, r1), r2) / (speed * speed * speed)};
}

}  // namespace lekalo::geometry
