// Faces of a body moved, set off or leant while their neighbours follow (Golovanov 2016, 6.12). The draft of a plane
// with the outward normal m turns it about its trace in the neutral plane,
//
//   m' = cos(a) (m - (m.d) d)/|m - (m.d) d| + sin(a) d
//
// a cylinder along d becomes a cone with R(z) = R_0 - (z - z_0) tan(a) where the material lies inside, a cone another.
#include <fmt/format.h>

#include <cmath>

#include "geometry/bodies/local/edge_curve.h"
#include "geometry/bodies/local/face_replacement.h"
#include "geometry/bodies/local/plane_fillets.h"
#include "geometry/bodies/topology/entity_names.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// An error tells of fillets that meet others in a corner, which would have to change with them.
Body with_faces_on(const Body& body, const std::vector<SurfacePtr>& surfaces, const char* field, const char* hint) {
  try {
    FaceReplacement made = replace_faces(body, surfaces, field);
    check_replacement(made, field, hint);
    return std::move(made.body);
  } catch (const FieldError& error) {
    for (const PlaneFillet& fillet : plane_fillets(body))
      if (surfaces[fillet.face] != body.faces[fillet.face].surface && ends_in_corner(body, fillet))
        throw FieldError(field, error.what(),
                         fmt::format("the fillet {} meets others in a corner, which does not follow: change the body "
                                     "before it is filleted",
                                     name_of_face(body, fillet.face)));
    throw;
  }
}

Body moved(const Fields& f) {
  const Body& body = *f.body("of");
  if (f.has("by") == f.has("distance"))
    throw FieldError("by", "faces are moved by a transformation, or each along its normals by a distance",
                     "give one of 'by' and 'distance'");
  const char* field = f.has("by") ? "by" : "distance";
  std::vector<SurfacePtr> surfaces = surfaces_of(body);
  for (const int k : faces_named(body, f, "faces")) {
    const Face& face = body.faces[k];
    const double side = outward_side(face);
    surfaces[k] = f.has("by") ? moved_support(unwrapped(face.surface), f.transform("by"))
                              : offset_support(face.surface, side * f.number("distance"), field);
  }
  let_fillets_follow(body, surfaces, field);
  return with_faces_on(body, surfaces, field, "move them by less");
}

struct Draft {
  Vec3 direction, origin;
  double angle;

  SurfacePtr plane(const Frame& frame, double side, const std::string& name) const {
    const Vec3 m = side * frame.z, across = m - glm::dot(m, direction) * direction;
    if (!(glm::length(across) > 1e-9))
      throw FieldError("faces", fmt::format("the face {} lies across the direction", name), "faces beside it");
    const Vec3 leant = std::cos(angle) * glm::normalize(across) + std::sin(angle) * direction;
    // A point of the trace: in both planes, nearest to the frame's origin.
    const Vec3 in_plane = glm::normalize(direction - glm::dot(direction, m) * m);
    const Vec3 on =
        frame.origin + glm::dot(origin - frame.origin, direction) / glm::dot(in_plane, direction) * in_plane;
    return std::make_shared<Plane>(frame_from(on, side * leant, glm::cross(direction, leant)));
  }

  // The meridian of a surface of revolution about d: `radius` at the neutral plane and how much it grows along d.
  SurfacePtr cone(const ConeSurface& cone, double side, const std::string& name) const {
    const Frame& frame = cone.frame();
    const double up = glm::dot(frame.z, direction);
    if (!(std::abs(std::abs(up) - 1) < 1e-12))
      throw FieldError("faces", fmt::format("the axis of the face {} does not run along the direction", name),
                       "a plane face, or a cylinder or cone along it");
    const double h = cone.height(), w = cone.top_radius() - cone.radius();
    const double outward = side * (h > 0 ? 1 : -1);  // +1: the material lies inside
    // v of the neutral plane, and the radius there.
    const double neutral = glm::dot(origin - frame.origin, frame.z) / h;
    const double radius = cone.radius() + w * neutral;
    const double growth = -std::tan(angle) * outward * up * h;  // for v from 0 to 1
    const double base = radius - neutral * growth;
    if (growth == 0) return std::make_shared<CylinderSurface>(frame, radius, h, cone.domain());
    return std::make_shared<ConeSurface>(frame, base, base + growth, h, cone.domain());
  }

  // The straight meridian of a surface of revolution likewise; null where it is not straight.
  SurfacePtr revolution(const RevolutionSurface& r, double side, const std::string& name) const {
    const Interval t = r.curve()->domain();
    const Vec3 a = r.curve()->point(t.lo), b = r.curve()->point(t.hi);
    for (const double f : {0.25, 0.5, 0.75})
      if (glm::length(r.curve()->point(t.lo + f * t.width()) - (a + f * (b - a))) > 1e-13 * glm::length(b - a))
        return nullptr;
    const Axis axis = r.axis();
    if (!(std::abs(std::abs(glm::dot(axis.along, direction)) - 1) < 1e-12))
      throw FieldError("faces", fmt::format("the axis of the face {} does not run along the direction", name),
                       "a plane face, or a cylinder or cone along it");
    const auto height = [&](const Vec3& p) { return glm::dot(p - origin, direction); };
    const Vec3 foot = axis.through + glm::dot(a - axis.through, axis.along) * axis.along;
    const Vec3 radial =
        glm::normalize(glm::length(a - foot) > 0 ? a - foot : b - foot - glm::dot(b - foot, axis.along) * axis.along);
    const auto radius = [&](const Vec3& p) { return glm::dot(p - axis.through, radial); };
    const double slope = (radius(b) - radius(a)) / (height(b) - height(a));
    const double at_neutral = radius(a) - slope * height(a);
    const SurfaceJet s = r.evaluate(t.middle(), r.domain().v.lo, 1);
    const Affine turn = Affine::rotation(r.domain().v.lo, axis.along, axis.through);
    const double outward = side * glm::dot(glm::cross(s.du(), s.dv()), turn.direction(radial)) > 0 ? 1 : -1;
    const auto moved = [&](const Vec3& p) {
      return p + (at_neutral - outward * std::tan(angle) * height(p) - radius(p)) * radial;
    };
    const CurvePtr line = std::make_shared<Segment>(moved(a), moved(b));
    return std::make_shared<RevolutionSurface>(t == line->domain() ? line : with_domain(line, t), axis, r.domain());
  }
};

