// The circles of detail views: the border of the view, and the mark of what it shows in another panel (ISO 128-3).
#pragma once

#include "render/drawing/annotations/annotation_work.h"
#include "render/model/detail.h"

namespace lekalo::render {

// On the page, millimetres.
struct PageCircle {
  Vec2 center{0};
  double radius = 0;
};
PageCircle circle_of(const View& view, const Detail& detail);
SheetBox box_of(const PageCircle& circle);

void add_detail_border(AnnotationWork& work);
void add_detail_circle(AnnotationWork& work);

}  // namespace lekalo::render
