#include "render/image/color_view.h"

#include <mutex>

#include "render/image/image_error.h"
#include "render/image/module.h"
#include "render/image/oiio_module.h"

namespace lekalo::render {

namespace {

// Null if there is no module; `tried` says where it was looked for.
OiioColorView* color_view_function(std::string& tried) {
  static std::mutex mutex;
  static OiioColorView* function = nullptr;
  const std::lock_guard lock(mutex);
  if (function == nullptr)
    function = reinterpret_cast<OiioColorView*>(module_function(kOiioModuleFile, kOiioColorViewName, tried));
  return function;
}

constexpr const char* kInstall = "install libopenimageio2.4 and keep the module lekalo_oiio.so with the program";

}  // namespace

ColorViewFault complete(ColorView& view) {
  std::string tried;
  OiioColorView* function = color_view_function(tried);
  if (function == nullptr) return {"config", "the module that knows OpenColorIO cannot be loaded" + tried, kInstall};
  ColorViewFault fault;
  function(view, 0, 0, nullptr, fault);
  return fault;
}

void apply(const ColorView& view, int width, int height, std::vector<float>& rgb) {
  std::string tried;
  OiioColorView* function = color_view_function(tried);
  if (function == nullptr)
    throw ImageError(view.config, "the module that knows OpenColorIO cannot be loaded" + tried, kInstall);
  ColorView complete = view;
  ColorViewFault fault;
  if (!function(complete, width, height, rgb.data(), fault)) throw ImageError(view.config, fault.message, fault.hint);
}

}  // namespace lekalo::render
