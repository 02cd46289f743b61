// Panels of scene files until the scene's own drawing, camera and picture are known.
#pragma once

#include <optional>

#include "render/cameras/cameras.h"
#include "render/model/objects.h"

namespace lekalo::render {

struct PanelAsRead {
  std::optional<CameraFactory> camera;
  std::optional<Objects> objects;
  std::optional<geometry::Fields> drawing;  // by drawing_fields(); what it does not say the scene's drawing does
};

std::vector<geometry::Field> layout_fields();
// Throws FieldError. The names of the panels are checked by the caller.
Layout layout_of(const geometry::Fields& fields);

}  // namespace lekalo::render
