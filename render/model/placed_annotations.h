// Annotations speak of geometry as it is written. Where one object alone shows that, or a solid that is made of it,
// they stand where it is placed.
#pragma once

#include <string>
#include <vector>

#include "render/model/model.h"

namespace lekalo::render {

// What the value of an annotation's field was taken from; kept beside it as `field.shape`.
struct ShapeSpokenOf {
  const void* shape = nullptr;    // identity()
  const void* operand = nullptr;  // the same of what stands for it in solids that are put together
  bool is_normal = false;         // of a direction: that of a surface's normal, which maps otherwise
};
inline std::string shape_field(const std::string& field) { return field + ".shape"; }

// The annotation as these objects place what it speaks of. Adds a note where that is in doubt, since several objects
// show it and none where it is written; then it stands there.
Annotation placed(const Annotation& annotation, const std::vector<Object>& objects, std::vector<std::string>& notes);

}  // namespace lekalo::render
