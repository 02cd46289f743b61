// The one function of the module that wraps OpenImageIO, as the program finds it by name.
#pragma once

#include <string>

#include "render/image/image.h"

namespace lekalo::render {

// Fills width, height, channels (R G B A or Y A; others by their own names) with the first picture of the file, the
// numbers as OpenImageIO delivers them: integers divided by their maximum, alpha not multiplied in. Sets
// low_dynamic_range for files of integers. False: `error` says why. Throws nothing, because program
// and module may not share exception types.
using OiioRead = bool(const char* path, Image& image, std::string& error);

inline constexpr const char* kOiioModuleFile = "lekalo_oiio.so";
inline constexpr const char* kOiioReadName = "lekalo_oiio_read";

}  // namespace lekalo::render
