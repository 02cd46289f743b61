// The list of shape types that scene files can name: one line each; the declaration stands in the type's own file.
#include "geometry/describe.h"

#define LEKALO_SHAPE_TYPES(X) X(implicit_type)

namespace lekalo::geometry {

#define DECLARE(type) TypeDeclaration type();
LEKALO_SHAPE_TYPES(DECLARE)

#define CALL(type) type(),
std::vector<TypeDeclaration> shape_types() { return {LEKALO_SHAPE_TYPES(CALL)}; }

}  // namespace lekalo::geometry
