#include "geometry/surfaces/blends/exact_fillet.h"

#include <cmath>
#include <stdexcept>

#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/torus.h"

namespace lekalo::geometry {

namespace {

constexpr int kPlaces = 24;
constexpr double kSame = 1e-11;

std::vector<Contact> looked_at(const Contacts& contacts) {
  std::vector<Contact> result;
  const Interval t = contacts.domain();
  for (int i = 0; i <= kPlaces; ++i) result.push_back(contacts.at(t.lo + t.width() * i / kPlaces));
  return result;
}

std::shared_ptr<Surface> cylinder(const std::vector<Contact>& at, double size) {
  const Vec3 first = at.front().center, way = at.back().center - first;
  const double length = glm::length(way);
  if (!(length > kSame * size)) return nullptr;
  const Vec3 z = way / length, to_a = at.front().points[0] - first, to_b = at.front().points[1] - first;
  for (const Contact& one : at) {
    const Vec3 off = one.center - first;
    if (glm::length(off - glm::dot(off, z) * z) > kSame * size) return nullptr;
    if (glm::length(one.points[0] - one.center - to_a) + glm::length(one.points[1] - one.center - to_b) > kSame * size)
      return nullptr;
  }
  const double angle = std::atan2(glm::dot(glm::cross(to_a, to_b), z), glm::dot(to_a, to_b));
  const Frame frame = angle > 0 ? frame_from(first, z, to_a) : frame_from(at.back().center, -z, to_a);
  return std::make_shared<CylinderSurface>(frame, at.front().radius, length, Rectangle{{0, std::abs(angle)}, {0, 1}});
}

// The circle through three points: its center, radius and normal.
struct Circle3 {
  Vec3 center{0}, normal{0};
  double radius = 0;
};
Circle3 circle_through(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 p = b - a, q = c - a, n = glm::cross(p, q);
  const Vec3 to = (glm::dot(p, p) * glm::cross(q, n) + glm::dot(q, q) * glm::cross(n, p)) / (2 * glm::dot(n, n));
  return {a + to, glm::normalize(n), glm::length(to)};
}

// The angle on the meridian circle, away from the axis; nothing where the point is beside the meridian's plane.
std::optional<double> meridian_angle(const Vec3& to, const Vec3& outward, const Vec3& z, double size) {
  if (std::abs(glm::dot(to, glm::cross(z, outward))) > kSame * size) return std::nullopt;
  return std::atan2(glm::dot(to, z), glm::dot(to, outward));
}

std::shared_ptr<Surface> torus(const std::vector<Contact>& at, double size) {
  Circle3 circle = circle_through(at[0].center, at[kPlaces / 3].center, at[2 * kPlaces / 3].center);
  if (!(circle.radius < 1e6 * size)) return nullptr;
  const double r = at.front().radius;
  const auto angles = [&](const Contact& one) -> std::optional<Vec2> {
    const Vec3 off = one.center - circle.center;
    if (std::abs(glm::length(off) - circle.radius) + std::abs(glm::dot(off, circle.normal)) > kSame * size)
      return std::nullopt;
    const Vec3 outward = glm::normalize(off);
    const auto a = meridian_angle(one.points[0] - one.center, outward, circle.normal, size),
               b = meridian_angle(one.points[1] - one.center, outward, circle.normal, size);
    return a && b ? std::optional(Vec2(*a, *b)) : std::nullopt;
  };
  const auto first = angles(at.front());
  if (!first) return nullptr;
  const auto turned = [](double angle) { return std::remainder(angle, kTwoPi); };
  for (const Contact& one : at) {
    const auto here = angles(one);
    if (!here || (std::abs(turned(here->x - first->x)) + std::abs(turned(here->y - first->y))) * r > kSame * size)
      return nullptr;
  }
  double swept = 0;  // by the center about the normal
  for (size_t i = 0; i + 1 < at.size(); ++i) {
    const Vec3 a = at[i].center - circle.center, b = at[i + 1].center - circle.center;
    swept += std::atan2(glm::dot(glm::cross(a, b), circle.normal), glm::dot(a, b));
  }
  double from = first->x;
  const double across = turned(first->y - first->x);
  if (across < 0) circle.normal = -circle.normal, from = -from, swept = -swept;
  const Vec3 begin = swept > 0 ? at.front().center : at.back().center;
  const Frame frame = frame_from(circle.center, circle.normal, begin - circle.center);
  const bool is_whole = std::abs(swept) > kTwoPi * (1 - kSame);
  const Interval u(0, is_whole ? kTwoPi : std::abs(swept)), v(from, from + std::abs(across));
  try {
    return std::make_shared<TorusSurface>(frame, circle.radius, r, Rectangle{u, v});
  } catch (const std::invalid_argument&) {
    return nullptr;  // beyond the tips on the axis
  }
}

}  // namespace

std::shared_ptr<Surface> exact_fillet(const Contacts& contacts) {
  const std::vector<Contact> at = looked_at(contacts);
  std::shared_ptr<Surface> exact = cylinder(at, contacts.size());
  if (!exact) exact = torus(at, contacts.size());
  return exact;
}

}  // namespace lekalo::geometry
