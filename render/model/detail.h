// Detail views of drawings: what a circle holds of a view, enlarged, with its letter and its own scale (ISO 128-3).
#pragma once

#include <memory>
#include <string>

#include "geometry/describe.h"
#include "render/model/page.h"

namespace lekalo::render {

struct Detail {
  geometry::Vec3 around{0};  // the middle of the circle
  double radius = 1;         // scene units
  double scale = 0;          // millimetres of paper for one of the model; 0: as large as there is room
  std::string title;         // its letter, TeX; empty: none
};
using DetailPtr = std::shared_ptr<const Detail>;

std::vector<geometry::Field> detail_fields();
Detail detail_of(const geometry::Fields& fields);

// What stands over the view: B (5:1), without a scale of its own B.
std::string view_title(const Detail& detail);

// The border of a detail view is an annotation of its drawing: so the drawing knows what it is cut at.
constexpr const char* kDetailBorder = "detail_border";
Annotation border_of(DetailPtr detail, Style style);
// Null where a drawing is none.
DetailPtr detail_of(const DrawingChoices& drawing);

}  // namespace lekalo::render
