// The conic a x^2 + b xy + c y^2 + d x + e y + f = 0 through five of the places; the others must lie on it.
#include "render/drawing/paths/ellipse_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace lekalo::render {

using geometry::kPi;
using geometry::kTwoPi;

namespace {

constexpr size_t kMinPlaces = 9;
// Half axes between these, of the extent of the places: else the places tell the ellipse badly, or it is a line.
constexpr double kNarrowest = 1e-4, kWidest = 1e4;

std::optional<PictureEllipse> ellipse_through(const std::array<Vec2, 5>& places) {
  Eigen::Matrix<double, 5, 6> system;
  for (int k = 0; k < 5; ++k) {
    const double x = places[k].x, y = places[k].y;
    system.row(k) << x * x, x * y, y * y, x, y, 1;
  }
  const Eigen::FullPivLU<Eigen::Matrix<double, 5, 6>> solved(system);
  if (solved.rank() < 5) return std::nullopt;
  const Eigen::Matrix<double, 6, 1> q = solved.kernel().col(0);
  Eigen::Matrix2d form;
  form << q[0], 0.5 * q[1], 0.5 * q[1], q[2];
  if (!(form.determinant() > 0)) return std::nullopt;
  const Eigen::Vector2d center = -0.5 * form.inverse() * Eigen::Vector2d(q[3], q[4]);
  const double level = -(q[5] + 0.5 * (q[3] * center[0] + q[4] * center[1]));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(form);
  std::array<Vec2, 2> half;
  for (int k = 0; k < 2; ++k) {
    const double square = level / axes.eigenvalues()[k];
    if (!(square > 0)) return std::nullopt;
    const double length = std::sqrt(square);
    half[k] = length * Vec2(axes.eigenvectors()(0, k), axes.eigenvectors()(1, k));
    if (!(length > kNarrowest && length < kWidest)) return std::nullopt;
  }
  return PictureEllipse{{center[0], center[1]}, half[0], half[1]};
}

}  // namespace

std::optional<EllipticArc> elliptic_arc(const std::vector<Vec2>& places, double tolerance, double min_turn) {
  if (places.size() < kMinPlaces) return std::nullopt;
  Vec2 lo = places[0], hi = places[0];
  for (const Vec2& place : places) lo = glm::min(lo, place), hi = glm::max(hi, place);
  const Vec2 middle = 0.5 * (lo + hi);
  const double extent = 0.5 * std::max(hi.x - lo.x, hi.y - lo.y);
  if (!(extent > 0)) return std::nullopt;
  // The last place may be the first again.
  std::array<Vec2, 5> five;
  for (size_t k = 0; k < 5; ++k) five[k] = (places[k * (places.size() - 1) / 5] - middle) / extent;
  const std::optional<PictureEllipse> unit = ellipse_through(five);
  if (!unit) return std::nullopt;
  const PictureEllipse ellipse{middle + extent * unit->center, extent * unit->x, extent * unit->y};
  const double x = glm::length(ellipse.x), y = glm::length(ellipse.y), widest = std::max(x, y);
  EllipticArc arc{ellipse, 0, 0};
  double sense = 0;
  for (const Vec2& place : places) {
    const Vec2 off = place - ellipse.center;
    const Vec2 q(glm::dot(off, ellipse.x) / (x * x), glm::dot(off, ellipse.y) / (y * y));
    if (!(std::abs(glm::length(q) - 1) * widest <= tolerance)) return std::nullopt;
    const double angle = std::atan2(q.y, q.x);
    if (&place == &places.front()) {
      arc.begin = arc.end = angle;
      continue;
    }
    const double step = std::remainder(angle - arc.end, kTwoPi);
    if (sense == 0) sense = step < 0 ? -1 : 1;
    if (!(step * sense >= 0)) return std::nullopt;
    arc.end += step;
  }
  const double turn = std::abs(arc.end - arc.begin);
  if (!(turn >= min_turn && turn <= kTwoPi * (1 + 1e-9))) return std::nullopt;
  return arc;
}

}  // namespace lekalo::render
