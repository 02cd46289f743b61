// The list of light types that scene files can name: one line each; the declaration stands in the type's own file.
#include "geometry/describe.h"

#define LEKALO_LIGHT_TYPES(X) \
  X(point_light_type)         \
  X(spot_light_type)          \
  X(distant_light_type)       \
  X(rectangle_light_type)     \
  X(disc_light_type)          \
  X(sphere_light_type)        \
  X(environment_light_type)   \
  X(sky_light_type)           \
  X(sun_light_type)           \
  X(profile_light_type)       \
  X(ambient_light_type)

namespace lekalo::render {

using geometry::TypeDeclaration;

#define DECLARE(type) TypeDeclaration type();
LEKALO_LIGHT_TYPES(DECLARE)

#define CALL(type) type(),
std::vector<TypeDeclaration> light_types() { return {LEKALO_LIGHT_TYPES(CALL)}; }

}  // namespace lekalo::render
