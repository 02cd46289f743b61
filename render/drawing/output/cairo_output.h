// Drawings as PDF and as pixels, through Cairo and Pango.
#pragma once

#include <string>
#include <vector>

#include "render/drawing/sheet.h"

namespace lekalo::render {

// The file's bytes, the same for the same drawing: no clock in it. Texts are text, fonts embedded.
std::string pdf_of(const Sheet& sheet);

// The drawing on an opaque sheet of so many pixels.
DisplayImage pixels_of(const Sheet& sheet, int width, int height);

// The outlines of a run's characters, in the coordinates of its text.
std::vector<Path> text_outlines(const TextRun& run);

// A picture as the bytes of a PNG file.
std::string png_bytes(const DisplayImage& picture);

}  // namespace lekalo::render
