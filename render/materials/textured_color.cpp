#include "render/materials/textured_color.h"

namespace lekalo::render {

geometry::FieldType textured_color() {
  geometry::FieldType type = geometry::color().non_negative();
  type.categories = {geometry::Category::texture};
  return type;
}

geometry::FieldType textured_share() { return textured_color().at_most(1); }

TexturedColor color_texture(const geometry::Fields& fields, std::string_view field) {
  if (fields.holds<TexturePtr>(field)) return fields.get<TexturePtr>(field);
  return fields.get<Vec3>(field);
}

Vec2 line_spacing(const geometry::Fields& fields) {
  const auto spacing = [&](std::string_view field) {
    return fields.holds<double>(field) ? fields.number(field) : geometry::kInfinity;
  };
  return {spacing("spacing.u"), spacing("spacing.v")};
}

}  // namespace lekalo::render
