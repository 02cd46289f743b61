// The list of light types that scene files can name: one line each; the declaration stands in the type's own file.
#include <algorithm>
#include <cctype>

#include "geometry/describe.h"
#include "render/light.h"

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

namespace {

// Every light may say to which group it belongs; its own file need not know.
void with_group(TypeDeclaration& type) {
  type.optional("group", geometry::text(), "name of the layer that shows the light of this group alone (light_groups)");
  type.build = [build = type.build](const geometry::Fields& fields) -> std::any {
    std::any built = build(fields);
    if (!fields.has("group")) return built;
    const std::string& name = fields.text("group");
    const bool is_word = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
    });
    if (!is_word || name == "rest")
      throw geometry::FieldError("group", "this is no name of a layer", "letters, digits and _; `rest` is taken");
    std::const_pointer_cast<Light>(std::any_cast<LightPtr>(built))->set_group(name);
    return built;
  };
}

}  // namespace

#define CALL(type) type(),
std::vector<TypeDeclaration> light_types() {
  std::vector<TypeDeclaration> types{LEKALO_LIGHT_TYPES(CALL)};
  for (TypeDeclaration& type : types) with_group(type);
  return types;
}

}  // namespace lekalo::render
