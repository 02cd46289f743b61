// The lines of a drawing as groups of paths: of each object, in it of each kind. What goes on in one another is one
// path.
#pragma once

#include <string>
#include <vector>

#include "render/drawing/paths/joined_paths.h"
#include "render/drawing/sheet.h"

namespace lekalo::render {

// What one pen draws of an object's lines of one kind.
struct DrawnLines {
  int object = -1;   // number; -1: of the drawing
  std::string name;  // of the object
  std::string line;  // boundary, silhouette, ...
  std::string kind;  // the same with the classes of hidden ones
  LineLook pen;
  std::vector<PathInSpace> paths;  // on the sheet
  std::vector<SheetItem> heads;    // of arrows
};

// `found`: from the last, which lies over all others. Ends that are nearer than `same` in space are one; paths no
// larger than `dot` are left out.
SheetGroup line_groups(std::vector<DrawnLines> found, bool hidden, double same, double dot);

// The last group, if it is of this kind and object, or a new one.
SheetGroup& group_of(SheetGroup& all, const std::string& kind, const std::string& object);

}  // namespace lekalo::render