// The extrusion of a circle along its axis as the cylinder that has its parameters; null for another surface.
std::shared_ptr<const ConeSurface> cylinder_of(const Surface& surface) {
  const auto* e = dynamic_cast<const ExtrusionSurface*>(&surface);
  if (!e) return nullptr;
  const auto circle = even_circle(*e->curve(), bounds(*e->curve()).diameter());
  const Interval t = e->curve()->domain();
  if (!circle || std::abs(circle->domain().width() - t.width()) > 1e-12) return nullptr;
  const double height = glm::dot(e->along(), circle->frame().z);
  if (glm::length(e->along() - height * circle->frame().z) > 1e-12 * std::abs(height)) return nullptr;
  // Its angles begin at 0 where the curve does.
  const Affine turn = Affine::rotation(-t.lo, circle->frame().z);
  const Frame frame = frame_from(circle->frame().origin, circle->frame().z, turn.direction(circle->frame().x));
  return std::make_shared<CylinderSurface>(frame, circle->radius(), height, e->domain());
}

bool has_pole(const Body& body, int face) {
  for (const int l : body.faces[face].loops)
    for (const int c : body.loops[l].coedges)
      if (body.edges[body.coedges[c].edge].kind == EdgeKind::pole) return true;
  return false;
}

Body leant(const Fields& f) {
  const Body& body = *f.body("of");
  const Vec3 d = f.has("direction") ? f.vec3("direction") : f.frame("neutral").z;
  const Draft draft{d, f.frame("neutral").origin, f.number("angle")};
  if (!(std::abs(glm::dot(d, f.frame("neutral").z)) > 1e-9))
    throw FieldError("direction", "the direction lies in the neutral plane", "one across it");
  std::vector<SurfacePtr> surfaces = surfaces_of(body);
  for (const int k : faces_named(body, f, "faces")) {
    const Face& face = body.faces[k];
    const std::string name = name_of_face(body, k);
    const double side = outward_side(face);
    if (!plane_of(face.surface) && has_pole(body, k))
      throw FieldError("faces", fmt::format("the face {} runs to a point, which cannot stay where it leans", name),
                       "a face without an apex");
    const SurfacePtr plain = unwrapped(face.surface);
    std::shared_ptr<Surface> made;
    if (const auto frame = plane_of(face.surface))
      made = std::const_pointer_cast<Surface>(draft.plane(*frame, side, name));
    else if (const auto* cone = dynamic_cast<const ConeSurface*>(plain.get()))
      made = std::const_pointer_cast<Surface>(draft.cone(*cone, side, name));
    else if (const auto cylinder = cylinder_of(*plain))
      made = std::const_pointer_cast<Surface>(draft.cone(*cylinder, side, name));
    else if (const auto* r = dynamic_cast<const RevolutionSurface*>(plain.get()))
      made = std::const_pointer_cast<Surface>(draft.revolution(*r, side, name));
    if (!made)
      throw FieldError("faces", fmt::format("the face {} is neither plane, nor a cylinder or a cone", name),
                       "leave it out");
    made->set_reversed(face.surface->reversed());
    surfaces[k] = made;
  }
  return with_faces_on(body, surfaces, "angle", "a smaller angle");
}

}  // namespace

TypeDeclaration moved_faces_type() {
  return declare(Category::body, "moved_faces",
                 "A body some of whose faces are moved, by a transformation or along their normals, while the others "
                 "stay on their surfaces and follow: they grow and shrink. Fillets between planes go along, but for "
                 "those that meet another in a corner.")
      .example("of: { type: box, size: [3, 2, 1] }, faces: z_max, distance: 0.5")
      .field("of", reference({Category::body}), "the body; closed")
      .field("faces", texts().count(1), "names or numbers of the faces, as 'lekalo measure --topology' gives them")
      .optional("by", transform(), "what moves them: steps as of 'transform'")
      .optional("distance", length(),
                "in place of it: how far each goes along its outward normal; a hole gets wider by a negative one")
      .built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(moved(f)); });
}

TypeDeclaration drafted_faces_type() {
  return declare(Category::body, "drafted_faces",
                 "A body some of whose faces lean: plane ones turn about the line in which they meet the neutral "
                 "plane, cylinders and cones cut off before their apex become cones with the same circle in it. The "
                 "neighbours follow.")
      .example("of: { type: box, size: [3, 2, 1] }, faces: [x_min, x_max, y_min, y_max], angle: 10")
      .field("of", reference({Category::body}), "the body; closed")
      .field("faces", texts().count(1), "names or numbers of the faces, as 'lekalo measure --topology' gives them")
      .field("angle", angle().between(-1.5, 1.5),
             "angle by which the faces lean towards the material along the direction; negative: away from it")
      .field("neutral", frame(), "the neutral plane, across z of this frame: nothing changes in it", "{}")
      .optional("direction", direction(), "the direction of the draft; z of the neutral plane where left out")
      .built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(leant(f)); });
}

}  // namespace lekalo::geometry
