// The lists of material and texture types that scene files can name: one line each; the declaration stands in the
// type's own file.
#include "geometry/describe.h"
#include "render/materials/surface_detail.h"

#define LEKALO_MATERIAL_TYPES(X) \
  X(classic_look_type)           \
  X(diffuse_type)                \
  X(plastic_type)                \
  X(conductor_type)              \
  X(dielectric_type)             \
  X(principled_type)             \
  X(cloth_type)                  \
  X(translucent_sheet_type)      \
  X(mix_type)                    \
  X(emission_type)               \
  X(shadow_catcher_type)

#define LEKALO_TEXTURE_TYPES(X) \
  X(checker_type)               \
  X(grid_type)                  \
  X(parameter_lines_type)       \
  X(image_type)                 \
  X(noise_type)                 \
  X(ramp_type)

namespace lekalo::render {

using geometry::TypeDeclaration;

#define DECLARE(type) TypeDeclaration type();
LEKALO_MATERIAL_TYPES(DECLARE)
LEKALO_TEXTURE_TYPES(DECLARE)

#define CALL(type) type(),
std::vector<TypeDeclaration> material_types() {
  std::vector<TypeDeclaration> types{LEKALO_MATERIAL_TYPES(CALL)};
  for (TypeDeclaration& type : types) type = with_surface_detail(type);
  return types;
}
std::vector<TypeDeclaration> texture_types() { return {LEKALO_TEXTURE_TYPES(CALL)}; }

}  // namespace lekalo::render
