#include "geometry/bodies/blends/supports.h"

#include <cmath>
#include <stdexcept>

#include "geometry/bodies/blends/lines_on_surfaces.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/derived/composite_curve.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/queries/closest/closest_point.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/derived/extended.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

constexpr double kFlat = 1e-13;  // of the size

// Looked at in some places.
SurfacePtr plane_of(const SurfacePtr& surface) {
  if (const auto* plane = dynamic_cast<const Plane*>(surface.get())) return std::make_shared<Plane>(plane->frame());
  if (!surface->bounded()) return nullptr;
  constexpr int kPlaces = 12;
  const Rectangle d = surface->domain();
  const Vec3 origin = surface->point(d.u.middle(), d.v.middle()), normal = surface->normal(d.u.middle(), d.v.middle());
  const double size = bounds(*surface).diameter();
  for (int i = 0; i <= kPlaces; ++i)
    for (int j = 0; j <= kPlaces; ++j) {
      const Vec3 p = surface->point(d.u.lo + d.u.width() * i / kPlaces, d.v.lo + d.v.width() * j / kPlaces);
      if (!(std::abs(glm::dot(p - origin, normal)) <= kFlat * size)) return nullptr;
    }
  return std::make_shared<Plane>(frame_about(origin, normal));
}

struct CircleOfCurve {
  Frame frame;
  double radius = 0;
};

// Looked at in some places.
std::optional<CircleOfCurve> circle_of(const Curve& curve) {
  constexpr int kPlaces = 24;
  const Interval t = curve.domain();
  const CurveJet jet = curve.evaluate(t.middle(), 2);
  const double speed = glm::length(jet.d[1]);
  const Vec3 along = jet.d[1] / speed, bend = (jet.d[2] - glm::dot(jet.d[2], along) * along) / (speed * speed);
  const double curvature = glm::length(bend);
  if (!(curvature * bounds(curve).diameter() > 1e-6)) return std::nullopt;
  const Vec3 x = -bend / curvature;
  const CircleOfCurve circle{{jet.d[0] - x / curvature, x, along, glm::cross(x, along)}, 1 / curvature};
  for (int k = 0; k <= kPlaces; ++k) {
    const Vec3 off = curve.point(t.lo + t.width() * k / kPlaces) - circle.frame.origin;
    if (std::abs(glm::length(off) - circle.radius) + std::abs(glm::dot(off, circle.frame.z)) >
        4 * kFlat * circle.radius)
      return std::nullopt;
  }
  return circle;
}

SurfacePtr cylinder_of(const SurfacePtr& surface) {
  if (const auto* cylinder = dynamic_cast<const CylinderSurface*>(surface.get()))
    return std::make_shared<CylinderSurface>(cylinder->frame(), cylinder->radius(), cylinder->height(),
                                             CylinderSurface::kUnbounded);
  const auto* extrusion = dynamic_cast<const ExtrusionSurface*>(surface.get());
  const auto circle = extrusion ? circle_of(*extrusion->curve()) : std::nullopt;
  if (!circle) return nullptr;
  const Vec3& along = extrusion->along();
  if (glm::length(glm::cross(along, circle->frame.z)) > kFlat * glm::length(along)) return nullptr;
  return std::make_shared<CylinderSurface>(circle->frame, circle->radius, 1, CylinderSurface::kUnbounded);
}

