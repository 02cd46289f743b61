// Angles and dimensions: lines with arrow heads and a number, in space (arcs) or on the page.
#pragma once

#include "render/drawing/annotations/annotation_work.h"

namespace lekalo::render {

void add_angle(AnnotationWork& work);
void add_angle_dimension(AnnotationWork& work);
void add_linear_dimension(AnnotationWork& work);
// Of a radius, or of a diameter.
void add_round_dimension(AnnotationWork& work, bool diameter);

}  // namespace lekalo::render
