#include "geometry/bodies/topology/landmarks.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "geometry/bodies/trims/trim.h"
#include "geometry/queries/measures/arc_length.h"
#include "geometry/surfaces/analytic/plane.h"

namespace lekalo::geometry {

namespace {

constexpr int kGrid = 24;     // of a face's parameters, in each direction
constexpr int kSamples = 64;  // of a smooth piece of an edge; a multiple of 4: those of a circle are its farthest
constexpr double kNearlyAsFar = 0.9;
constexpr double kSameHeight = 1e-9;  // of the size

}  // namespace

std::vector<Vec3> points_along(const Curve& curve, int steps) {
  std::vector<Vec3> points{curve.point(curve.domain().lo)};
  for (const CurvePiece& piece : curve.pieces())
    for (int k = 1; k <= steps; ++k) points.push_back(curve.point(piece.domain.lo + piece.domain.width() * k / steps));
  return points;
}

Vec3 extreme_point(const Distant& of, const Box3& box, const Vec3& way) {
  const Vec3 unit = glm::normalize(way);
  const Plane beyond(frame_about(box.center() + box.diameter() * unit, unit));
  return distance(of, static_cast<const Surface*>(&beyond), DistanceMinima::nearest).minima.front().a.point;
}

Vec3 inner_point(const Body& body, int face) {
  const Surface& surface = *body.faces[face].surface;
  const std::shared_ptr<const TrimRegion> trim = trim_of(body, face);
  const std::vector<Vec3> border = points_of_border(body, face);
  Rectangle range = surface.domain();
  if (trim) range = {trim->u_range(), trim->v_range()};
  Vec3 middle(0);
  for (const Vec3& p : border) middle += p / static_cast<double>(border.size());
  std::vector<std::pair<double, Vec3>> inside;  // with the distance from the edges
  double farthest = 0;
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < kGrid; ++j) {
      const double u = range.u.lo + range.u.width() * (i + 0.5) / kGrid,
                   v = range.v.lo + range.v.width() * (j + 0.5) / kGrid;
      if (trim && !trim->contains(u, v)) continue;
      const Vec3 point = surface.point(u, v);
      double nearest = kInfinity;
      for (const Vec3& p : border) nearest = std::min(nearest, glm::length(p - point));
      inside.emplace_back(nearest, point);
      farthest = std::max(farthest, nearest);
    }
  // Of those that are about as far the one in the middle.
  Vec3 best = border.front();
  double least = kInfinity;
  for (const auto& [distance, point] : inside)
    if (const double off = glm::length(point - middle); distance >= kNearlyAsFar * farthest && off < least)
      least = off, best = point;
  return best;
}

Vec3 middle_of(const Curve& curve) { return curve.point(parameter_at_fraction(curve, 0.5)); }

std::vector<Vec3> points_of_border(const Body& body, int face, int steps) {
  std::vector<Vec3> points;
  for (const int loop : body.faces[face].loops)
    for (const int coedge : body.loops[loop].coedges) {
      const std::vector<Vec3> some = points_along(*body.edges[body.coedges[coedge].edge].curve, steps);
      points.insert(points.end(), some.begin(), some.end());
    }
  return points;
}

std::vector<Vec3> points_at_end(const Body& body, const Vec3& way) {
  const Vec3 unit = glm::normalize(way);
  const Vec3 farthest = extreme_point(&body, bounds(body), way);
  const double level = glm::dot(farthest, unit) - kSameHeight * bounds(body).diameter();
  std::vector<Vec3> points{farthest};
  for (const Edge& edge : body.edges)
    for (const Vec3& p : points_along(*edge.curve, kSamples))
      if (glm::dot(p, unit) >= level) points.push_back(p);
  return points;
}

}  // namespace lekalo::geometry
