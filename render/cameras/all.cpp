// The list of camera types that scene files can name: one line each; the declaration stands in the type's own file.
// A camera's builder returns a CameraFactory.
#include "geometry/describe.h"

#define LEKALO_CAMERA_TYPES(X) \
  X(perspective_type)          \
  X(parallel_type)             \
  X(graph_type)                \
  X(panorama_type)

namespace lekalo::render {

using geometry::TypeDeclaration;

#define DECLARE(type) TypeDeclaration type();
LEKALO_CAMERA_TYPES(DECLARE)

#define CALL(type) type(),
std::vector<TypeDeclaration> camera_types() { return {LEKALO_CAMERA_TYPES(CALL)}; }

}  // namespace lekalo::render
