// Reading a picture of whatever format: OpenEXR and PNG by this library itself, everything else (JPEG, TIFF, HDR, PFM,
// TGA, WebP, ...) by OpenImageIO, which is loaded as a module when such a file is first met: linked into the program it
// would cost every start 160 ms and 260 shared objects.
#pragma once

#include <filesystem>

#include "render/image/image.h"
#include "render/image/png.h"

namespace lekalo::render {

// Decides by the first bytes of the file, not by its name. Channels as in read_exr and read_png. `encoding` matters for
// formats with integer samples, which are taken as sRGB; floating-point files are linear already. Throws ImageError;
// also if the module is needed and missing. It is looked for in the folder that the environment variable
// LEKALO_MODULE_PATH names, beside the program, and in ../lib/lekalo from there. Thread-safe.
Image read_image(const std::filesystem::path& path, SampleEncoding encoding = SampleEncoding::linear);

}  // namespace lekalo::render
