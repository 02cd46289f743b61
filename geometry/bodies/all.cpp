// The list of body types that scene files can name: one line each; the declaration stands in the type's own file.
#include "geometry/describe.h"

#define LEKALO_BODY_TYPES(X)   \
  X(box_type)                  \
  X(ball_type)                 \
  X(cylinder_body_type)        \
  X(cone_body_type)            \
  X(torus_body_type)           \
  X(wedge_type)                \
  X(prism_type)                \
  X(pyramid_type)              \
  X(arrow_body_type)           \
  X(trimmed_surface_type)      \
  X(simplex_spline_type)       \
  X(s_surface_type)            \
  X(dms_surface_type)          \
  X(triangulated_surface_type) \
  X(subdivision_surface_type)  \
  X(cloud_surface_type)        \
  X(extrusion_body_type)       \
  X(revolution_body_type)      \
  X(translation_body_type)     \
  X(sweep_body_type)           \
  X(pipe_type)                 \
  X(loft_body_type)            \
  X(blade_body_type)           \
  X(thickened_sheet_type)      \
  X(sewn_shell_type)           \
  X(exploded_body_type)        \
  X(face_loop_type)            \
  X(hollow_body_type)          \
  X(offset_body_type)          \
  X(shell_body_type)           \
  X(moved_faces_type)          \
  X(deformed_face_type)        \
  X(triangulated_face_type)    \
  X(refilleted_body_type)      \
  X(drafted_faces_type)        \
  X(deleted_faces_type)        \
  X(detached_faces_type)       \
  X(fillet_body_type)          \
  X(chamfer_body_type)         \
  X(cut_body_type)             \
  X(inverted_body_type)        \
  X(symmetric_body_type)       \
  X(nearest_extrusion_type)    \
  X(rib_type)                  \
  X(milling_cutter_type)

namespace lekalo::geometry {

#define DECLARE(type) TypeDeclaration type();
LEKALO_BODY_TYPES(DECLARE)

#define CALL(type) type(),
std::vector<TypeDeclaration> body_types() { return {LEKALO_BODY_TYPES(CALL)}; }

}  // namespace lekalo::geometry
