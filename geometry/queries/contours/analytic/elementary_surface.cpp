#include "geometry/queries/contours/analytic/elementary_surface.h"

#include <algorithm>
#include <cmath>

#include "geometry/curves/operations/circle_of_curve.h"
#include "geometry/curves/operations/curve_part.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

constexpr double kSame = 1e-12;  // of its size: nearer to a straight line or a plane is on it

bool is_straight(const Curve& curve) {
  const Interval t = curve.domain();
  const Vec3 a = curve.point(t.lo), chord = curve.point(t.hi) - a;
  const double length = glm::length(chord);
  if (!(length > 0)) return false;
  for (int k = 1; k < 12; ++k) {
    const Vec3 p = curve.point(t.lo + t.width() * k / 12) - a;
    if (!(glm::length(p - glm::dot(p, chord) / (length * length) * chord) <= kSame * length)) return false;
  }
  return true;
}

class Meridian {
 public:
  Meridian(CurvePtr curve, const Axis& axis, const Interval& turn)
      : curve_(std::move(curve)), axis_(axis), turn_(turn) {}

  SurfacePtr surface() const {
    if (is_straight(*curve_)) return of_segment();
    const auto circle = circle_of(*curve_);
    return circle ? of_arc(*circle) : nullptr;
  }

 private:
  double height(const Vec3& p) const { return glm::dot(p - axis_.through, axis_.along); }
  Vec3 away(const Vec3& p) const { return p - axis_.through - height(p) * axis_.along; }

  SurfacePtr of_segment() const {
    const Interval t = curve_->domain();
    const Vec3 a = curve_->point(t.lo), b = curve_->point(t.hi);
    const Vec3 radial = glm::normalize(glm::length(away(a)) > glm::length(away(b)) ? away(a) : away(b));
    const double ra = glm::dot(away(a), radial), rb = glm::dot(away(b), radial), h = height(b) - height(a),
                 same = kSame * (std::abs(ra) + std::abs(rb) + glm::length(b - a));
    if (!(glm::length(away(a) - ra * radial) <= same && glm::length(away(b) - rb * radial) <= same)) return nullptr;
    const Frame frame = frame_from(axis_.through + height(a) * axis_.along, axis_.along, radial);
    if (std::abs(h) <= same) return std::make_shared<Plane>(frame);
    return std::make_shared<ConeSurface>(frame, ra, std::abs(ra - rb) <= same ? ra : rb, h, Rectangle{turn_, {0, 1}});
  }

  SurfacePtr of_arc(const Circle& circle) const {
    const Frame& of = circle.frame();
    const double radius = circle.radius(), major = glm::length(away(of.origin)),
                 same = kSame * (radius + glm::length(of.origin - axis_.through));
    if (!(std::abs(glm::dot(of.z, axis_.along)) <= kSame && std::abs(glm::dot(of.z, away(of.origin))) <= same))
      return nullptr;
    const bool is_sphere = major <= same;
    if (!is_sphere && !(major >= radius)) return nullptr;
    const Interval t = curve_->domain();
    const Vec3 radial = is_sphere ? away(curve_->point(t.middle())) : away(of.origin);
    if (!(glm::length(radial) > same)) return nullptr;
    const Frame frame = frame_from(axis_.through + height(of.origin) * axis_.along, axis_.along, radial);
    // Where the arc begins on the meridian, and which way it runs.
    const double begin = std::atan2(glm::dot(of.x, frame.z), glm::dot(of.x, frame.x)), run = circle.domain().hi;
    const bool upward = glm::dot(glm::cross(frame.x, frame.z), of.z) > 0;
    const Interval v = upward ? Interval(begin, begin + run) : Interval(begin - run, begin);
    if (!is_sphere) return std::make_shared<TorusSurface>(frame, major, radius, Rectangle{turn_, v});
    const Interval half(-0.5 * kPi, 0.5 * kPi);
    const Interval within(half.clamp(v.lo), half.clamp(v.hi));
    if (!(std::abs(within.lo - v.lo) + std::abs(within.hi - v.hi) <= 1e-9)) return nullptr;
    return std::make_shared<SphereSurface>(frame, radius, Rectangle{turn_, within});
  }

  CurvePtr curve_;
  Axis axis_;
  Interval turn_;
};

SurfacePtr form_of(const RevolutionSurface& surface) {
  const Rectangle domain = surface.domain();
  return Meridian(curve_over(surface.curve(), domain.u), surface.axis(), domain.v).surface();
}

SurfacePtr form_of(const ExtrusionSurface& surface) {
  const Rectangle domain = surface.domain();
  const CurvePtr curve = curve_over(surface.curve(), domain.u);
  const double length = glm::length(surface.along());
  const Vec3 along = surface.along() / length;
  if (is_straight(*curve)) {
    const Interval t = curve->domain();
    const Vec3 a = curve->point(t.lo), side = curve->point(t.hi) - a;
    return std::make_shared<Plane>(frame_from(a, glm::cross(side, along), side));
  }
  const auto circle = circle_of(*curve);
  if (!circle || !(glm::length(glm::cross(circle->frame().z, along)) <= kSame)) return nullptr;
  const double run = circle->domain().hi;
  const bool same_way = glm::dot(circle->frame().z, along) > 0;
  return std::make_shared<CylinderSurface>(frame_from(circle->frame().origin, along, circle->frame().x),
                                           circle->radius(), length,
                                           Rectangle{same_way ? Interval(0, run) : Interval(-run, 0), domain.v});
}

// Of a spline whose control points lie in one.
SurfacePtr plane_of(const Surface& surface) {
  if (!surface.bounded()) return nullptr;
  const std::vector<SurfacePiece> pieces = surface.pieces();
  const Rectangle d = surface.domain();
  const Vec3 origin = surface.point(d.u.middle(), d.v.middle());
  const SurfaceJet jet = surface.evaluate(d.u.middle(), d.v.middle(), 1);
  const Vec3 normal = glm::cross(jet.du(), jet.dv());
  const double steep = glm::length(normal);
  if (!(steep > 0)) return nullptr;
  double size = 0, off = 0;
  for (const SurfacePiece& piece : pieces) {
    if (!piece.is_rational()) return nullptr;
    for (const Vec4& p : piece.points) {
      if (!(p.w > 0)) return nullptr;
      const Vec3 from = Vec3(p) / p.w - origin;
      size = std::max(size, glm::length(from)), off = std::max(off, std::abs(glm::dot(from, normal)) / steep);
    }
  }
  return off <= kSame * size ? std::make_shared<Plane>(frame_from(origin, normal, jet.du())) : nullptr;
}

}  // namespace

std::optional<CanonicalSurface> elementary_surface(const SurfacePtr& surface) {
  if (auto known = canonical(surface)) return known;
  if (const auto* moved = dynamic_cast<const TransformedSurface*>(surface.get())) {
    const auto original = elementary_surface(moved->original());
    return original ? canonical(transformed(original->surface, moved->map())) : std::nullopt;
  }
  SurfacePtr form;
  if (const auto* turned = dynamic_cast<const RevolutionSurface*>(surface.get()))
    form = form_of(*turned);
  else if (const auto* extruded = dynamic_cast<const ExtrusionSurface*>(surface.get()))
    form = form_of(*extruded);
  else
    form = plane_of(*surface);
  return form ? canonical(form) : std::nullopt;
}

}  // namespace lekalo::geometry
