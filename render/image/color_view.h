// Views of an OpenColorIO configuration: a display transform that a studio or a journal keeps in a file. Applied by
// OpenColorIO through the module that loads OpenImageIO.
#pragma once

#include <string>
#include <vector>

namespace lekalo::render {

struct ColorView {
  std::string config;  // file of the configuration
  std::string display, view;
  std::string space;  // of the configuration: linear light with the primaries of Rec.709, which pictures hold
  std::string looks;  // separated by commas; may be empty
};

// What of a view is wrong: its member, or "config".
struct ColorViewFault {
  std::string member, message, hint;
};

// Fills in an empty display, view or space with the configuration's own: its first display, the first view of that, and
// of its spaces the first that has a usual name of linear Rec.709. An empty member of the result: nothing is wrong.
// Thread-safe.
ColorViewFault complete(ColorView& view);

// Of a complete view. `rgb` has three numbers for each of the width * height pixels: linear light, not premultiplied;
// then what the display is to be sent, not yet clipped to 0 to 1. Throws ImageError.
void apply(const ColorView& view, int width, int height, std::vector<float>& rgb);

}  // namespace lekalo::render
