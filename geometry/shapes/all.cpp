// The list of shape types that scene files can name: one line each; the declaration stands in the type's own file.
#include "geometry/describe.h"

#define LEKALO_SHAPE_TYPES(X) \
  X(implicit_type)            \
  X(tube_type)                \
  X(balls_type)               \
  X(union_type)               \
  X(intersection_type)        \
  X(difference_type)          \
  X(half_space_type)

namespace lekalo::geometry {

#define DECLARE(type) TypeDeclaration type();
LEKALO_SHAPE_TYPES(DECLARE)

#define CALL(type) type(),
std::vector<TypeDeclaration> shape_types() { return {LEKALO_SHAPE_TYPES(CALL)}; }

}  // namespace lekalo::geometry
