#include "geometry/surfaces/blends/exact_chamfer.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"

namespace lekalo::geometry {

namespace {

constexpr int kPlaces = 24;
constexpr double kSame = 1e-11;

std::shared_ptr<Surface> plane(const std::vector<Contact>& at, double size) {
  const Vec3 first = at.front().points[0], way = at.back().points[0] - first;
  const double length = glm::length(way);
  if (!(length > kSame * size)) return nullptr;
  const Vec3 x = way / length;
  const auto off_line = [&](const Vec3& p, const Vec3& origin) {
    return glm::length((p - origin) - glm::dot(p - origin, x) * x);
  };
  for (const Contact& one : at)
    if (off_line(one.points[0], first) + off_line(one.points[1], at.front().points[1]) > kSame * size) return nullptr;
  const Vec3 over = at.front().points[1] - first, y = over - glm::dot(over, x) * x;
  const double width = glm::length(y);
  if (!(width > kSame * size)) return nullptr;
  const Frame frame{first, x, y / width, glm::cross(x, y / width)};
  double lo = 0, hi = length;
  for (const Contact& one : at)
    for (const Vec3& p : one.points)
      lo = std::min(lo, glm::dot(p - first, x)), hi = std::max(hi, glm::dot(p - first, x));
  return std::make_shared<Plane>(frame, Rectangle{{lo, hi}, {0, width}});
}

std::shared_ptr<Surface> cone(const std::vector<Contact>& at, double size) {
  const Vec3 &a = at[0].points[0], &b = at[kPlaces / 3].points[0], &c = at[2 * kPlaces / 3].points[0];
  const Vec3 p = b - a, q = c - a, n = glm::cross(p, q);
  const Vec3 to = (glm::dot(p, p) * glm::cross(q, n) + glm::dot(q, q) * glm::cross(n, p)) / (2 * glm::dot(n, n));
  const double radius = glm::length(to);
  if (!(radius < 1e6 * size)) return nullptr;
  const Vec3 axis = glm::normalize(n);
  // Of both contacts: height, distance from the axis, the direction from it.
  const Vec3 center = a + to;
  struct Seen {
    double height, distance;
    Vec3 direction;
  };
  const auto seen = [&](const Vec3& point) {
    const Vec3 off = point - center;
    const double height = glm::dot(off, axis);
    const Vec3 out = off - height * axis;
    return Seen{height, glm::length(out), glm::normalize(out)};
  };
  const Seen top = seen(at.front().points[1]);
  for (const Contact& one : at) {
    const Seen first = seen(one.points[0]), second = seen(one.points[1]);
    if (!(std::abs(first.height) + std::abs(first.distance - radius) + std::abs(second.height - top.height) +
              std::abs(second.distance - top.distance) + radius * glm::length(first.direction - second.direction) <=
          kSame * size))
      return nullptr;
  }
  if (!(std::abs(top.height) > kSame * size)) return nullptr;
  double swept = 0;
  for (size_t i = 0; i + 1 < at.size(); ++i) {
    const Vec3 x = at[i].points[0] - center, y = at[i + 1].points[0] - center;
    swept += std::atan2(glm::dot(glm::cross(x, y), axis), glm::dot(x, y));
  }
  const Vec3 z = swept > 0 ? axis : -axis;
  const Frame frame = frame_from(center, z, at.front().points[0] - center);
  const bool is_whole = std::abs(swept) > kTwoPi * (1 - kSame);
  return std::make_shared<ConeSurface>(frame, radius, top.distance, swept > 0 ? top.height : -top.height,
                                       Rectangle{{0, is_whole ? kTwoPi : std::abs(swept)}, {0, 1}});
}

}  // namespace

std::shared_ptr<Surface> exact_chamfer(const Contacts& contacts) {
  std::vector<Contact> at;
  const Interval t = contacts.domain();
  for (int i = 0; i <= kPlaces; ++i) at.push_back(contacts.at(t.lo + t.width() * i / kPlaces));
  std::shared_ptr<Surface> exact = plane(at, contacts.size());
  if (!exact) exact = cone(at, contacts.size());
  return exact;
}

}  // namespace lekalo::geometry
