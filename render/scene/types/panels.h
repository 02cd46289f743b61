// Panels of scene files until the scene's own drawing, camera and picture are known.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "render/cameras/cameras.h"
#include "render/model/detail.h"
#include "render/model/objects.h"
#include "render/model/section.h"

namespace lekalo::render {

struct PanelAsRead {
  std::optional<CameraFactory> camera;
  std::optional<Objects> objects;
  std::optional<geometry::Fields> drawing;  // by drawing_fields(); what it does not say the scene's drawing does
  std::shared_ptr<const Section> section;   // null: none
  DetailPtr detail;                         // null: none
  std::string title;                        // empty: none
};

std::vector<geometry::Field> layout_fields();
// Throws FieldError. The names of the panels are checked by the caller.
Layout layout_of(const geometry::Fields& fields);

}  // namespace lekalo::render
