#include "render/image/read_image.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <mutex>
#include <string_view>

#include "render/image/display.h"
#include "render/image/exr.h"
#include "render/image/image_error.h"
#include "render/image/module.h"
#include "render/image/oiio_module.h"

namespace lekalo::render {
namespace fs = std::filesystem;
namespace {

using namespace std::string_view_literals;
constexpr std::string_view kExrMagic = "\x76\x2f\x31\x01"sv;
constexpr std::string_view kPngMagic = "\x89PNG\r\n\x1a\n"sv;

// Loads the module once; it stays loaded, because OpenImageIO keeps threads and caches of its own.
OiioRead& oiio_read(const fs::path& path) {
  static std::mutex mutex;
  static OiioRead* function = nullptr;
  const std::lock_guard lock(mutex);
  std::string tried;
  if (function == nullptr)
    function = reinterpret_cast<OiioRead*>(module_function(kOiioModuleFile, kOiioReadName, tried));
  if (function != nullptr) return *function;
  throw ImageError(path, "is neither OpenEXR nor PNG, and the module for other formats cannot be loaded" + tried,
                   "install libopenimageio2.4 and keep the module lekalo_oiio.so with the program, or convert the "
                   "picture to PNG or OpenEXR");
}

// Integer samples to linear light with associated alpha.
void decode(Image& image) {
  const Channel* alpha = find_channel(image, "A");
  for (Channel& channel : image.channels) {
    if (&channel == alpha) continue;
    for (std::size_t i = 0; i < channel.values.size(); ++i) {
      channel.values[i] = static_cast<float>(srgb_decode(channel.values[i]));
    }
  }
}

void associate_alpha(Image& image) {
  const Channel* alpha = find_channel(image, "A");
  if (alpha == nullptr) return;
  for (Channel& channel : image.channels) {
    if (&channel == alpha) continue;
    for (std::size_t i = 0; i < channel.values.size(); ++i) channel.values[i] *= alpha->values[i];
  }
}

Image read_other(const fs::path& path, SampleEncoding encoding) {
  Image image;
  std::string error;
  if (!oiio_read(path)(path.c_str(), image, error)) {
    while (!error.empty() && error.back() == '\n') error.pop_back();
    throw ImageError(path, "cannot read: " + error, "check that it is a picture, or convert it to PNG or OpenEXR");
  }
  if (encoding == SampleEncoding::linear) {
    if (image.low_dynamic_range) decode(image);
    associate_alpha(image);
  }
  return image;
}

}  // namespace

Image read_image(const fs::path& path, SampleEncoding encoding) {
  std::array<char, 8> first{};
  // Opening a pipe would wait for its writer.
  std::error_code ignored;
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))
    throw ImageError(path, "cannot read: it is no regular file", "a pipe or a folder is no picture");
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw ImageError(path, std::string("cannot read: ") + std::strerror(errno), "check the name and the permissions");
  file.read(first.data(), first.size());
  const std::string_view magic(first.data(), static_cast<std::size_t>(file.gcount()));
  file.close();
  if (magic.starts_with(kExrMagic)) return read_exr(path);
  if (magic.starts_with(kPngMagic)) return read_png(path, encoding);
  return read_other(path, encoding);
}

}  // namespace lekalo::render
