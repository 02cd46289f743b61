// Offsets that keep the parameters (Golovanov 2016, 6.7): plane to plane, cylinder and sphere R + d, a cone with an
// apex moved along its axis by -d/sin(half-angle), a torus with the minor radius b + d; extrusion and revolution of
// c(u) to those of the offset of c in its plane.
#include "geometry/bodies/local/support.h"

#include "geometry/bodies/topology/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/bodies/constructions/profile_offset.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/derived/offset.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

// Rounding of control points that are meant to lie in one plane, relative to their box.
constexpr double kFlat = 1e-13;

// The mean of r_u x r_v of a patch whose control points lie in one plane.
std::optional<Frame> plane_of_form(const NurbsSurfaceForm& form) {
  Box3 box;
  for (const Vec4& p : form.points) {
    if (!(p.w > 0)) return std::nullopt;
    box.include(Vec3(p) / p.w);
  }
  const int m = form.count_u(), n = form.count_v();
  const auto at = [&](int i, int j) { return Vec3(form.points[i * n + j]) / form.points[i * n + j].w; };
  Vec3 area(0);
  for (int i = 0; i + 1 < m; ++i)
    for (int j = 0; j + 1 < n; ++j) area += glm::cross(at(i + 1, j + 1) - at(i, j), at(i, j + 1) - at(i + 1, j));
  const double size = box.diameter();
  if (!(glm::length(area) > 1e-9 * size * size)) return std::nullopt;
  const Vec3 z = glm::normalize(area), origin = at(0, 0);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j)
      if (std::abs(glm::dot(z, at(i, j) - origin)) > kFlat * (size + glm::length(origin))) return std::nullopt;
  const Vec3 along = at(m - 1, 0) - origin;
  return glm::length(along) > 1e-9 * size ? frame_from(origin, z, along) : frame_about(origin, z);
}

Vec3 parametric_normal_at(const Surface& surface, const Vec2& at) {
  return surface.normal_sign() * surface.normal(at.x, at.y);
}

Vec2 middle_of(const Rectangle& d) { return {d.u.middle(), d.v.middle()}; }

SurfacePtr offset_cone(const ConeSurface& cone, double d) {
  const double w = cone.top_radius() - cone.radius(), h = cone.height();
  if (w == 0) return nullptr;
  // Away from the apex points go along their normals.
  const double by = d * h / std::hypot(w, h);
  const auto is_clear = [&](double v) { return cone.radius() + w * v > 0 && cone.radius() + w * v + by > 0; };
  if (is_clear(cone.domain().v.lo) && is_clear(cone.domain().v.hi)) return nullptr;
  Frame frame = cone.frame();
  frame.origin -= d * std::hypot(w, h) / w * frame.z;
  return std::make_shared<ConeSurface>(frame, cone.radius(), cone.top_radius(), h, cone.domain());
}

// The curve at a distance in its plane, the side of the normal; null where it is no offset in a plane.
CurvePtr offset_in_plane(const CurvePtr& curve, const Vec3& normal, double d, const char* field) {
  return mitred_offset({curve}, normal, d, curve->is_closed(), field).front();
}

SurfacePtr offset_extrusion(const ExtrusionSurface& e, double d, const char* field) {
  const Vec3 along = glm::normalize(e.along());
  const Interval domain = e.curve()->domain();
  for (int k = 0; k <= 16; ++k) {
    const Vec3 chord = e.curve()->point(domain.lo + domain.width() * k / 16) - e.curve()->point(domain.lo);
    if (std::abs(glm::dot(chord, along)) > 1e-12 * bounds(*e.curve()).diameter()) return nullptr;
  }
  // r_u x r_v = c' x d is to the right of c', seen against d.
  return std::make_shared<ExtrusionSurface>(offset_in_plane(e.curve(), along, -d, field), e.along(), e.domain());
}

