// The functions of the module that wraps OpenImageIO, as the program finds them by name. They throw nothing, because
// program and module may not share exception types.
#pragma once

#include <string>

#include "render/image/color_view.h"
#include "render/image/image.h"

namespace lekalo::render {

// Fills width, height, channels (R G B A or Y A; others by their own names) with the first picture of the file, the
// numbers as OpenImageIO delivers them: integers divided by their maximum, alpha not multiplied in. Sets
// low_dynamic_range for files of integers. False: `error` says why.
using OiioRead = bool(const char* path, Image& image, std::string& error);

// Completes the view as complete() of color_view.h does, and where `rgb` is not null applies it to width * height
// pixels. False: `fault` says why.
using OiioColorView = bool(ColorView& view, int width, int height, float* rgb, ColorViewFault& fault);

inline constexpr const char* kOiioModuleFile = "lekalo_oiio.so";
inline constexpr const char* kOiioReadName = "lekalo_oiio_read";
inline constexpr const char* kOiioColorViewName = "lekalo_oiio_color_view";

}  // namespace lekalo::render
