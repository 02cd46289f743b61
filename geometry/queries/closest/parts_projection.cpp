#include "geometry/queries/closest/parts_projection.h"

#include <algorithm>
#include <stdexcept>

#include "geometry/curves/operations/surface_curve.h"

namespace lekalo::geometry {

namespace {

// So far beside an edge, of the domain, its sides are told apart.
constexpr double kBeside = 1e-6;
// Foot points of two parts nearer than this share of the domain are one, on the border between them.
constexpr double kSameFootPoint = 1e-9;

}  // namespace

ProjectorOfParts::ProjectorOfParts(std::vector<SmoothPart> parts) : parts_(std::move(parts)) {
  for (const SmoothPart& part : parts_) projectors_.emplace_back(part.surface);
  const FreeCreases found = free_creases(parts_);
  if (!found.complete) throw std::invalid_argument("the kinks and steps of the surface are not all known");
  for (const FreeCrease& line : found.lines) {
    const auto a = static_cast<size_t>(line.parts[0]), b = static_cast<size_t>(line.parts[1]);
    if (!line.step) {
      add_edge(line.image, {a, b});
      continue;
    }
    add_edge(line.image, {a});
    add_edge(line.image, {b});
  }
}

void ProjectorOfParts::add_edge(const Curve2Ptr& image, std::vector<size_t> parts) {
  CurveProjector foot_points(std::make_shared<SurfaceCurve>(parts_[parts[0]].surface, image));
  edges_.push_back({image, std::move(parts), std::move(foot_points)});
}

// Along the edge the distance is least at t: whether it grows into the parts as well.
bool ProjectorOfParts::is_minimum(const Edge& edge, double t, const Vec3& point) const {
  const CurveJet at = edge.image->evaluate(t, 1);
  const Vec2 uv(at.d[0]), along(at.d[1]);
  const double speed = glm::length(along);
  if (!(speed > 0)) return true;
  const Vec2 across = Vec2(-along.y, along.x) / speed;
  return std::all_of(edge.parts.begin(), edge.parts.end(), [&](size_t k) {
    const SmoothPart& part = parts_[k];
    const Rectangle domain = part.surface->domain();
    const Vec2 beside = uv + kBeside * std::max(domain.u.width(), domain.v.width()) * across;
    const Vec2 inward = is_in(part, beside.x, beside.y) ? across : -across;
    const SurfaceJet s = part.surface->evaluate(uv.x, uv.y, 1);
    const Vec3 way = point - s.point(), step = inward.x * s.du() + inward.y * s.dv();
    return !(glm::dot(way, step) > 1e-14 * glm::length(way) * glm::length(step));
  });
}

SurfaceFootPoints ProjectorOfParts::foot_points(const Vec3& point) const {
  SurfaceFootPoints all;
  const auto add = [&](const SurfaceFootPoint& foot_point, const Surface& surface) {
    const Rectangle domain = surface.domain();
    const bool known = std::any_of(all.foot_points.begin(), all.foot_points.end(), [&](const SurfaceFootPoint& other) {
      return std::abs(other.u - foot_point.u) <= kSameFootPoint * domain.u.width() &&
             std::abs(other.v - foot_point.v) <= kSameFootPoint * domain.v.width() &&
             glm::length(other.point - foot_point.point) <= kSameFootPoint * (1 + foot_point.distance);
    });
    if (!known) all.foot_points.push_back(foot_point);
  };
  for (size_t k = 0; k < parts_.size(); ++k) {
    const SurfaceFootPoints found = projectors_[k].foot_points(point);
    for (const SurfaceFootPoint& foot_point : found.foot_points)
      if (is_in(parts_[k], foot_point.u, foot_point.v)) add(foot_point, *parts_[k].surface);
    for (const Rectangle& region : found.regions)
      if (is_in(parts_[k], region.u.middle(), region.v.middle())) all.regions.push_back(region);
  }
  for (const Edge& edge : edges_)
    for (const CurveFootPoint& foot_point : edge.foot_points.foot_points(point).foot_points) {
      if (foot_point.kind == FootPointKind::maximum || !is_minimum(edge, foot_point.t, point)) continue;
      const Vec3 uv = edge.image->point(foot_point.t);
      add({uv.x, uv.y, foot_point.point, foot_point.distance, FootPointKind::border}, *parts_[edge.parts[0]].surface);
    }
  std::sort(all.foot_points.begin(), all.foot_points.end(), [](const SurfaceFootPoint& a, const SurfaceFootPoint& b) {
    if (a.distance != b.distance) return a.distance < b.distance;
    return a.u != b.u ? a.u < b.u : a.v < b.v;
  });
  return all;
}

}  // namespace lekalo::geometry
