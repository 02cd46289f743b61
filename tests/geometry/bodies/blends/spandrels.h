// What fillets and chamfers take off a convex polyhedron, by counting points: the union of what lies between two faces
// and the cylinder or plane of each edge. It holds where no corner is rounded by a ball.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "geometry/bodies/blends/blend_models.h"

namespace lekalo::geometry {

struct HalfSpace {
  Vec3 point, normal;  // outward
  double depth(const Vec3& p) const { return -glm::dot(p - point, normal); }
};

// None where a face is not plane, or a vertex lies outside of one.
inline std::optional<std::vector<HalfSpace>> half_spaces(const Body& body) {
  std::vector<HalfSpace> result;
  const double size = bounds(body).diameter();
  for (size_t f = 0; f < body.faces.size(); ++f) {
    std::optional<HalfSpace> plane;
    for (const int loop : body.faces[f].loops)
      for (const int c : body.loops[loop].coedges) {
        const Coedge& coedge = body.coedges[c];
        for (const double share : {0.1, 0.5, 0.8}) {
          const Interval t = coedge.image->domain();
          const Vec2 uv(coedge.image->point(t.lo + share * t.width()));
          const HalfSpace here{body.faces[f].surface->point(uv.x, uv.y), body.normal(static_cast<int>(f), uv.x, uv.y)};
          if (!plane) plane = here;
          if (glm::length(here.normal - plane->normal) > 1e-9) return std::nullopt;
        }
      }
    result.push_back(*plane);
    for (const Vertex& vertex : body.vertices)
      if (plane->depth(vertex.point) < -1e-9 * size) return std::nullopt;
  }
  return result;
}

struct Spandrel {
  Vec3 start, along;
  double length = 0, sine = 1;  // of the angle between its faces
  std::array<Vec3, 2> outward;  // of its faces
  std::array<Vec3, 2> across;   // in its faces, towards the edge
  Vec3 center{0};               // of the ball at the start
  double size = 0;
  bool is_chamfer = false;

  bool contains(const Vec3& p) const {
    if (is_chamfer) return glm::dot(p - start + size * across[0], outward[0] + outward[1]) > 0;
    const Vec3 off = p - center, flat = off - glm::dot(off, along) * along;
    return glm::dot(flat, across[0]) > 0 && glm::dot(flat, across[1]) > 0 && glm::length(flat) > size;
  }
};

inline Spandrel spandrel_of(const Body& body, const std::vector<HalfSpace>& planes, int edge, double size,
                            bool is_chamfer) {
  const Edge& e = body.edges[edge];
  Spandrel result;
  result.size = size, result.is_chamfer = is_chamfer;
  result.start = body.vertices[e.start].point;
  const Vec3 way = body.vertices[e.end].point - result.start;
  result.length = glm::length(way), result.along = way / result.length;
  for (int k = 0; k < 2; ++k) result.outward[k] = planes[face_of(body, e.coedges[k])].normal;
  result.sine = glm::length(glm::cross(result.outward[0], result.outward[1]));
  for (int k = 0; k < 2; ++k) {
    const Vec3 &n = result.outward[k], &other = result.outward[1 - k];
    result.across[k] = glm::normalize(other - glm::dot(other, n) * n);
  }
  // As deep below both faces.
  const Vec3 sum = result.outward[0] + result.outward[1];
  result.center = result.start - size / (1 + glm::dot(result.outward[0], result.outward[1])) * sum;
  return result;
}

// To about 1e-3 of it. None where it is not so simple.
inline std::optional<double> taken_off(const BlendModel& model) {
  const auto planes = half_spaces(model.body);
  if (!planes) return std::nullopt;
  std::vector<Spandrel> spandrels;
  std::vector<int> blended(model.body.vertices.size(), 0), all = blended;
  for (const Edge& edge : model.body.edges)
    for (const int vertex : {edge.start, edge.end}) ++all[vertex];
  for (const int e : model.edges) {
    const Edge& edge = model.body.edges[e];
    for (const int vertex : {edge.start, edge.end})
      if (++blended[vertex] == all[vertex] && !model.is_chamfer) return std::nullopt;
    spandrels.push_back(spandrel_of(model.body, *planes, e, model.size, model.is_chamfer));
  }
  constexpr int kPoints = 200'000;
  double volume = 0;
  for (size_t i = 0; i < spandrels.size(); ++i) {
    const Spandrel& one = spandrels[i];
    // At a distance along the edge, beyond its ends too, and two depths below its faces: the squares of x and y, as
    // most lies near to the edge.
    const double beyond = 2 * model.size, length = one.length + 2 * beyond, deepest = 2 * model.size;
    double sum = 0;
    for (int k = 0; k < kPoints; ++k) {
      const auto share = [&](double step) { return std::fmod(0.5 + step * k, 1.0); };  // Roberts' R3
      const double x = share(0.6710436067037893), y = share(0.5497004779019703);
      const double a = deepest * x * x, b = deepest * y * y;
      const Vec3 p = one.start + (length * share(0.8191725133961645) - beyond) * one.along -
                     (b * one.across[0] + a * one.across[1]) / one.sine;
      const auto below = [&](const HalfSpace& plane) { return plane.depth(p) > 0; };
      const auto contains = [&](const Spandrel& other) { return other.contains(p); };
      if (one.contains(p) && std::all_of(planes->begin(), planes->end(), below) &&
          std::none_of(spandrels.begin(), spandrels.begin() + static_cast<std::ptrdiff_t>(i), contains))
        sum += 4 * x * y;
    }
    volume += length * deepest * deepest / one.sine * sum / kPoints;
  }
  return volume;
}

}  // namespace lekalo::geometry
