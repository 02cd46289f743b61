// The list of curve types that scene files can name: one line each; the declaration stands in the type's own file.
#include "geometry/describe.h"

#define LEKALO_CURVE_TYPES(X)     \
  X(segment_type)                 \
  X(polyline_type)                \
  X(rectangle_type)               \
  X(polygon_type)                 \
  X(regular_polygon_type)         \
  X(slot_type)                    \
  X(rounded_polyline_type)        \
  X(line_arc_curve_type)          \
  X(profile_type)                 \
  X(circle_type)                  \
  X(ellipse_type)                 \
  X(hyperbola_type)               \
  X(parabola_type)                \
  X(arc_through_points_type)      \
  X(helix_type)                   \
  X(conic_arc_type)               \
  X(circular_arc_type)            \
  X(conic_type)                   \
  X(named_curve_type)             \
  X(pursuit_curve_type)           \
  X(bezier_curve_type)            \
  X(nurbs_curve_type)             \
  X(local_interpolant_type)       \
  X(rational_cubic_type)          \
  X(g2_curve_type)                \
  X(g2_transition_type)           \
  X(basis_function_type)          \
  X(spline_curve_type)            \
  X(lagrange_curve_type)          \
  X(hermite_curve_type)           \
  X(hermite_edge_type)            \
  X(tension_spline_type)          \
  X(exponential_spline_type)      \
  X(smoothing_spline_type)        \
  X(local_spline_type)            \
  X(formula_curve_type)           \
  X(arc_blend_curve_type)         \
  X(epsilon_net_type)             \
  X(intersection_curve_type)      \
  X(self_intersection_curve_type) \
  X(section_curve_type)           \
  X(normal_section_type)          \
  X(silhouette_curve_type)        \
  X(isophote_curve_type)          \
  X(reflection_line_type)         \
  X(parameter_line_type)          \
  X(surface_curve_type)           \
  X(projected_curve_type)         \
  X(carried_curve_type)           \
  X(geodesic_curve_type)          \
  X(curvature_line_type)          \
  X(asymptotic_line_type)         \
  X(composite_curve_type)         \
  X(reversed_curve_type)          \
  X(trimmed_curve_type)           \
  X(extended_curve_type)          \
  X(reparametrized_curve_type)    \
  X(offset_curve_type)            \
  X(thickened_curve_type)         \
  X(transition_curve_type)        \
  X(wrapped_curve_type)           \
  X(evolute_curve_type)           \
  X(involute_curve_type)          \
  X(pedal_curve_type)             \
  X(conchoid_curve_type)          \
  X(roulette_curve_type)          \
  X(polyline_of_curve_type)       \
  X(spline_of_curve_type)         \
  X(nurbs_of_type)                \
  X(elevated_curve_type)          \
  X(refined_curve_type)           \
  X(reduced_curve_type)           \
  X(elastica_type)                \
  X(fit_curve_type)               \
  X(rounded_corners_type)         \
  X(implicit_curve_type)          \
  X(blend_curve_type)             \
  X(frame_section_type)           \
  X(cutter_path_type)             \
  X(flank_path_type)              \
  X(tool_path_type)               \
  X(tool_program_type)            \
  X(coverage_band_type)           \
  X(route_graph_type)             \
  X(pocket_type)                  \
  X(turning_pass_type)            \
  X(drilling_order_type)

namespace lekalo::geometry {

#define DECLARE(type) TypeDeclaration type();
LEKALO_CURVE_TYPES(DECLARE)

#define CALL(type) type(),
std::vector<TypeDeclaration> curve_types() { return {LEKALO_CURVE_TYPES(CALL)}; }

}  // namespace lekalo::geometry
