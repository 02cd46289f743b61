// A scene file with what it says of its elements beside their shapes.
#pragma once

#include "render/model/attributes.h"
#include "render/scene/build/load.h"

namespace lekalo::render {

struct SceneWithAttributes : LoadedScene {
  AttributeTable attributes;  // of the model's geometry
};

// Throws SceneError as load_scene() does.
SceneWithAttributes load_with_attributes(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace lekalo::render