SurfacePtr offset_revolution(const RevolutionSurface& r, double d, const char* field) {
  // At v = 0 the curve lies in a plane through the axis, and r_v = axis x (c - p).
  const Interval domain = r.curve()->domain();
  const Axis axis = r.axis();
  const Vec3 around = glm::cross(axis.along, r.curve()->point(domain.middle()) - axis.through);
  if (!(glm::length(around) > 0)) return nullptr;
  const Vec3 normal = glm::normalize(around);
  for (int k = 0; k <= 16; ++k) {
    const Vec3 p = r.curve()->point(domain.lo + domain.width() * k / 16) - axis.through;
    if (std::abs(glm::dot(p, normal)) > 1e-12 * (bounds(*r.curve()).diameter() + glm::length(p))) return nullptr;
  }
  // Across the axis a pole stays; a tip moves along the axis, with all of a straight meridian.
  const DegenerateEdges poles = r.degenerate_edges();
  for (const auto& [pole, t] : {std::pair(poles.u_min, domain.lo), std::pair(poles.u_max, domain.hi)}) {
    const Vec3 along = glm::normalize(r.curve()->evaluate(t, 1).d[1]);
    if (!pole || std::abs(glm::dot(along, axis.along)) <= 1e-9) continue;
    if (!dynamic_cast<const Segment*>(r.curve().get())) return nullptr;
    const Vec3 shift = d / glm::dot(glm::cross(along, normal), axis.along) * axis.along;
    return std::make_shared<RevolutionSurface>(transformed(r.curve(), Affine::translation(shift)), axis, r.domain());
  }
  // c' x (direction of r_v) = c' x normal is to the right of c', seen against the normal.
  return std::make_shared<RevolutionSurface>(offset_in_plane(r.curve(), normal, -d, field), axis, r.domain());
}

// Of a map that keeps angles, a mirroring too, what lengths are multiplied by.
std::optional<double> scale_of(const Affine& map) {
  const double scale = std::cbrt(std::abs(map.determinant()));
  const Mat3 square = glm::transpose(map.linear) * map.linear;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (std::abs(square[i][j] - (i == j ? scale * scale : 0)) > 1e-14 * scale * scale) return std::nullopt;
  return scale;
}

bool is_rigid(const Affine& map) {
  const auto scale = scale_of(map);
  return scale && std::abs(*scale - 1) <= 1e-14 && map.determinant() > 0;
}

SurfacePtr offset_by_kind(const SurfacePtr& surface, double d, const char* field) {
  if (const auto* moved = dynamic_cast<const TransformedSurface*>(surface.get())) {
    const auto scale = scale_of(moved->map());
    if (!scale) return nullptr;
    // Mirrored, r_u x r_v looks to the other side.
    const double side = moved->map().determinant() > 0 ? 1 : -1;
    const SurfacePtr inner = offset_by_kind(moved->original(), side * d / *scale, field);
    return inner ? transformed(inner, moved->map()) : nullptr;
  }
  if (const auto* cone = dynamic_cast<const ConeSurface*>(surface.get())) return offset_cone(*cone, d);
  if (const auto* e = dynamic_cast<const ExtrusionSurface*>(surface.get())) return offset_extrusion(*e, d, field);
  if (const auto* r = dynamic_cast<const RevolutionSurface*>(surface.get())) return offset_revolution(*r, d, field);
  return nullptr;
}

}  // namespace

std::optional<Frame> plane_of(const SurfacePtr& surface) {
  if (const auto* plane = dynamic_cast<const Plane*>(surface.get())) return plane->frame();
  if (!surface->bounded()) return std::nullopt;
  const auto form = surface->as_nurbs();
  if (!form) return std::nullopt;
  std::optional<Frame> frame = plane_of_form(*form);
  if (frame && glm::dot(frame->z, parametric_normal_at(*surface, middle_of(surface->domain()))) < 0)
    frame = Frame{frame->origin, frame->y, frame->x, -frame->z};
  return frame;
}

