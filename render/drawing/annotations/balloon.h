// The number of a part in a circle, with a line to the part (ISO 6433).
#pragma once

#include "render/drawing/annotations/annotation_work.h"

namespace lekalo::render {

void add_balloon(AnnotationWork& work);

}  // namespace lekalo::render
