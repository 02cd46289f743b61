// Revolution of a profile about an axis of its plane (Golovanov 2016, 5.7). Seen against the motion at the start the
// region lies to the left of an outline that runs counterclockwise. Of an open profile the ends are joined to the axis
// by perpendiculars, and along it. Ends of segments on the axis are poles; what lies on it makes no face, and an edge
// of both end faces where the turn is not whole.
#include <fmt/format.h>

#include <cmath>

#include "geometry/bodies/constructions/farthest_point.h"
#include "geometry/bodies/constructions/profile_offset.h"
#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/derived/composite_curve.h"
#include "geometry/surfaces/swept/revolution.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// Relative to the size: nearer to the axis is on it.
constexpr double kOnAxis = 1e-11;

Vec3 foot_on(const Axis& axis, const Vec3& p) {
  return axis.through + glm::dot(p - axis.through, axis.along) * axis.along;
}

// An open profile with its perpendiculars to the axis and the part of the axis between them.
CurvePtr closed_to(const Axis& axis, const CurvePtr& open) {
  const double size = bounds(*open).diameter();
  std::vector<CurvePtr> segments = smooth_segments(open);
  const Vec3 begin = open->point(open->domain().lo), end = open->point(open->domain().hi);
  Vec3 at = end;
  const auto line_to = [&](const Vec3& p) {
    if (glm::length(p - at) <= kOnAxis * size) return;
    segments.push_back(std::make_shared<Segment>(at, p));
    at = p;
  };
  line_to(foot_on(axis, end));
  line_to(foot_on(axis, begin));
  line_to(begin);
  return std::make_shared<CompositeCurve>(std::move(segments), true, 1e-9);
}

Profile read(const Fields& f, const Axis& axis, const Vec3& motion) {
  if (f.has("thickness")) return read_thick_profile(f, "of", motion);
  std::vector<CurvePtr> curves;
  for (const std::any& one : f.references("of")) {
    CurvePtr curve = std::any_cast<CurvePtr>(one);
    if (curves.empty() && curve->domain().width() < kInfinity && !curve->is_closed()) curve = closed_to(axis, curve);
    curves.push_back(std::move(curve));
  }
  return profile_of(curves, "of");
}

class Revolving {
 public:
  Revolving(const Fields& f) : axis_(f.axis("axis")), angle_(f.number("angle")) {
    const Vec3 some = std::any_cast<CurvePtr>(f.references("of").front())
                          ->point(std::any_cast<CurvePtr>(f.references("of").front())->domain().lo);
    profile_ = read(f, axis_, glm::cross(axis_.along, some - axis_.through));
    find_side();
  }

  Body build() {
    SweptParts parts;
    const bool whole = angle_ >= kTwoPi - 1e-14;
    for (const ProfileLoop& loop : profile_.loops) parts.loops.push_back(turned(loop));
    if (!whole) {
      const Affine turn = Affine::rotation(angle_, axis_.along, axis_.through);
      const Frame& p = profile_.plane;
      parts.ends = {p, Frame{turn.point(p.origin), turn.direction(p.x), turn.direction(p.y), turn.direction(p.z)}};
    }
    return swept_body(parts);
  }

 private:
  // On which side of the axis, in the plane, the profile lies: then z of the plane is where it moves to.
  void find_side() {
    Vec3& z = profile_.plane.z;
    size_ = 0;
    double lo = 0, hi = 0;
    Vec3 worst_lo(0), worst_hi(0);
    const Vec3 radial = glm::cross(axis_.along, z);
    for (const Vec3& p : profile_.samples()) size_ = std::max(size_, glm::length(p - axis_.through));
    if (std::abs(glm::dot(axis_.along, z)) > 1e-9 ||
        std::abs(glm::dot(profile_.plane.origin - axis_.through, z)) > 1e-9 * size_)
      throw FieldError("axis", "the axis does not lie in the plane of the profile",
                       "an axis through that plane's points");
    for (const CurvePtr& segment : profile_.loops.front().segments)
      for (const Vec3& p : {farthest_point(*segment, radial), farthest_point(*segment, -radial)}) {
        const double x = glm::dot(p - axis_.through, radial);
        if (x < lo) lo = x, worst_lo = p;
        if (x > hi) hi = x, worst_hi = p;
      }
    if (hi > 1e-9 * size_ && lo < -1e-9 * size_) {
      const Vec3 p = hi > -lo ? worst_lo : worst_hi;
      throw FieldError("axis",
                       fmt::format("the profile crosses the axis: ({:.6g}, {:.6g}, {:.6g}) is {:.6g} beyond it", p.x,
                                   p.y, p.z, std::min(hi, -lo)),
                       "a profile lies on one side of its axis");
    }
    // along x (the side) = motion: for x > 0 that is along x radial = along x (along x z) = -z.
    if (hi > -lo) profile_.plane = {profile_.plane.origin, profile_.plane.y, profile_.plane.x, -z};
  }

