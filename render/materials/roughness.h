// Numbers in [0, 1] of a surface, roughness and the weights of layers: a number, or a texture whose red lane is it.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "geometry/describe.h"
#include "render/lobes/lobe_albedo.h"
#include "render/material.h"

namespace lekalo::render {

struct Roughness {
  double value = 0;
  TexturePtr texture;  // in place of it

  Roughness(double constant = 0) : value(constant) {}
  double at(const SurfacePoint& point) const;
};

// The roughness of lobes that need a table of their reflectance, and that table.
class TabledRoughness {
 public:
  TabledRoughness(const Roughness& roughness, const std::function<LobeAlbedoPtr(double roughness)>& make);

  struct Value {
    double roughness;
    const LobeAlbedo* albedo;
  };
  Value at(const SurfacePoint& point) const;

 private:
  Roughness roughness_;
  LobeAlbedoPtr albedo_;                // of a number
  std::optional<AlbedoLevels> levels_;  // of a texture
};

// Fields NAME, a number in [0, 1], and NAME_texture.
void declare_roughness(geometry::TypeDeclaration& type, const std::string& name, const std::string& description,
                       const std::string& standard);
Roughness roughness(const geometry::Fields& fields, const std::string& name);

}  // namespace lekalo::render