SurfacePtr offset_support(const SurfacePtr& surface, double d, const char* field) {
  if (d == 0) return surface;
  std::shared_ptr<Surface> result;
  if (const auto frame = plane_of(surface)) {
    Frame moved = *frame;
    moved.origin += d * frame->z;
    result = std::make_shared<Plane>(moved);
  } else {
    try {
      result = std::const_pointer_cast<Surface>(offset_by_kind(surface, d, field));
      if (!result) result = std::const_pointer_cast<Surface>(offset_surface(surface, surface->normal_sign() * d));
    } catch (const FieldError& error) {
      throw FieldError(field, error.what(), error.hint);
    }
  }
  result->set_reversed(surface->reversed());
  return result;
}

SurfacePtr moved_support(const SurfacePtr& surface, const Affine& map) {
  if (map.is_identity()) return surface;
  const auto scale = scale_of(map);
  if (!scale) return transformed(surface, map);
  // With the frame's z turned in a mirror, and heights below 0, the parameters stay.
  const double k = is_rigid(map) ? 1 : *scale, side = map.determinant() > 0 ? 1 : -1;
  const auto moved = [&](const Frame& f) {
    return Frame{map.point(f.origin), map.direction(f.x) / k, map.direction(f.y) / k, side * map.direction(f.z) / k};
  };
  std::shared_ptr<Surface> result;
  const auto* plane = dynamic_cast<const Plane*>(surface.get());
  if (plane && is_rigid(map))
    result = std::make_shared<Plane>(moved(plane->frame()), plane->domain());
  else if (const auto* e = dynamic_cast<const ExtrusionSurface*>(surface.get()))
    result = std::make_shared<ExtrusionSurface>(transformed(e->curve(), map), map.direction(e->along()), e->domain());
  else if (const auto* c = dynamic_cast<const ConeSurface*>(surface.get()); c && c->radius() == c->top_radius())
    result = std::make_shared<CylinderSurface>(moved(c->frame()), k * c->radius(), side * k * c->height(), c->domain());
  else if (c)
    result = std::make_shared<ConeSurface>(moved(c->frame()), k * c->radius(), k * c->top_radius(),
                                           side * k * c->height(), c->domain());
  else
    return transformed(surface, map);
  result->set_reversed(surface->reversed());
  return result;
}

SurfacePtr unwrapped(const SurfacePtr& surface) {
  const auto* moved = dynamic_cast<const TransformedSurface*>(surface.get());
  return moved && scale_of(moved->map()) ? moved_support(moved->original(), moved->map()) : surface;
}

std::vector<SurfacePtr> surfaces_of(const Body& body) {
  std::vector<SurfacePtr> surfaces;
  for (const Face& face : body.faces) surfaces.push_back(face.surface);
  return surfaces;
}

std::vector<SurfacePtr> offset_surfaces(const Body& body, const std::vector<double>& distances, const char* field) {
  std::vector<SurfacePtr> surfaces;
  for (size_t f = 0; f < body.faces.size(); ++f)
    surfaces.push_back(offset_support(body.faces[f].surface, outward_side(body.faces[f]) * distances[f], field));
  return surfaces;
}

double area_of_loop(const std::vector<Body::Use>& uses) {
  std::vector<Vec2> points;
  for (const Body::Use& u : uses) {
    const Interval t = u.image->domain();
    for (int k = 0; k < 64; ++k)
      points.push_back(Vec2(u.image->point(t.lo + t.width() * (u.forward ? k : 64 - k) / 64)));
  }
  double sum = 0;
  for (size_t k = 1; k + 1 < points.size(); ++k) {
    const Vec2 a = points[k] - points[0], b = points[k + 1] - points[0];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

Vec2 middle_of_face(const Body& body, int face) {
  Box3 box;
  for (const int c : body.loops[body.faces[face].loops.front()].coedges) {
    const Curve& image = *body.coedges[c].image;
    for (int k = 0; k <= 4; ++k) box.include(image.point(image.domain().lo + image.domain().width() * k / 4));
  }
  return Vec2(box.center());
}

std::vector<int> faces_named(const Body& body, const Fields& fields, const char* field) {
  return all_called(body, Element::face, fields.get<std::vector<std::string>>(field), field);
}

}  // namespace lekalo::geometry
