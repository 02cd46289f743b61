// Extrusion of a profile along a vector (Golovanov 2016, 5.7): side faces c_i(u) + v d. With a draft they are ruled
// between the profile and its offset by h tan(delta) towards the inside of the material, moved by d; h is the height of
// d over the plane.
#include <fmt/format.h>

#include <cmath>

#include "geometry/bodies/constructions/profile_offset.h"
#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/derived/composite_curve.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/nets/lofts.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

std::vector<CurvePtr> moved(const std::vector<CurvePtr>& curves, const Vec3& by) {
  std::vector<CurvePtr> result;
  for (const CurvePtr& curve : curves) result.push_back(transformed(curve, Affine::translation(by)));
  return result;
}

// Between a segment of the profile and its offset; arcs about one axis make a cone with the arcs' parameter.
SurfacePtr drafted_side(const CurvePtr& from, const CurvePtr& to) {
  constexpr int kPlaces = 12;
  constexpr double kSame = 1e-13;
  const auto* arc = dynamic_cast<const Circle*>(from.get());
  if (!arc) return ruled_surface(from, to);
  const Frame& frame = arc->frame();
  const Interval t = arc->domain();
  const Vec3 begin = to->point(t.lo) - frame.origin;
  const double height = glm::dot(begin, frame.z), radius = glm::length(begin - height * frame.z);
  const double size = arc->radius() + glm::length(begin) + glm::length(frame.origin);
  for (int k = 0; k <= kPlaces; ++k) {
    const double at = t.lo + t.width() * k / kPlaces;
    const Vec3 expected = frame.point({radius * std::cos(at), radius * std::sin(at), height});
    if (!(glm::length(to->point(at) - expected) <= kSame * size)) return ruled_surface(from, to);
  }
  return std::make_shared<ConeSurface>(frame, arc->radius(), radius, height, Rectangle{t, {0, 1}});
}

// The profile at the end of the vector is one too: offsets may have run into each other.
void check_end(const Profile& profile, const std::vector<std::vector<CurvePtr>>& ends) {
  std::vector<CurvePtr> curves;
  for (const auto& segments : ends) curves.push_back(std::make_shared<CompositeCurve>(segments, true, 1e-9));
  const char* hint = "a smaller draft, or a shorter vector";
  Profile found;
  try {
    found = profile_of(curves, "draft");
  } catch (const FieldError& error) {
    throw FieldError("draft", std::string("at the end of the vector there is no profile: ") + error.what(), hint);
  }
  // The outline is still around its holes, and no loop has turned over.
  bool is_left = found.loops[0].source == 0;
  for (const ProfileLoop& loop : found.loops)
    is_left = is_left && glm::dot(loop.area, profile.loops[loop.source].area) > 0;
  if (!is_left) throw FieldError("draft", "nothing is left of the profile before the end of the vector", hint);
}

// The profile is the operand, and what textbooks call the section.
const char* profile_field(const Fields& f) {
  if (f.has("of") && f.has("section")) throw FieldError("section", "'of' and 'section' are the same", "leave one out");
  if (!f.has("of") && !f.has("section")) throw FieldError("of", "the profile is missing", "of: a closed plane curve");
  return f.has("of") ? "of" : "section";
}

Body extruded(const Fields& f) {
  const Vec3 d = f.vec3("along");
  if (!(glm::length(d) > 0)) throw FieldError("along", "the vector of an extrusion must not be zero");
  Profile profile = read_thick_profile(f, profile_field(f), d);
  face_along(profile, d, "along");
  const double back = f.number("back"), draft = f.number("draft");
  const Vec3 first = -back * glm::normalize(d), whole = d - first;
  if (draft != 0 && back != 0)
    throw FieldError("back", "a body with a draft is extruded one way", "make two bodies, one of each way");
  const double inward = std::tan(draft) * glm::dot(whole, profile.plane.z);
  std::vector<std::vector<CurvePtr>> ends;
  SweptParts parts;
  for (const ProfileLoop& loop : profile.loops) {
    const bool left = profile.is_left(loop);
    const std::vector<CurvePtr> start = moved(loop.segments, first);
    ends.push_back(moved(mitred_offset(start, profile.plane.z, left ? inward : -inward, true, "draft"), whole));
    SweptLoop swept{{}, left};
    for (size_t i = 0; i < start.size(); ++i) {
      const CurvePtr &from = start[i], &to = ends.back()[i];
      SurfacePtr side;
      if (draft == 0)
        side = std::make_shared<ExtrusionSurface>(from, whole);
      else
        side = drafted_side(from, to);
      const auto rail = std::make_shared<Segment>(from->point(from->domain().lo), to->point(to->domain().lo));
      swept.sides.push_back({std::move(side), from, to, rail});
    }
    parts.loops.push_back(std::move(swept));
  }
  if (draft != 0) check_end(profile, ends);
  Frame start = profile.plane;
  start.origin += first;
  Frame end = start;
  end.origin += whole;
  parts.ends = {start, end};
  return swept_body(parts);
}

}  // namespace

TypeDeclaration extrusion_body_type() {
  TypeDeclaration type =
      declare(
          Category::body, "extrusion_body",
          "What a plane profile fills as it is moved along a vector. Faces: start, end, and side.k for segment k of "
          "the profile, those of its holes after those of the outline.")
          .example("of: { type: rectangle, size: [3, 2] }, along: [0, 0, 1]")
          .optional("of", references({Category::curve}),
                    "a closed plane curve, with further ones inside of it as holes; corners make edges")
          .optional("section", references({Category::curve}), "the same by another name")
          .field("along", vector(), "the vector, not in the plane of the profile")
          .field("back", length().non_negative(), "how far the body reaches the other way too, along the vector", "0")
          .field("draft", angle().between(-1.5, 1.5),
                 "angle by which the sides lean towards the material; negative: the body widens", "0");
  declare_thickness(type);
  type.built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(extruded(f)); });
  return type;
}

}  // namespace lekalo::geometry
