// What `lekalo evaluate` tells of one kind of thing.
#pragma once

#include <vector>

#include "geometry/queries/differential/curvature.h"
#include "geometry/queries/differential/curvilinear.h"
#include "geometry/surface.h"
#include "geometry/surfaces/analytic/coordinate_surface.h"
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
// 0. `connected`: with Christoffel's symbols and the curvature tensors of its metric.
ordered_json evaluate_surface(const geometry::Surface& surface, const geometry::Vec2& uv,
                              const std::vector<geometry::Vec2>& along, double turn, bool connected);

// At parameters of triangles: of the one of these surfaces in whose half-open region the place lies, or on its border.
// Throws UsageError where none has it.
ordered_json evaluate_over_triangles(const std::vector<geometry::SurfacePtr>& surfaces, const geometry::Vec2& uv,
                                     const std::vector<geometry::Vec2>& along);

// Metric, Christoffel's symbols and curvature tensors of a local basis, of two or three coordinates.
template <int D>
void put_connection(ordered_json& out, const geometry::Connection<D>& connection);

// The local basis of curvilinear coordinates at u, v, w, and what becomes of the fields given in them. Throws
// UsageError where the basis has no volume. `map`: of the space that they are in.
ordered_json evaluate_system(const geometry::CurvilinearSystem& system, const geometry::Affine& map,
                             const std::vector<double>& at);
// The same at t of the system's path, with the derivatives of the path and of the vector carried along it.
ordered_json evaluate_path(const geometry::CurvilinearSystem& system, const geometry::Affine& map, double t);

}  // namespace lekalo::command
