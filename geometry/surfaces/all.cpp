// The list of surface types that scene files can name: one line each; the declaration stands in the type's own file.
#include "geometry/describe.h"

#define LEKALO_SURFACE_TYPES(X)  \
  X(plane_type)                  \
  X(sphere_surface_type)         \
  X(cylinder_surface_type)       \
  X(cone_surface_type)           \
  X(torus_surface_type)          \
  X(ellipsoid_type)              \
  X(hyperboloid_one_sheet_type)  \
  X(hyperboloid_two_sheets_type) \
  X(elliptic_paraboloid_type)    \
  X(hyperbolic_paraboloid_type)  \
  X(extrusion_surface_type)      \
  X(revolution_surface_type)     \
  X(bezier_surface_type)         \
  X(nurbs_surface_type)          \
  X(composite_bezier_type)       \
  X(control_polyhedron_type)     \
  X(spline_volume_face_type)     \
  X(t_spline_type)               \
  X(t_spline_functions_type)     \
  X(formula_surface_type)        \
  X(coordinate_surface_type)     \
  X(ruled_surface_type)          \
  X(sector_surface_type)         \
  X(translation_surface_type)    \
  X(loft_surface_type)           \
  X(bridge_surface_type)         \
  X(offset_surface_type)         \
  X(sweep_surface_type)          \
  X(guided_loft_type)            \
  X(bilinear_surface_type)       \
  X(coons_surface_type)          \
  X(gordon_type)                 \
  X(hermite_surface_type)        \
  X(spline_surface_type)         \
  X(grid_interpolant_type)       \
  X(fit_surface_type)            \
  X(smoothing_surface_type)      \
  X(section_surface_type)        \
  X(spline_of_surface_type)      \
  X(bezier_triangle_type)        \
  X(triangle_surface_type)       \
  X(triangle_part_type)          \
  X(bernstein_triangle_type)     \
  X(transfinite_triangle_type)   \
  X(ribbon_type)                 \
  X(vintoid_type)                \
  X(serpentine_type)             \
  X(fillet_surface_type)         \
  X(chamfer_surface_type)        \
  X(extended_surface_type)       \
  X(deformed_surface_type)       \
  X(reparametrized_surface_type) \
  X(line_surface_type)           \
  X(developable_surface_type)    \
  X(development_type)            \
  X(thread_surface_type)         \
  X(weld_groove_type)            \
  X(blade_surface_type)          \
  X(mid_surface_type)            \
  X(fairing_surface_type)

namespace lekalo::geometry {

#define DECLARE(type) TypeDeclaration type();
LEKALO_SURFACE_TYPES(DECLARE)

#define CALL(type) type(),
std::vector<TypeDeclaration> surface_types() { return {LEKALO_SURFACE_TYPES(CALL)}; }

}  // namespace lekalo::geometry
