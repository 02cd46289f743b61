// The line along which a section of another panel cuts, with its letters and the way it is looked at (ISO 128-3).
#pragma once

#include "render/drawing/annotations/annotation_work.h"

namespace lekalo::render {

void add_cutting_plane(AnnotationWork& work);

}  // namespace lekalo::render
