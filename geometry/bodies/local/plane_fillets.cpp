#include "geometry/bodies/local/plane_fillets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/bodies/local/corners.h"
#include "geometry/bodies/local/edge_curve.h"
#include "geometry/bodies/local/support.h"
#include "geometry/bodies/topology/edge_selection.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

struct Cylinder {
  Vec3 center, axis;
  double radius;
};

std::optional<Cylinder> cylinder_of(const Surface& surface) {
  if (const auto* cone = dynamic_cast<const ConeSurface*>(&surface); cone && cone->radius() == cone->top_radius())
    return Cylinder{cone->frame().origin, cone->frame().z, cone->radius()};
  const auto* e = dynamic_cast<const ExtrusionSurface*>(&surface);
  if (!e) return std::nullopt;
  const auto circle = even_circle(*e->curve(), bounds(*e->curve()).diameter());
  if (!circle) return std::nullopt;
  const Vec3 axis = glm::normalize(e->along());
  if (glm::length(glm::cross(axis, circle->frame().z)) > 1e-12) return std::nullopt;
  return Cylinder{circle->frame().origin, axis, circle->radius()};
}

// The point in the plane across the axis through `center` where both planes meet it.
Vec3 apex_of(const Frame& p, const Frame& q, const Vec3& center, const Vec3& axis) {
  const double det = glm::dot(axis, glm::cross(p.z, q.z));
  const double a = glm::dot(p.origin - center, p.z), b = glm::dot(q.origin - center, q.z);
  return center + (a * glm::cross(q.z, axis) + b * glm::cross(axis, p.z)) / det;
}

}  // namespace

std::optional<PlaneFillet> plane_fillet(const Body& body, int face) {
  const auto cylinder = cylinder_of(*unwrapped(body.faces[face].surface));
  if (!cylinder) return std::nullopt;
  std::vector<int> planes;
  for (const int l : body.faces[face].loops)
    for (const int c : body.loops[l].coedges) {
      const Edge& edge = body.edges[body.coedges[c].edge];
      if (edge.kind != EdgeKind::regular || edge.coedges.size() != 2) continue;
      const int other = face_of_coedge(body, coedge_partner(body, c));
      if (other == face || !plane_of(body.faces[other].surface) || is_sharp(body, body.coedges[c].edge)) continue;
      if (std::find(planes.begin(), planes.end(), other) == planes.end()) planes.push_back(other);
    }
  if (planes.size() != 2) return std::nullopt;
  const Vec3 m = plane_of(body.faces[planes[0]].surface)->z, n = plane_of(body.faces[planes[1]].surface)->z;
  if (glm::length(glm::cross(m, n)) < 1e-6) return std::nullopt;
  return PlaneFillet{face, {planes[0], planes[1]}, cylinder->radius, cylinder->center, cylinder->axis};
}

std::vector<PlaneFillet> plane_fillets(const Body& body) {
  std::vector<PlaneFillet> result;
  for (size_t f = 0; f < body.faces.size(); ++f)
    if (const auto fillet = plane_fillet(body, static_cast<int>(f))) result.push_back(*fillet);
  return result;
}

bool ends_in_corner(const Body& body, const PlaneFillet& fillet) {
  for (const int l : body.faces[fillet.face].loops)
    for (const int c : body.loops[l].coedges)
      if (body.edges[body.coedges[c].edge].coedges.size() == 2 &&
          !plane_of(body.faces[face_of_coedge(body, coedge_partner(body, c))].surface))
        return true;
  return false;
}

SurfacePtr with_radius(const Body& body, const PlaneFillet& fillet, double radius) {
  const SurfacePtr old = unwrapped(body.faces[fillet.face].surface);
  const Vec3 apex = apex_of(*plane_of(body.faces[fillet.planes[0]].surface),
                            *plane_of(body.faces[fillet.planes[1]].surface), fillet.center, fillet.axis);
  // Similar about the line in which the planes meet, across the axis.
  const double k = radius / fillet.radius;
  std::shared_ptr<Surface> made;
  if (const auto* cone = dynamic_cast<const ConeSurface*>(old.get())) {
    Frame frame = cone->frame();
    frame.origin = apex + k * (frame.origin - apex);
    made = std::make_shared<CylinderSurface>(frame, radius, cone->height(), cone->domain());
  } else {
    const auto* e = dynamic_cast<const ExtrusionSurface*>(old.get());
    made = std::make_shared<ExtrusionSurface>(transformed(e->curve(), Affine::scaling(Vec3(k), apex)), e->along(),
                                              e->domain());
  }
  made->set_reversed(old->reversed());
  return made;
}

void let_fillets_follow(const Body& body, std::vector<SurfacePtr>& surfaces, const char* field) {
  const std::vector<SurfacePtr> asked = surfaces;
  for (const PlaneFillet& fillet : plane_fillets(body)) {
    if (asked[fillet.face] != body.faces[fillet.face].surface) continue;
    std::array<Vec3, 2> normals;
    std::array<double, 2> shift{};
    for (int k = 0; k < 2; ++k) {
      const int plane = fillet.planes[k];
      const Frame before = *plane_of(body.faces[plane].surface);
      normals[k] = before.z;
      if (asked[plane] == body.faces[plane].surface) continue;
      const auto after = plane_of(asked[plane]);
      if (!after || glm::length(glm::cross(before.z, after->z)) > 1e-12)
        throw FieldError(field,
                         fmt::format("the fillet {} cannot follow the face {} that turns",
                                     name_of_face(body, fillet.face), name_of_face(body, plane)),
                         "delete it before, or move it too");
      shift[k] = glm::dot(after->origin - before.origin, before.z);
    }
    if (shift[0] == 0 && shift[1] == 0) continue;
    const double det = glm::dot(fillet.axis, glm::cross(normals[0], normals[1]));
    const Vec3 by =
        (shift[0] * glm::cross(normals[1], fillet.axis) + shift[1] * glm::cross(fillet.axis, normals[0])) / det;
    surfaces[fillet.face] = moved_support(unwrapped(body.faces[fillet.face].surface), Affine::translation(by));
  }
}

}  // namespace lekalo::geometry
