// OpenEXR files (OpenEXR 3.1, "OpenEXR File Layout"): scan lines, ZIP compression, increasing rows.
#pragma once

#include <filesystem>

#include "render/image/image.h"

namespace lekalo::render {

// Reads every channel of the first part, scan lines or tiles, and the attributes that are text or numbers. The data
// window is moved so that the display window begins at (0, 0). Throws ImageError: unreadable, damaged, deep,
// subsampled channels, more than kMaximumPixels.
Image read_exr(const std::filesystem::path& path);

// Writes all channels with their pixel types; finite values beyond half's largest (65504) become that. Text metadata
// become string attributes, integers int, numbers float where that is exact and else double. The same image gives
// the same bytes: no clock, supporting surface or program name. Atomic (AtomicFile). Throws ImageError; among the
// reasons: metadata under a name that OpenEXR itself uses (channels, dataWindow, ...), no channels, the same channel
// twice.
void write_exr(const std::filesystem::path& path, const Image& image);

}  // namespace lekalo::render
