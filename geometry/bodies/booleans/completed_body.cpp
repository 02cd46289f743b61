// Elements that are completed by the body that they are added to or taken from (Golovanov 2016, 6.6): profiles extruded
// to the nearest faces, the nearest layer of material removed along a profile, stiffening ribs.
//
//   add     E - B falls into lumps; those that begin at the profile are united with B
//   remove  E and B have lumps in common; the nearest to the profile is taken from B
//
// E is the extrusion of the profile beyond the body. A rib's profile is an open plane curve, closed by a copy of itself
// beyond the body and thickened on both sides of its plane.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "geometry/bodies/booleans/boolean.h"
#include "geometry/bodies/constructions/profile.h"
#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/derived/composite_curve.h"
#include "geometry/describe.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

Body extruded(const Profile& profile, const Vec3& by) {
  SweptParts parts;
  for (const ProfileLoop& loop : profile.loops) {
    SweptLoop swept{{}, profile.is_left(loop)};
    for (const CurvePtr& from : loop.segments) {
      const CurvePtr to = transformed(from, Affine::translation(by));
      const auto rail = std::make_shared<Segment>(from->point(from->domain().lo), to->point(to->domain().lo));
      swept.sides.push_back({std::make_shared<ExtrusionSurface>(from, by), from, to, rail});
    }
    parts.loops.push_back(std::move(swept));
  }
  Frame end = profile.plane;
  end.origin += by;
  parts.ends = {profile.plane, end};
  return swept_body(parts);
}

// The part of a body whose faces a predicate of shells picks.
template <class Picks>
Body shells_of(const Body& body, Picks&& picks) {
  Body result;
  std::vector<int> vertex(body.vertices.size(), -1), edge(body.edges.size(), -1);
  const auto copied_vertex = [&](int v) {
    if (vertex[v] < 0) {
      vertex[v] = static_cast<int>(result.vertices.size());
      result.vertices.push_back(body.vertices[v]);
    }
    return vertex[v];
  };
  const auto copied_edge = [&](int e) {
    if (edge[e] < 0) {
      Edge copy = body.edges[e];
      copy.coedges.clear();
      copy.start = copied_vertex(copy.start);
      copy.end = copied_vertex(copy.end);
      edge[e] = static_cast<int>(result.edges.size());
      result.edges.push_back(std::move(copy));
    }
    return edge[e];
  };
  for (size_t s = 0; s < body.shells.size(); ++s) {
    if (!picks(static_cast<int>(s))) continue;
    const int shell = static_cast<int>(result.shells.size());
    result.shells.push_back({{}, body.shells[s].closed});
    for (const int f : body.shells[s].faces) {
      const Face& of = body.faces[f];
      const int face = result.add_face(of.surface, of.forward, of.origin, of.trimmed);
      result.faces[face].shell = shell;
      result.shells[shell].faces.push_back(face);
      for (const int loop : of.loops) {
        std::vector<Body::Use> uses;
        for (const int c : body.loops[loop].coedges)
          uses.push_back({copied_edge(body.coedges[c].edge), body.coedges[c].forward, body.coedges[c].image});
        result.add_loop(face, uses);
      }
    }
  }
  return result;
}

// The least and largest height of a shell's vertices over a plane.
Interval heights(const Body& body, int shell, const Vec3& through, const Vec3& along) {
  Interval result{kInfinity, -kInfinity};
  for (const int f : body.shells[shell].faces)
    for (const int loop : body.faces[f].loops)
      for (const int c : body.loops[loop].coedges)
        for (const int v : {body.edges[body.coedges[c].edge].start, body.edges[body.coedges[c].edge].end}) {
          const double height = glm::dot(body.vertices[v].point - through, along);
          result = {std::min(result.lo, height), std::max(result.hi, height)};
        }
  return result;
}

// Far enough to pass through the body.
double depth_through(const Body& body, const Vec3& from) {
  const Box3 box = bounds(body);
  return 1.1 * (glm::length(box.center() - from) + box.diameter());
}

Body add_lumps(const Body& body, const Body& tool, const Vec3& through, const Vec3& along, const char* field) {
  const Body outside = boolean(BooleanOperation::subtract, tool, body);
  const double near = 1e-7 * bounds(outside).diameter();
  std::vector<bool> begins;
  for (size_t s = 0; s < outside.shells.size(); ++s)
    begins.push_back(heights(outside, static_cast<int>(s), through, along).lo <= near);
  if (std::all_of(begins.begin(), begins.end(), [](bool one) { return one; }))
    throw FieldError(field, "the profile's extrusion does not end at the body: a part of it passes by",
                     "a profile that the body covers whole, or another direction");
  return boolean(BooleanOperation::unite, body, shells_of(outside, [&](int s) { return begins[s]; }));
}

Body remove_nearest(const Body& body, const Body& tool, const Vec3& through, const Vec3& along) {
  const Body inside = boolean(BooleanOperation::intersect, body, tool);
  int nearest = 0;
  for (size_t s = 1; s < inside.shells.size(); ++s)
    if (heights(inside, static_cast<int>(s), through, along).lo < heights(inside, nearest, through, along).lo)
      nearest = static_cast<int>(s);
  return boolean(BooleanOperation::subtract, body, shells_of(inside, [&](int s) { return s == nearest; }));
}

