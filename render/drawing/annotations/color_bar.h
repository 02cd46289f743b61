// The scale of colours of lines that tell numbers, with these beside it.
#pragma once

#include "render/drawing/annotations/annotation_work.h"

namespace lekalo::render {

void add_color_bar(AnnotationWork& work);

}  // namespace lekalo::render
