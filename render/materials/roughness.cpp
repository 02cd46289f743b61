#include "render/materials/roughness.h"

#include <algorithm>

namespace lekalo::render {

double Roughness::at(const SurfacePoint& point) const {
  return texture ? std::clamp(static_cast<double>(texture->at(point)[0]), 0.0, 1.0) : value;
}

TabledRoughness::TabledRoughness(const Roughness& roughness, const std::function<LobeAlbedoPtr(double)>& make)
    : roughness_(roughness) {
  if (roughness.texture)
    levels_.emplace(make);
  else
    albedo_ = make(roughness.value);
}

TabledRoughness::Value TabledRoughness::at(const SurfacePoint& point) const {
  if (!levels_) return {roughness_.value, albedo_.get()};
  const double rounded = AlbedoLevels::rounded(roughness_.at(point));
  return {rounded, &(*levels_)[rounded]};
}

void declare_roughness(geometry::TypeDeclaration& type, const std::string& name, const std::string& description,
                       const std::string& standard) {
  type.field(name, geometry::number().between(0, 1), description, standard)
      .optional(name + "_texture", geometry::reference({geometry::Category::texture}),
                "in place of " + name + ": its red channel, 0 to 1");
}

Roughness roughness(const geometry::Fields& fields, const std::string& name) {
  Roughness roughness = fields.number(name);
  if (fields.has(name + "_texture")) roughness.texture = fields.get<TexturePtr>(name + "_texture");
  return roughness;
}

}  // namespace lekalo::render
