// A picture as plain data: named planes of numbers over one window, as an OpenEXR part has them.
//
// Colours are linear Rec.709 with associated (premultiplied) alpha, as OpenEXR prescribes; the film decides what else
// there is: R G B A, Z, P.X P.Y P.Z, N.*, Ng.*, uv.U uv.V, id.object id.material (uint), albedo.*, samples, direct.*.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "render/image/pixel_plane.h"

namespace lekalo::render {

// How a channel is stored in a file. In memory half and float32 are both float.
enum class PixelType { half, float32, uint32 };

struct Channel {
  std::string name;
  PixelType type = PixelType::float32;
  // One of the two has width * height entries, row by row from the top left pixel; the other is empty.
  PixelPlane<float> values;       // half, float32
  PixelPlane<std::uint32_t> ids;  // uint32
};

using MetadataValue = std::variant<std::string, int, double>;

struct Image {
  // The window that has pixels (OpenEXR: data window) and its upper left corner in the full picture.
  int width = 0, height = 0;
  int x = 0, y = 0;
  // The full picture (OpenEXR: display window, from (0, 0)); 0: as large as the data window.
  int full_width = 0, full_height = 0;
  std::vector<Channel> channels;
  std::map<std::string, MetadataValue> metadata;  // by name, as every file format sorts it
  bool low_dynamic_range = false;                 // read from integer samples: all values lie in [0, 1]

  std::size_t pixel_count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

// No picture that is read may have more pixels than this, the most that a picture of this program has: in a file of a
// few kilobytes they may be packed, and unpacked take gigabytes.
inline constexpr std::int64_t kMaximumPixels = 100'000'000;
inline constexpr const char* kTooManyPixels = "the file is damaged, or too large: at most 100 million pixels are read";

// Deflate (RFC 1951), the packing of PNG and most OpenEXR files, makes at most 1032 bytes of one. A file whose header
// promises more is damaged.
inline constexpr double kLargestDeflateRatio = 1032;

// A black picture without channels. Requires width, height >= 1.
Image make_image(int width, int height);

// Appends a channel of zeros. The reference is valid until the next channel is added.
Channel& add_channel(Image& image, std::string name, PixelType type = PixelType::float32);

// The channel of that exact name, or nullptr.
const Channel* find_channel(const Image& image, std::string_view name);
Channel* find_channel(Image& image, std::string_view name);

// The i-th number of a channel, of whichever type.
double value_at(const Channel& channel, std::size_t i);

// The colour planes of a picture. A picture with only luminance (channel Y) is grey: all three are the same plane.
struct ColorPlanes {
  std::span<const float> r, g, b;
  std::span<const float> alpha;  // empty without a channel A
};

// True if the picture has R, G and B, or Y, as floating-point channels.
bool has_color(const Image& image);

// Requires has_color(image).
ColorPlanes color_planes(const Image& image);

// NaN and infinite values among all floating-point channels.
std::size_t non_finite_count(const Image& image);

}  // namespace lekalo::render
