// Drawings as DXF files (AutoCAD 2000, ASCII) for CAD: lines, arcs, circles, ellipses, splines and polylines in
// millimetres from the lower left corner, on layers by their kind: silhouette, silhouette-hidden, boundary, label, ...
#pragma once

#include <string>
#include <vector>

#include "render/drawing/sheet.h"

namespace lekalo::render {

struct DxfDrawing {
  std::string text;
  // What the format has no entities for: a sentence each.
  std::vector<std::string> notes;
};

// Fills of one colour are hatches; colours are the nearest of the format's 255.
DxfDrawing dxf_of(const Sheet& sheet);

}  // namespace lekalo::render
