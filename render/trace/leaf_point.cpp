#include "render/trace/leaf_point.h"

#include <algorithm>
#include <cmath>

#include "geometry/queries/contours/parameter_lines.h"

namespace lekalo::render {

using geometry::Surface;
using geometry::Vec2;

namespace {

// The foot point of a facet's point on the surface that the facet stands for: one Gauss-Newton step from the
// interpolated parameters, within the triangle's own, so that it stays on its side of a crease or pole.
Vec2 foot_point_on(const Surface& surface, const Vec3& point, const Vec2& start, const Vec2 (&corner)[3]) {
  const geometry::SurfaceJet at = surface.evaluate(start.x, start.y, 1);
  const Vec3 off = point - at.point();
  const double e = glm::dot(at.du(), at.du()), f = glm::dot(at.du(), at.dv()), g = glm::dot(at.dv(), at.dv());
  const double det = e * g - f * f;
  if (!(det > 1e-14 * e * g)) return start;
  const double a = glm::dot(at.du(), off), b = glm::dot(at.dv(), off);
  const Vec2 foot_point = start + Vec2(g * a - f * b, e * b - f * a) / det;
  const Vec2 lo = glm::min(glm::min(corner[0], corner[1]), corner[2]),
             hi = glm::max(glm::max(corner[0], corner[1]), corner[2]);
  const Vec2 inside = 1e-9 * (hi - lo);
  return glm::clamp(foot_point, lo + inside, hi - inside);
}

// Triangles are interpolated across the seam of a closed surface and whole periods away: a trim moves the cut to where
// no loop lies. What is shown are the surface's own parameters.
Vec2 in_domain(const Surface& surface, const Vec2& at) {
  const geometry::Periods periods = surface.periods();
  if (periods.u == 0 && periods.v == 0) return at;
  const geometry::Rectangle domain = surface.domain();
  return {domain.u.clamp(at.x + geometry::shift_into(domain.u, at.x, periods.u)),
          domain.v.clamp(at.y + geometry::shift_into(domain.v, at.y, periods.v))};
}

// A point of a surface or shape in the space of its leaf. All members are written at once: this runs for every hit of
// every ray.
SurfacePoint point_as_seen(const geometry::ShapePoint& at, const geometry::Sides& convex_sides, const Hit& hit,
                           const Vec3& incoming, int object, double error) {
  return {.position = at.position,
          .smooth_position = at.position,
          .incoming = incoming,
          .geometric_normal = at.normal,
          .normal = at.normal,
          .du = at.du,
          .dv = at.dv,
          .u = at.u,
          .v = at.v,
          .error = error,
          .instance = hit.instance,
          .object = object,
          .face = hit.face,
          .piece = hit.piece,
          .convex_sides = convex_sides};
}

// What a hit on a surface shows; `near` is its place on the line that found it.
SurfacePoint point_of_surface(const Leaf& leaf, const Hit& hit, const Vec3& near, const Vec3& incoming, int object,
                              double error) {
  const double sign = leaf.signs[hit.face];
  const auto sides_of = [&](const Surface& surface) {
    const geometry::Sides sides = surface.convex_sides(hit.u, hit.v);
    return sign * surface.normal_sign() < 0 ? sides.turned() : sides;
  };
  if (const Surface* bare = leaf.foot_points[hit.face]) {
    const geometry::FootPoint foot_point = bare->foot_point(near);
    return point_as_seen({foot_point.point, sign * foot_point.normal}, sides_of(*bare), hit, incoming, object, error);
  }
  const geometry::LineTarget& target = *leaf.targets[hit.face];
  const Surface& surface = target.surface();
  const geometry::Sides sides = sides_of(surface);
  const geometry::SurfaceJet jet = target.jet_at(hit.piece, hit.u, hit.v, near);
  return point_as_seen(geometry::point_on(surface, sign, hit.u, hit.v, jet), sides, hit, incoming, object, error);
}

SurfacePoint point_of_mesh(const Leaf& leaf, const Hit& hit, const Vec3& incoming, int object, double error) {
  const auto& number = leaf.mesh->triangles[hit.piece].vertex;
  const PackedVertex &v0 = leaf.mesh->vertices[number[0]], &v1 = leaf.mesh->vertices[number[1]],
                     &v2 = leaf.mesh->vertices[number[2]];
  const Vec3& p0 = v0.point;
  const Vec3 ab = v1.point - p0, ac = v2.point - p0;
  const double w[3] = {1 - hit.b - hit.c, hit.b, hit.c};
  const Vec3 from_a = w[1] * ab + w[2] * ac, position = p0 + from_a;
  Vec3 geometric = glm::normalize(glm::cross(ab, ac)), shading = geometric, smooth_position = position;
  Vec3 du(0), dv(0);
  Vec2 at(hit.u, hit.v);
  const Vec2 q[3] = {v0.parameter, v1.parameter, v2.parameter};
  if (!leaf.mesh_surfaces.empty() && !leaf.flat) {
    // The surface is known: its own normal, derivatives and parameters at the foot point of the facet's point.
    const Surface& surface = *leaf.mesh_surfaces[hit.face];
    at = foot_point_on(surface, position, w[0] * q[0] + w[1] * q[1] + w[2] * q[2], q);
    const geometry::SurfaceJet jet = surface.evaluate(at.x, at.y, 1);
    du = jet.du();
    dv = jet.dv();
    shading = leaf.signs[hit.face] * surface.normal_sign() * parametric_normal(surface, at.x, at.y, jet);
    if (glm::dot(shading, geometric) < 0) geometric = -geometric;
    // Rays to lights start on the surface itself where it stands above the facet: no terminator along the facets.
    const double above = glm::dot(jet.point() - position, geometric);
    if (above > 0) smooth_position = jet.point();
  } else {
    const Vec3 &n0 = v0.normal, &n1 = v1.normal, &n2 = v2.normal, sum = w[0] * n0 + w[1] * n1 + w[2] * n2;
    const double length2 = glm::dot(sum, sum);
    if (!leaf.flat && length2 > 1e-20) {
      shading = sum / std::sqrt(length2);
      if (glm::dot(shading, geometric) < 0) geometric = -geometric;
      // The mean of the point's projections on the vertices' tangent planes, where they stand above the facet: keeps
      // the terminator off the facets (Hanika, "Hacking the shadow terminator", Ray Tracing Gems II, 2021).
      const double above0 = w[0] * std::min(0.0, glm::dot(from_a, n0)),
                   above1 = w[1] * std::min(0.0, glm::dot(from_a - ab, n1)),
                   above2 = w[2] * std::min(0.0, glm::dot(from_a - ac, n2));
      smooth_position -= above0 * n0 + above1 * n1 + above2 * n2;
    }
    // Texture directions of the facet.
    const Vec2 a = q[1] - q[0], b = q[2] - q[0];
    const double det = a.x * b.y - a.y * b.x;
    if (det != 0) {
      const double per_det = 1 / det;
      du = (per_det * b.y) * ab - (per_det * a.y) * ac;
      dv = (per_det * a.x) * ac - (per_det * b.x) * ab;
    }
  }
  if (!leaf.mesh_surfaces.empty()) at = in_domain(*leaf.mesh_surfaces[hit.face], at);
  return {.position = position,
          .smooth_position = smooth_position,
          .incoming = incoming,
          .geometric_normal = geometric,
          .normal = shading,
          .du = du,
          .dv = dv,
          .u = at.x,
          .v = at.y,
          .error = error,
          .instance = hit.instance,
          .object = object,
          .face = hit.face,
          .piece = hit.piece};
}

}  // namespace

SurfacePoint point_in_leaf(const Leaf& leaf, const Hit& hit, const Vec3& near, const Vec3& incoming, int object,
                           double error, double stretch) {
  if (leaf.mesh) return point_of_mesh(leaf, hit, incoming, object, error);
  if (!leaf.shape) return point_of_surface(leaf, hit, near, incoming, object, error);
  const geometry::SurfaceHit of_shape{hit.t, hit.u, hit.v, hit.face, hit.piece};
  const geometry::ShapePoint at =
      leaf.parameters ? leaf.shape->point(of_shape, near) : leaf.shape->bare_point(of_shape, near);
  return point_as_seen(at, {}, hit, incoming, object, error + at.error * stretch);
}

}  // namespace lekalo::render
