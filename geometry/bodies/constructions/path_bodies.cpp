// Bodies that a profile makes as it moves along a curve (Golovanov 2016, 5.7): parallel to itself, with side faces
// c_i(u) + g(v) - g(v_min); or with a frame that turns with the curve, g(v) + M(v) (c_i(u) - g(v_min)).
#include <fmt/format.h>

#include <cmath>

#include "geometry/bodies/constructions/farthest_point.h"
#include "geometry/bodies/constructions/profile_offset.h"
#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/curves/operations/smooth_pieces.h"
#include "geometry/surfaces/nets/lofts.h"
#include "geometry/surfaces/swept/sweep.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

constexpr int kTried = 256;  // places of a path that are looked at

double at_share(const Interval& range, int k) { return range.clamp(range.lo + range.width() * k / kTried); }

// Where two pieces of the path meet their tangents agree.
void check_smooth(const Curve& path) {
  if (!(path.domain().width() < kInfinity)) throw FieldError("path", "the path is unbounded", "give it a domain");
  const std::vector<CurvePiece> pieces = path.pieces();
  for (size_t i = 0; i + 1 < pieces.size(); ++i) {
    const double t = pieces[i].domain.hi;
    const Vec3 before = evaluate_within(path, pieces[i].domain, t, 1).d[1], after = path.evaluate(t, 1).d[1];
    const Vec3 p = path.point(t);
    if (glm::length(glm::normalize(before) - glm::normalize(after)) > 1e-6)
      throw FieldError("path",
                       fmt::format("the path has a corner at ({:.6g}, {:.6g}, {:.6g}), t = {:.6g}", p.x, p.y, p.z, t),
                       "round it, or make a body of each part");
  }
}

// Everywhere across the plane of the profile, the same way.
void check_monotone(const Curve& path, const Vec3& normal) {
  for (int k = 0; k <= kTried; ++k) {
    const double t = at_share(path.domain(), k);
    const Vec3 tangent = path.evaluate(t, 1).d[1];
    if (!(glm::dot(tangent, normal) > 1e-9 * glm::length(tangent)))
      throw FieldError("along",
                       fmt::format("the curve turns back, or runs in the plane of the profile, at t = {:.6g}", t),
                       "a curve that goes to one side of that plane everywhere, or a sweep_body");
  }
}

Body translated(const Fields& f) {
  const CurvePtr g = f.curve("along");
  if (!(g->domain().width() < kInfinity)) throw FieldError("along", "the curve is unbounded", "give it a domain");
  const Vec3 origin = g->point(g->domain().lo), whole = g->point(g->domain().hi) - origin;
  if (g->is_closed())
    throw FieldError("along", "the curve is closed: a profile moved parallel to itself comes back through the body",
                     "an open curve, or a sweep_body");
  Profile profile = read_thick_profile(f, "of", whole);
  face_along(profile, whole, "along");
  check_monotone(*g, profile.plane.z);
  SweptParts parts;
  for (const ProfileLoop& loop : profile.loops) {
    SweptLoop swept{{}, profile.is_left(loop)};
    for (const CurvePtr& c : loop.segments) {
      const Vec3 begin = c->point(c->domain().lo);
      swept.sides.push_back({translation_surface(c, g), c, transformed(c, Affine::translation(whole)),
                             transformed(g, Affine::translation(begin - origin))});
    }
    parts.loops.push_back(std::move(swept));
  }
  Frame end = profile.plane;
  end.origin += whole;
  parts.ends = {profile.plane, end};
  return swept_body(parts);
}

// The profile lies nowhere beyond the center of curvature: there the body would run through itself.
void check_curvature(const SectionMotion& motion, const Profile& profile, const char* field) {
  const Curve& path = *motion.path();
  for (int k = 0; k <= kTried; ++k) {
    const double v = at_share(path.domain(), k);
    const CurveJet g = path.evaluate(v, 2);
    const double speed = glm::length(g.d[1]);
    const Vec3 tangent = g.d[1] / speed;
    const Vec3 curvature = (g.d[2] - glm::dot(g.d[2], tangent) * tangent) / (speed * speed);
    const Affine placement = motion.placement(v);
    const Vec3 in_profile(glm::dot(placement.direction({1, 0, 0}), curvature),
                          glm::dot(placement.direction({0, 1, 0}), curvature),
                          glm::dot(placement.direction({0, 0, 1}), curvature));
    for (const CurvePtr& segment : profile.loops.front().segments) {
      const double towards = glm::dot(farthest_point(*segment, in_profile), in_profile);
      if (towards >= 1)
        throw FieldError(
            field,
            fmt::format(
                "the body would run through itself at s = {:.6g}: the profile reaches {:.6g} towards the center of "
                "curvature, which is {:.6g} away",
                v, towards / glm::length(curvature), 1 / glm::length(curvature)),
            "a smaller profile, or a path that is curved less");
    }
  }
}

