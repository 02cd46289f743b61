// Views by name or angle, and fitting the picture to what it shall show.
//
// Parallel: the picture of the points is a set of points in the plane; its box is centred and scaled.
// Perspective: with right, up, depth coordinates (x_i, y_i, z_i) of the points about any origin, an eye at (c, ., -d)
// sees all of them between the tangents -T and T if x_i - c <= T (z_i + d) and c - x_i <= T (z_i + d) for all i. The
// nearest such d is (A + B) / (2 T) with A = max(x_i - T z_i), B = max(-x_i - T z_i); the larger of the two sides' d
// serves both, and the other side is centred by bisection.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/cameras/cameras.h"

namespace lekalo::render {

using namespace geometry;

PictureAxes picture_axes(const Vec3& view_direction, const Vec3& up) {
  Vec3 right = glm::cross(view_direction, up);
  if (glm::length(right) <= 1e-9 * glm::length(up)) right = glm::cross(view_direction, Vec3(0, 1, 0));
  if (glm::length(right) <= 1e-9) right = glm::cross(view_direction, Vec3(0, 0, 1));
  right = glm::normalize(right);
  return {right, glm::cross(right, view_direction)};
}

const std::vector<std::string>& view_names() {
  static const std::vector<std::string> names = {"front",  "back",      "left",     "right",    "top",
                                                 "bottom", "isometric", "dimetric", "cavalier", "cabinet"};
  return names;
}

ViewDirection preset_view(std::string_view name) {
  if (name == "front") return {{0, -1, 0}, {0, 0, 1}, 0};
  if (name == "back") return {{0, 1, 0}, {0, 0, 1}, 0};
  if (name == "left") return {{-1, 0, 0}, {0, 0, 1}, 0};
  if (name == "right") return {{1, 0, 0}, {0, 0, 1}, 0};
  if (name == "top") return {{0, 0, 1}, {0, 1, 0}, 0};
  if (name == "bottom") return {{0, 0, -1}, {0, -1, 0}, 0};
  if (name == "isometric") return {glm::normalize(Vec3(1, -1, 1)), {0, 0, 1}, 0};
  if (name == "dimetric") return {Vec3(1, -std::sqrt(7.0), 1) / 3.0, {0, 0, 1}, 0};
  if (name == "cavalier") return {{0, -1, 0}, {0, 0, 1}, 1};
  if (name == "cabinet") return {{0, -1, 0}, {0, 0, 1}, 0.5};
  throw std::invalid_argument("no view is called '" + std::string(name) + "'");
}

ViewDirection view_from_angles(double azimuth, double elevation) {
  const Vec3 to_viewer(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                       std::sin(elevation));
  // At the poles the picture's up is the limit along the meridian.
  const Vec3 up(-std::sin(elevation) * std::cos(azimuth), -std::sin(elevation) * std::sin(azimuth),
                std::cos(elevation));
  return {to_viewer, up, 0};
}

namespace {

// Between the eye and the nearest point, of the extent of all.
constexpr double kMinDistance = 1e-3;

struct Range {
  double lo = kInfinity, hi = -kInfinity;
  void include(double x) {
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
  double middle() const { return 0.5 * (lo + hi); }
  double width() const { return hi - lo; }
};

// Half the sides of the picture in units of its shorter one, less the margin.
Vec2 half_sides(int width, int height, double margin) {
  const double shorter = std::min(width, height);
  return Vec2(0.5 * width / shorter - margin, 0.5 * height / shorter - margin);
}

// Place of the eye on the axis x or y so that the pictures of points (x, y, depth) reach equally far to both sides.
double centred(std::vector<Vec3> points, int axis, double distance) {
  double lo = kInfinity, hi = -kInfinity;
  for (const Vec3& p : points) {
    lo = std::min(lo, p[axis]);
    hi = std::max(hi, p[axis]);
  }
  const auto tangent = [&](const Vec3& p, double c) { return (p[axis] - c) / (p.z + distance); };
  const auto tangents = [&](double c) {
    Range all;
    for (const Vec3& p : points) all.include(tangent(p, c));
    return all;
  };
  for (int i = 0; i < 100 && lo < hi; ++i) {
    const double c = 0.5 * (lo + hi);
    (tangents(c).middle() > 0 ? lo : hi) = c;
    if (points.size() <= 16) continue;
    // Tangents fall as the eye moves on: what reaches as far as others nowhere between lo and hi does not count.
    const double first = tangents(lo).lo, last = tangents(hi).hi;
    std::erase_if(points, [&](const Vec3& p) { return tangent(p, lo) < last && tangent(p, hi) > first; });
  }
  return 0.5 * (lo + hi);
}

}  // namespace

CameraPtr make_view_camera(const ViewDirection& view, int width, int height, std::span<const Vec3> points,
                           double margin) {
  if (points.empty()) throw std::invalid_argument("there is nothing to frame");
  const Vec3 normal = -view.to_viewer;
  const PictureAxes axes = picture_axes(normal, view.up);
  // The oblique ray makes a point at depth s appear `oblique` s to the right and up at 45 degrees.
  const double shift = view.oblique * std::sqrt(0.5);
  const Vec3 along = normal - shift * axes.right - shift * axes.up;
  Range x, y, depth;
  for (const Vec3& p : points) {
    const double s = glm::dot(p, normal);
    x.include(glm::dot(p, axes.right) + shift * s);
    y.include(glm::dot(p, axes.up) + shift * s);
    depth.include(s);
  }
  const Vec2 half = half_sides(width, height, margin);
  double shorter = std::max(0.5 * x.width() / half.x, 0.5 * y.width() / half.y);  // of the picture, scene units
  if (!(shorter > 0)) shorter = 1;                                                // a single point
  // The picture plane stands clear before the nearest point, so that its own rounding cannot hide that point.
  const double plane = depth.lo - std::max(depth.width(), shorter);
  ParallelView parallel;
  parallel.from = plane * normal + (x.middle() - shift * plane) * axes.right + (y.middle() - shift * plane) * axes.up;
  parallel.at = parallel.from + normal;
  parallel.up = view.up;
  parallel.height = shorter * height / std::min(width, height);
  parallel.along = along;
  return make_camera(parallel, width, height);
}

PerspectiveView framed_perspective(const ViewDirection& view, double field_of_view, int width, int height,
                                   std::span<const Vec3> points, double margin) {
  if (points.empty()) throw std::invalid_argument("there is nothing to frame");
  const Vec3 forward = -view.to_viewer;
  const PictureAxes axes = picture_axes(forward, view.up);
  const Vec2 tangent = 2 * std::tan(0.5 * field_of_view) * half_sides(width, height, margin);
  std::vector<Vec3> seen;  // (x, y, depth)
  seen.reserve(points.size());
  Range depth;
  for (const Vec3& p : points) {
    seen.emplace_back(glm::dot(p, axes.right), glm::dot(p, axes.up), glm::dot(p, forward));
    depth.include(seen.back().z);
  }
  const auto nearest = [&](int axis, double t) {
    double a = -kInfinity, b = -kInfinity;
    for (const Vec3& p : seen) {
      a = std::max(a, p[axis] - t * p.z);
      b = std::max(b, -p[axis] - t * p.z);
    }
    return (a + b) / (2 * t);
  };
  double distance = std::max(nearest(0, tangent.x), nearest(1, tangent.y));
  // The eye must not touch a point (all on one line of sight, or a single point).
  Range sides;
  for (const Vec3& p : seen) sides.include(p.x - seen[0].x), sides.include(p.y - seen[0].y);
  double size = std::max(depth.width(), sides.width());
  if (!(size > 0)) size = std::max({1.0, std::abs(depth.lo), std::abs(seen[0].x), std::abs(seen[0].y)});
  distance = std::max(distance, -depth.lo + kMinDistance * size);
  const double x = centred(seen, 0, distance), y = centred(seen, 1, distance);
  PerspectiveView result;
  result.from = x * axes.right + y * axes.up - distance * forward;
  result.at = result.from + std::max(depth.middle() + distance, kMinDistance * size) * forward;
  result.up = view.up;
  result.field_of_view = field_of_view;
  return result;
}

}  // namespace lekalo::render
