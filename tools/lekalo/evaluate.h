// What `lekalo evaluate` tells of one kind of thing.
#pragma once

#include <vector>

#include "geometry/queries/differential/curvature.h"
#include "geometry/surface.h"
#include "json.h"

namespace lekalo::command {

inline ordered_json json_or_null(bool known, double x) { return known ? finite_or_null(x) : ordered_json(nullptr); }

// What is known of a surface at a place: of order 2, and the size of the whole.
struct SurfacePlace {
  geometry::Vec2 uv;
  geometry::SurfaceJet jet;
  geometry::Vec3 normal;
  geometry::SurfaceCurvature curvature;
  double size = 0;
};

// `along`: none, or one or two directions in the parameter plane, in which the normal curvature and between which the
// angle is told.
ordered_json evaluate_place(const SurfacePlace& at, const std::vector<geometry::Vec2>& along);
// The same of a surface. `turn`: an angle by which the normal turns along u and v over the steps that are told; none if
// 0.
ordered_json evaluate_surface(const geometry::Surface& surface, const geometry::Vec2& uv,
                              const std::vector<geometry::Vec2>& along, double turn);

// At parameters of triangles: of the one of these surfaces in whose half-open region the place lies, or on its border.
// Throws UsageError where none has it.
ordered_json evaluate_over_triangles(const std::vector<geometry::SurfacePtr>& surfaces, const geometry::Vec2& uv,
                                     const std::vector<geometry::Vec2>& along);

}  // namespace lekalo::command
