// Surfaces over triangles by the parameters of their triangles (Golovanov 2016, 3.10, 3.12, 3.17).
#include <fmt/format.h>

#include <cmath>

#include "command.h"
#include "evaluate.h"
#include "geometry/surfaces/triangles/triangular_surface.h"

namespace lekalo::command {

namespace {

using geometry::PlacedTriangle;
using geometry::Vec2;
using geometry::Vec3;

struct Found {
  PlacedTriangle triangle;
  size_t face = 0;
  bool is_half_open = false;  // in the triangle's half-open region
};

Found triangle_at(const std::vector<geometry::SurfacePtr>& surfaces, const Vec2& uv) {
  Found found;
  bool any = false;
  for (size_t k = 0; k < surfaces.size(); ++k) {
    const PlacedTriangle placed = geometry::placed_triangle(*surfaces[k]);
    if (!placed.surface) continue;
    any = true;
    const geometry::ParameterTriangle& triangle = placed.surface->triangle();
    const bool in_region = geometry::in_half_open_region(triangle.corners, uv);
    if (in_region) return {placed, k, true};
    if (!found.triangle.surface && triangle.contains(uv)) found = {placed, k, false};
    // Of one alone the place may lie outside.
    if (surfaces.size() == 1) return {placed, k, false};
  }
  if (!any) throw UsageError("--uv belongs to surfaces over triangles: bezier_triangle, transfinite_triangle, ...");
  if (!found.triangle.surface)
    throw UsageError(fmt::format("--uv {:.6g},{:.6g} lies outside of all triangles", uv.x, uv.y));
  return found;
}

}  // namespace

ordered_json evaluate_over_triangles(const std::vector<geometry::SurfacePtr>& surfaces, const Vec2& uv,
                                     const std::vector<Vec2>& along) {
  const auto [placed, face, is_half_open] = triangle_at(surfaces, uv);
  const geometry::Surface& surface = *surfaces[face];
  const geometry::ParameterTriangle& triangle = placed.surface->triangle();
  const geometry::SurfaceJet jet = placed.evaluate(uv, 2);
  const Vec3 across = glm::cross(jet.du(), jet.dv());
  const Vec3 normal = surface.normal_sign() * across / glm::length(across);
  const bool is_regular = std::isfinite(normal.x + normal.y + normal.z);
  ordered_json out;
  if (surfaces.size() > 1) out["face"] = face;
  out["determinant"] = triangle.determinant();
  out["barycentric"] = to_json(triangle.coordinates(uv));
  out["in_half_open_region"] = is_half_open;
  if (!along.empty()) out["barycentric_direction"] = to_json(triangle.direction(along[0]));
  if (!along.empty()) out["derivative_along"] = to_json(along[0].x * jet.du() + along[0].y * jet.dv());
  out.update(
      evaluate_place({uv, jet, normal, is_regular ? geometry::curvature(jet, normal) : geometry::SurfaceCurvature(),
                      geometry::bounds(surface).diameter()},
                     along));
  return out;
}

}  // namespace lekalo::command
