#include "geometry/bodies/local/plane_polygons.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/bodies/local/support.h"
#include "geometry/bodies/topology/entity_names.h"

namespace lekalo::geometry {

namespace {

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length2 = glm::dot(d, d);
  const double t = length2 > 0 ? std::clamp(glm::dot(p - a, d) / length2, 0.0, 1.0) : 0.0;
  return glm::length(p - (a + t * d));
}

template <class Visit>
void each_side(const PlanePolygon& polygon, Visit visit) {
  for (const auto& loop : polygon.loops)
    for (size_t k = 0; k < loop.size(); ++k) visit(loop[k], loop[(k + 1) % loop.size()]);
}

}  // namespace

std::vector<PlanePolygon> polygons_of(const Body& body) {
  std::vector<PlanePolygon> result;
  for (size_t f = 0; f < body.faces.size(); ++f) {
    const Face& face = body.faces[f];
    Frame frame = *plane_of(face.surface);
    if (outward_side(face) < 0) frame = {frame.origin, frame.y, frame.x, -frame.z};
    PlanePolygon polygon{frame, {}, static_cast<int>(f)};
    for (const int l : face.loops) {
      polygon.loops.emplace_back();
      for (const int c : body.loops[l].coedges) {
        const Coedge& use = body.coedges[c];
        const Edge& edge = body.edges[use.edge];
        polygon.loops.back().push_back(body.vertices[use.forward ? edge.start : edge.end].point);
      }
    }
    result.push_back(std::move(polygon));
  }
  return result;
}

std::optional<int> winding(const PlanePolygon& polygon, const Vec3& point, double margin) {
  const Vec2 p(polygon.frame.to_local_point(point));
  const Vec3 in_plane = polygon.frame.point(Vec3(p, 0));
  int turns = 0;
  bool close = false;
  each_side(polygon, [&](const Vec3& from, const Vec3& to) {
    close = close || distance_to_segment(in_plane, from, to) < margin;
    const Vec2 a(polygon.frame.to_local_point(from)), b(polygon.frame.to_local_point(to));
    if ((a.y > p.y) == (b.y > p.y)) return;
    const double x = a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y);
    if (x > p.x) turns += b.y > a.y ? 1 : -1;
  });
  if (close) return std::nullopt;
  return turns;
}

int enclosing(const std::vector<PlanePolygon>& polygons, const Vec3& point, const Vec3& towards,
              const std::vector<char>& skip, double size) {
  const Frame about = frame_about(point, towards);
  // Directions beside it, until one keeps clear of all borders.
  for (int k = 0; k < 64; ++k) {
    const double angle = 2.399963 * k + 0.37, lean = 0.11 + 0.013 * k;
    const Vec3 ray = glm::normalize(about.z + lean * (std::cos(angle) * about.x + std::sin(angle) * about.y));
    int sum = 0;
    bool clear = true;
    for (size_t i = 0; i < polygons.size() && clear; ++i) {
      if (skip[i]) continue;
      const PlanePolygon& q = polygons[i];
      const double along = glm::dot(ray, q.frame.z), height = glm::dot(q.frame.origin - point, q.frame.z);
      if (std::abs(along) < 1e-9) continue;
      const double t = height / along;
      if (t < 0) continue;
      const auto turns = winding(q, point + t * ray, 1e-9 * size);
      if (!turns)
        clear = false;
      else
        sum += along > 0 ? *turns : -*turns;
    }
    if (clear) return sum;
  }
  throw std::invalid_argument("a point of the body is too near to its edges");
}

double distance_from(const PlanePolygon& polygon, const Vec3& point) {
  const auto turns = winding(polygon, point, 0);
  if (turns && *turns != 0) return std::abs(glm::dot(point - polygon.frame.origin, polygon.frame.z));
  double nearest = kInfinity;
  each_side(polygon,
            [&](const Vec3& a, const Vec3& b) { nearest = std::min(nearest, distance_to_segment(point, a, b)); });
  return nearest;
}

std::vector<std::pair<Vec3, Vec3>> traces(const PlanePolygon& polygon, const Frame& plane, double small) {
  std::vector<std::pair<Vec3, Vec3>> result;
  const Vec3 along = glm::cross(plane.z, polygon.frame.z);
  const auto height = [&](const Vec3& p) {
    const double h = glm::dot(p - plane.origin, plane.z);
    return std::abs(h) <= small ? 0.0 : h;
  };
  std::vector<Vec3> crossings;
  each_side(polygon, [&](const Vec3& a, const Vec3& b) {
    const double p = height(a), q = height(b);
    if (p == 0) crossings.push_back(a);
    if (p * q < 0) crossings.push_back(a + (p / (p - q)) * (b - a));
    if (p == 0 && q == 0 && glm::length(b - a) > small) result.emplace_back(a, b);
  });
  std::sort(crossings.begin(), crossings.end(),
            [&](const Vec3& a, const Vec3& b) { return glm::dot(a, along) < glm::dot(b, along); });
  for (size_t k = 0; k + 1 < crossings.size(); ++k) {
    if (glm::length(crossings[k + 1] - crossings[k]) <= small) continue;
    const auto turns = winding(polygon, 0.5 * (crossings[k] + crossings[k + 1]), small);
    if (turns && *turns != 0) result.emplace_back(crossings[k], crossings[k + 1]);
  }
  return result;
}

}  // namespace lekalo::geometry