// The curve over the parameters from an end of its domain to t beyond: the circle that osculates there, so that circles
// go on as they are.
CurvePtr continuation_to(const Curve& curve, double end, double t) {
  const CurveJet jet = curve.evaluate(end, 2);
  const double speed = glm::length(jet.d[1]);
  const Vec3 along = jet.d[1] / speed, bend = (jet.d[2] - glm::dot(jet.d[2], along) * along) / (speed * speed);
  const double curvature = glm::length(bend), angle = curvature * speed * (t - end);
  const Interval range(std::min(t, end), std::max(t, end));
  if (std::abs(angle) < 1e-9) {
    const Vec3 p = jet.d[0] + (range.lo - end) * jet.d[1], q = jet.d[0] + (range.hi - end) * jet.d[1];
    return with_domain(std::make_shared<Segment>(p, q), range);
  }
  const Vec3 x = -bend / curvature;
  const Frame frame{jet.d[0] - x / curvature, x, along, glm::cross(x, along)};
  const Interval angles(std::min(angle, 0.0), std::max(angle, 0.0));
  return with_domain(std::make_shared<Circle>(frame, 1 / curvature, angles), range);
}

Interval wider(const Interval& range, double period) {
  if (!(range.width() < kInfinity)) return range;
  const double by = period > 0 ? std::clamp(0.5 * (period - range.width()), 0.0, range.width()) : range.width();
  return {range.lo - by, range.hi + by};
}

}  // namespace

SurfacePtr support_of(const SurfacePtr& surface) {
  if (SurfacePtr plane = plane_of(surface)) return plane;
  if (SurfacePtr cylinder = cylinder_of(surface)) return cylinder;
  const Rectangle domain = surface->domain();
  const Periods periods = surface->periods();
  const Rectangle wide{wider(domain.u, periods.u), wider(domain.v, periods.v)};
  try {
    if (SurfacePtr more = continued_by_law(surface, wide)) return more;
    if (surface->bounded()) return extended_to(surface, wide);
  } catch (const std::invalid_argument&) {
    // Beyond a pole there is nothing.
  }
  return surface;
}

Vec2 foot_place_anywhere(const SurfacePtr& surface, const Vec3& p, const Vec2& near) {
  if (const auto* plane = dynamic_cast<const Plane*>(surface.get())) return Vec2(plane->frame().to_local_point(p));
  if (const auto* cylinder = dynamic_cast<const CylinderSurface*>(surface.get())) {
    const Vec3 q = cylinder->frame().to_local_point(p);
    const double u = std::atan2(q.y, q.x);
    return {u + kTwoPi * std::round((near.x - u) / kTwoPi), q.z / cylinder->height()};
  }
  if (const auto found = foot_place(*surface, p, near)) {
    const Vec3 there = surface->point(found->x, found->y);
    if (glm::length(there - p) <= 1e-6 * (1 + glm::length(p))) return *found;
  }
  const SurfaceFootPoints found = SurfaceProjector(surface).foot_points(p);
  if (found.foot_points.empty()) throw std::invalid_argument("a surface has no foot point of a place beside it");
  return {found.foot_points.front().u, found.foot_points.front().v};
}

CurvePtr guide_beyond(const CurvePtr& curve, const std::array<double, 2>& lengths) {
  const Interval t = curve->domain();
  const double before = lengths[0] / glm::length(curve->evaluate(t.lo, 1).d[1]),
               after = lengths[1] / glm::length(curve->evaluate(t.hi, 1).d[1]);
  if (before <= 0 && after <= 0) return curve;
  std::vector<CurvePtr> parts;
  if (before > 0) parts.push_back(continuation_to(*curve, t.lo, t.lo - before));
  parts.push_back(curve);
  if (after > 0) parts.push_back(continuation_to(*curve, t.hi, t.hi + after));
  return std::make_shared<CompositeCurve>(std::move(parts), false, 1e-9, t.lo - std::max(before, 0.0));
}

bool is_closed_smoothly(const Curve& curve) {
  const Interval t = curve.domain();
  const CurveJet a = curve.evaluate(t.lo, 1), b = curve.evaluate(t.hi, 1);
  constexpr double kSmooth = 1e-6;
  return glm::length(a.d[0] - b.d[0]) <= 1e-9 * bounds(curve).diameter() &&
         glm::length(glm::normalize(a.d[1]) - glm::normalize(b.d[1])) <= kSmooth;
}

}  // namespace lekalo::geometry
