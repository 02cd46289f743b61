// The list of integrator types that scene files can name: one line each; the declaration stands in the type's own file.
#include "geometry/describe.h"

#define LEKALO_INTEGRATOR_TYPES(X) \
  X(classic_integrator_type)       \
  X(analysis_integrator_type)      \
  X(path_integrator_type)          \
  X(direct_lighting_type)          \
  X(ambient_occlusion_type)

namespace lekalo::render {

using geometry::TypeDeclaration;

#define DECLARE(type) TypeDeclaration type();
LEKALO_INTEGRATOR_TYPES(DECLARE)

#define CALL(type) type(),
std::vector<TypeDeclaration> integrator_types() { return {LEKALO_INTEGRATOR_TYPES(CALL)}; }

}  // namespace lekalo::render
