#include "geometry/bodies/blends/lines_on_surfaces.h"

#include <cmath>

#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/bodies/primitives/construct.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/curves/splines/polynomial_approximation.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"

namespace lekalo::geometry {

namespace {

// The circle over the angles from a to b, which may be less: then its axis is turned.
LineOnSurface circle_line(const Frame& frame, double radius, double a, double b, const Vec2& from, const Vec2& to) {
  if (radius < 0) return circle_line({frame.origin, -frame.x, -frame.y, frame.z}, -radius, a, b, from, to);
  if (a < b) return {std::make_shared<Circle>(frame, radius, Interval(a, b)), image_line({a, b}, from, to)};
  const Frame turned{frame.origin, frame.x, -frame.y, -frame.z};
  return {std::make_shared<Circle>(turned, radius, Interval(-a, -b)), image_line({-a, -b}, from, to)};
}

LineOnSurface segment_line(const Surface& surface, const Vec2& from, const Vec2& to) {
  return {std::make_shared<Segment>(surface.point(from.x, from.y), surface.point(to.x, to.y)),
          image_line({0, 1}, from, to)};
}

// A meridian circle of a torus or sphere: its center, x away from the axis, y along it.
Frame meridian_frame(const Frame& of, double u, double major) {
  const Vec3 x = std::cos(u) * of.x + std::sin(u) * of.y;
  return {of.origin + major * x, x, of.z, glm::cross(x, of.z)};
}

Frame parallel_frame(const Frame& of, double height) { return {of.origin + height * of.z, of.x, of.y, of.z}; }

}  // namespace

LineOnSurface line_between(const SurfacePtr& surface, const Vec2& from, const Vec2& to) {
  const bool along_u = from.y == to.y;
  if (dynamic_cast<const Plane*>(surface.get())) return segment_line(*surface, from, to);
  if (const auto* cone = dynamic_cast<const ConeSurface*>(surface.get())) {
    if (!along_u) return segment_line(*surface, from, to);
    const double radius = cone->radius() + (cone->top_radius() - cone->radius()) * from.y;
    if (radius != 0)
      return circle_line(parallel_frame(cone->frame(), cone->height() * from.y), radius, from.x, to.x, from, to);
  }
  if (const auto* torus = dynamic_cast<const TorusSurface*>(surface.get())) {
    const double r = torus->minor_radius(), major = torus->major_radius();
    if (!along_u) return circle_line(meridian_frame(torus->frame(), from.x, major), r, from.y, to.y, from, to);
    const double radius = major + r * std::cos(from.y);
    if (radius != 0)
      return circle_line(parallel_frame(torus->frame(), r * std::sin(from.y)), radius, from.x, to.x, from, to);
  }
  if (const auto* sphere = dynamic_cast<const SphereSurface*>(surface.get())) {
    const double r = sphere->radius();
    if (!along_u) return circle_line(meridian_frame(sphere->frame(), from.x, 0), r, from.y, to.y, from, to);
    const double radius = r * std::cos(from.y);
    if (radius != 0)
      return circle_line(parallel_frame(sphere->frame(), r * std::sin(from.y)), radius, from.x, to.x, from, to);
  }
  const double a = along_u ? from.x : from.y, b = along_u ? to.x : to.y;
  const Interval range(std::min(a, b), std::max(a, b));
  CurvePtr line = std::make_shared<ParameterLine>(surface, along_u ? IsoDirection::v : IsoDirection::u,
                                                  along_u ? from.y : from.x, range);
  if (a > b) line = reversed_curve(line);
  return {line, image_line(range, from, to)};
}

Curve2Ptr image_on(const SurfacePtr& surface, const CurvePtr& curve, const Vec2& near) {
  if (const auto* plane = dynamic_cast<const Plane*>(surface.get())) return image_in(plane->frame(), curve);
  constexpr int kSteps = 64;
  constexpr double kAgree = 1e-13, kRounding = 4e-15, kSliver = 1e-7;
  const Interval t = curve->domain();
  std::vector<Vec2> nodes(kSteps + 1, near);
  const auto at_node = [&](int k) { return t.lo + t.width() * k / kSteps; };
  double largest = 0;
  for (const int way : {1, -1})
    for (int k = kSteps / 2; k >= 0 && k <= kSteps; k += way) {
      const Vec2 start = k == kSteps / 2 ? near : nodes[k - way];
      const auto place = foot_place(*surface, curve->point(at_node(k)), start);
      if (!place) return nullptr;
      nodes[k] = *place;
      largest = std::max({largest, std::abs(place->x), std::abs(place->y)});
    }
  const Vec2 size = glm::abs(nodes.front() - nodes[kSteps / 2]) + glm::abs(nodes.back() - nodes[kSteps / 2]);
  // Points are rounded too, which moves their places by as much as the surface is slow there.
  const SurfaceJet jet = surface->evaluate(nodes[kSteps / 2].x, nodes[kSteps / 2].y, 1);
  const double slow = std::min(glm::length(jet.du()), glm::length(jet.dv()));
  if (slow > 0) largest = std::max(largest, glm::length(jet.point()) / slow);
  const double tolerance = std::max(kAgree * std::max(size.x, size.y), kRounding * largest);
  const auto place = [&](double at) {
    const double x = (at - t.lo) / t.width() * kSteps;
    const int k = std::clamp(static_cast<int>(x), 0, kSteps - 1);
    const auto found = foot_place(*surface, curve->point(at), glm::mix(nodes[k], nodes[k + 1], x - k));
    return found ? Vec3(*found, 0) : Vec3(std::nan(""));
  };
  // A joint as near to an end as rounding puts it is that end.
  std::vector<Interval> pieces{t};
  for (const CurvePiece& piece : curve->pieces()) {
    const double joint = piece.domain.lo;
    if (!(joint > pieces.back().lo + kSliver * t.width() && joint < t.hi - kSliver * t.width())) continue;
    pieces.back().hi = joint;
    pieces.emplace_back(joint, t.hi);
  }
  return polynomial_approximation(place, pieces, tolerance);
}

}  // namespace lekalo::geometry