Body carried(const SectionMotion& motion, Profile profile, const char* field) {
  try {
    face_along(profile, {0, 0, 1}, field);
  } catch (const FieldError&) {
    throw FieldError(field, "the profile does not lie in the plane x, y, which the frame carries along the path",
                     "a profile in that plane; or placed: true, for one that stands where the path begins, across it");
  }
  check_curvature(motion, profile, field);
  const bool closed = motion.path()->is_closed();
  const Affine begin = motion.placement(0), end = motion.placement(1);
  SweptParts parts;
  for (const ProfileLoop& loop : profile.loops) {
    SweptLoop swept{{}, profile.is_left(loop)};
    for (const CurvePtr& c : loop.segments) {
      const SurfacePtr side = motion.surface({c}, {0});
      if (closed && !(side->periods().v > 0))
        throw FieldError("path", "the body does not close where the path does",
                         "laws (twist, scale) that end as they begin, and a path without a corner there");
      swept.sides.push_back({side, transformed(c, begin), transformed(c, end),
                             std::make_shared<ParameterLine>(side, IsoDirection::u, side->domain().u.lo)});
    }
    parts.loops.push_back(std::move(swept));
  }
  if (!closed) {
    const auto placed = [&](const Affine& a) {
      const Frame& p = profile.plane;
      const Vec3 x = a.direction(p.x), y = a.direction(p.y);
      return frame_from(a.point(p.origin), glm::cross(x, y), x);
    };
    parts.ends = {placed(begin), placed(end)};
  }
  return swept_body(parts);
}

Profile in_frame(const Profile& profile, const Frame& frame) {
  const Mat3 linear = glm::transpose(Mat3(frame.x, frame.y, frame.z));
  const Affine map{linear, -(linear * frame.origin)};
  Profile result = profile;
  result.plane = {map.point(profile.plane.origin), map.direction(profile.plane.x), map.direction(profile.plane.y),
                  map.direction(profile.plane.z)};
  for (ProfileLoop& loop : result.loops) {
    loop.area = map.direction(loop.area);
    for (CurvePtr& segment : loop.segments) segment = transformed(segment, map);
  }
  return result;
}

Body swept_along(const Fields& f) {
  check_smooth(*f.curve("path"));
  const SectionMotion motion(f);
  Profile profile = read_thick_profile(f, "of", f.boolean("placed") ? motion.frame(0).z : Vec3(0, 0, 1));
  if (f.boolean("placed")) profile = in_frame(profile, motion.frame(0));
  return carried(motion, std::move(profile), "of");
}

Body pipe(const Fields& f) {
  const double radius = f.number("radius");
  std::vector<CurvePtr> circles{std::make_shared<Circle>(Frame{}, radius)};
  if (f.has("wall")) {
    if (!(f.number("wall") < radius))
      throw FieldError("wall", "the wall is as thick as the pipe: nothing is left open in it",
                       fmt::format("less than the radius, {:.6g}, or none at all for a rod", radius));
    circles.push_back(std::make_shared<Circle>(Frame{}, radius - f.number("wall")));
  }
  check_smooth(*f.curve("path"));
  return carried(SectionMotion(f), profile_of(circles, "radius"), "radius");
}

}  // namespace

TypeDeclaration translation_body_type() {
  TypeDeclaration type =
      declare(Category::body, "translation_body",
              "What a plane profile fills as it is moved parallel to itself along a curve. Faces: start, end, and "
              "side.k for segment k of the profile.")
          .example(
              "of: { type: circle, radius: 0.5 }, along: { type: bezier_curve, points: [[0, 0, 0], [0, 0, 2], [3, 0, "
              "2], [3, 0, 4]] }")
          .field("of", references({Category::curve}),
                 "a closed plane curve, with further ones inside of it as holes; corners make edges")
          .field("along", reference({Category::curve}),
                 "the curve along which, from its beginning on; it goes to one side of the profile's plane everywhere");
  declare_thickness(type);
  type.built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(translated(f)); });
  return type;
}

TypeDeclaration sweep_body_type() {
  TypeDeclaration type =
      declare(Category::body, "sweep_body",
              "What a plane profile fills as a frame carries it along a path; the profile lies in the plane x, y as of "
              "sweep_surface. Faces: side.k for segment k of the profile, and start and end where the path is open.")
          .example(
              "path: { type: bezier_curve, points: [[0, 0, 0], [0, 0, 3], [3, 0, 3]] }, of: { type: rectangle, size: "
              "[1, 0.6] }")
          .field("of", references({Category::curve}),
                 "a closed plane curve, with further ones inside of it as holes; corners make edges")
          .field("path", reference({Category::curve}), "the curve along which; smooth");
  declare_motion(type);
  type.field("placed", boolean(), "the profile stands in space as it is at the path's beginning", "false");
  declare_thickness(type);
  type.built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(swept_along(f)); });
  return type;
}

TypeDeclaration pipe_type() {
  TypeDeclaration type =
      declare(Category::body, "pipe",
              "Round pipe, or rod, along a path. Faces: side (side.0 outside, side.1 inside), and start and end where "
              "the path is open.")
          .example("path: { type: bezier_curve, points: [[0, 0, 0], [0, 0, 3], [3, 0, 3]] }, radius: 0.5, wall: 0.1")
          .field("path", reference({Category::curve}), "the center line; smooth")
          .field("radius", length().positive(), "outside")
          .optional("wall", length().positive(), "thickness of the wall; without it the pipe is solid");
  declare_motion(type);
  type.built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(pipe(f)); });
  return type;
}

}  // namespace lekalo::geometry