template <class Work>
BodyPtr worked(const char* field, Work&& work) {
  try {
    return std::make_shared<Body>(work());
  } catch (const FieldError&) {
    throw;
  } catch (const BooleanError& error) {
    throw FieldError(field, error.what(), error.empty ? "a profile and direction that lead to the body" : "");
  } catch (const std::invalid_argument& error) {
    throw FieldError(field, error.what());
  }
}

void name_faces(Body& body, const char* feature) {
  for (Face& face : body.faces) face.origin.feature = feature;
}

Body to_nearest(const Fields& f) {
  const Body& body = *f.body("of");
  if (!body.is_closed()) throw FieldError("of", "this body is not closed: it has no inside");
  const Vec3 along = f.vec3("along");
  Profile profile = read_profile(f, "profile");
  face_along(profile, along, "along");
  const Vec3 through = profile.plane.origin;
  Body tool = extruded(profile, depth_through(body, through) * along);
  name_faces(tool, "extrusion");
  return f.text("mode") == "add" ? add_lumps(body, tool, through, along, "profile")
                                 : remove_nearest(body, tool, through, along);
}

Body ribbed(const Fields& f) {
  const Body& body = *f.body("of");
  if (!body.is_closed()) throw FieldError("of", "this body is not closed: it has no inside");
  const CurvePtr curve = std::any_cast<CurvePtr>(f.any("profile"));
  const Vec3 along = f.vec3("along");
  const Interval t = curve->domain();
  const Vec3 begin = curve->point(t.lo), end = curve->point(t.hi);
  if (curve->is_closed() || glm::length(end - begin) <= 0)
    throw FieldError("profile", "the profile of a rib is an open curve", "for a closed one there is nearest_extrusion");
  const Vec3 across = glm::cross(end - begin, along);
  if (!(glm::length(across) > 1e-9 * glm::length(end - begin)))
    throw FieldError("along", "the rib's direction runs along its profile");
  const Vec3 normal = glm::normalize(across), by = depth_through(body, begin) * along;
  const double thickness = f.number("thickness");
  const std::vector<CurvePtr> sides{curve, std::make_shared<Segment>(end, end + by),
                                    std::make_shared<Segment>(end + by, begin + by),
                                    std::make_shared<Segment>(begin + by, begin)};
  const CurvePtr outline = std::make_shared<CompositeCurve>(sides, true, 1e-9);
  const CurvePtr shifted = transformed(outline, Affine::translation(-0.5 * thickness * normal));
  Profile profile = profile_of({shifted}, "profile");
  face_along(profile, normal, "along");
  Body tool = extruded(profile, thickness * normal);
  name_faces(tool, "rib");
  const Body outside = boolean(BooleanOperation::subtract, tool, body);
  // Lumps that have a vertex at the profile's height nearest to it.
  const double near = 1e-7 * bounds(outside).diameter();
  double first = kInfinity;
  for (size_t s = 0; s < outside.shells.size(); ++s)
    first = std::min(first, heights(outside, static_cast<int>(s), begin, along).lo);
  std::vector<bool> begins;
  for (size_t s = 0; s < outside.shells.size(); ++s)
    begins.push_back(heights(outside, static_cast<int>(s), begin, along).lo <= first + near);
  if (std::all_of(begins.begin(), begins.end(), [](bool one) { return one; }))
    throw FieldError("profile", "the rib does not end at the body: a part of it passes by",
                     "let both ends of the profile lie on the body or in it");
  return boolean(BooleanOperation::unite, body, shells_of(outside, [&](int s) { return begins[s]; }));
}

}  // namespace

TypeDeclaration nearest_extrusion_type() {
  return declare(Category::body, "nearest_extrusion",
                 "A body with a profile extruded to its nearest faces, or without the nearest layer of its material "
                 "along a profile. Faces: those of the body, and extrusion.side.k, extrusion.start.")
      .example(
          "of: { type: box, size: [4, 4, 1] }, profile: { type: circle, center: [2, 2, 3], radius: 0.8 }, along: -z")
      .field("of", reference({Category::body}), "a closed body")
      .field("profile", references({Category::curve}),
             "a closed plane curve beside the body, with further ones inside of it as holes")
      .field("along", direction(), "from the profile to the body")
      .field("mode", choice({"add", "remove"}), "whether material is added up to the body or taken from it", "add")
      .built_by([](const Fields& f) -> BodyPtr { return worked("profile", [&] { return to_nearest(f); }); });
}

TypeDeclaration rib_type() {
  return declare(Category::body, "rib",
                 "A body with a stiffening rib: what a plane open curve leaves between itself and the body, with a "
                 "thickness. Faces: those of the body, and rib.start, rib.end, rib.side.k.")
      .example(
          "of: { type: union, of: [{ type: box, size: [4, 3, 0.4] }, { type: box, size: [0.4, 3, 3] }] }, profile: { "
          "type: segment, from: [3.2, 1, 0.4], to: [0.4, 1, 2.4] }, along: [-1, 0, -1], thickness: 0.3")
      .field("of", reference({Category::body}), "a closed body")
      .field("profile", reference({Category::curve}), "an open plane curve that ends on the body or in it")
      .field("along", direction(), "in the plane of the curve, from it into the body")
      .field("thickness", length().positive(), "half of it on each side of the curve's plane")
      .built_by([](const Fields& f) -> BodyPtr { return worked("profile", [&] { return ribbed(f); }); });
}

}  // namespace lekalo::geometry