  double distance(const Vec3& p) const { return glm::length(p - foot_on(axis_, p)); }
  bool on_axis(const Vec3& p) const { return distance(p) <= kOnAxis * size_; }
  bool lies_on_axis(const Curve& c) const {
    for (int k = 0; k <= 8; ++k)
      if (!on_axis(c.point(c.domain().lo + c.domain().width() * k / 8))) return false;
    return true;
  }

  SweptLoop turned(const ProfileLoop& loop) const {
    SweptLoop result{{}, profile_.is_left(loop)};
    const Affine turn = Affine::rotation(angle_, axis_.along, axis_.through);
    std::vector<bool> resting;
    for (const CurvePtr& segment : loop.segments) resting.push_back(lies_on_axis(*segment));
    const size_t count = loop.segments.size();
    for (size_t i = 0; i < count; ++i) {
      const CurvePtr& c = loop.segments[i];
      const Vec3 begin = c->point(c->domain().lo);
      check_touch(*c, begin, resting[i] || resting[(i + count - 1) % count]);
      SweptSide side;
      side.start = c;
      side.end = resting[i] ? c : transformed(c, turn);
      if (!resting[i]) side.surface = std::make_shared<RevolutionSurface>(c, axis_, angle_);
      if (!on_axis(begin)) side.rail = rail_from(begin);
      result.sides.push_back(std::move(side));
    }
    return result;
  }

  CurvePtr rail_from(const Vec3& p) const {
    const Vec3 center = foot_on(axis_, p);
    return std::make_shared<Circle>(frame_from(center, axis_.along, p - center), distance(p), Interval(0, angle_));
  }

  void check_touch(const Curve& c, const Vec3& begin, bool beside_axis) const {
    if (on_axis(begin) && !beside_axis)
      throw FieldError("of",
                       fmt::format("the profile touches the axis in the one point ({:.6g}, {:.6g}, {:.6g})", begin.x,
                                   begin.y, begin.z),
                       "keep it off the axis, or let a segment of it run along the axis");
    if (lies_on_axis(c)) return;
    for (int k = 1; k < 64; ++k) {
      const Vec3 p = c.point(c.domain().lo + c.domain().width() * k / 64);
      if (on_axis(p))
        throw FieldError("of", fmt::format("the profile touches the axis at ({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z),
                         "keep it off the axis, or let a segment of it run along the axis");
    }
  }

  Axis axis_;
  double angle_;
  Profile profile_;
  double size_ = 0;
};

}  // namespace

TypeDeclaration revolution_body_type() {
  TypeDeclaration type =
      declare(Category::body, "revolution_body",
              "What a plane profile fills as it is turned about an axis of its plane. An open profile is closed by "
              "perpendiculars to the axis. Faces: side.k for segment k of the profile, and start and end where the "
              "turn is not whole.")
          .example("of: { type: rectangle, size: [1, 1], center: [2.5, 0] }, axis: y")
          .field("of", references({Category::curve}),
                 "a closed plane curve beside the axis, with further ones inside of it as holes; or one open curve")
          .field("axis", axis(), "the axis of rotation, by the right-hand rule", "z")
          .field("angle", angle().positive().at_most(kTwoPi), "how far the profile is turned", "360");
  declare_thickness(type);
  type.built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(Revolving(f).build()); });
  return type;
}

}  // namespace lekalo::geometry
