// Layers of a picture: the channels that belong together, by the name that a user gives, and how a display shows them.
#pragma once

#include <filesystem>
#include <string>

#include "render/image/image.h"
#include "render/image/png.h"

namespace lekalo::render {

// What the numbers of a layer are, which decides how they are shown.
enum class LayerKind {
  color,      // linear light, shown as it is
  direction,  // components in [-1, 1]: v / 2 + 1/2
  measure     // anything else (depth, position, uv, counts, ids): the layer's own range becomes black to white
};

struct Layer {
  LayerKind kind = LayerKind::color;
  // Only the layer's channels, in the order R G B, X Y Z, U V, A, others by name. Those of a colour layer are called
  // R G B A, whatever the layer.
  Image image;
};

// Picks a layer: "color" (or "", the default: R G B A or Y A), "normal" (N.*), "geometric_normal" (Ng.*), "depth" (Z),
// "position" (P.*), "uv", "albedo", or any OpenEXR layer or channel name. Throws ImageError naming `file` and the
// layers that there are.
Layer select_layer(const Image& image, const std::string& name, const std::filesystem::path& file);

// The picture with the channels of one layer only, under their own names, with window and metadata: what a golden
// picture keeps. `name` and errors as for select_layer.
Image keep_layer(Image image, const std::string& name, const std::filesystem::path& file);

// The finite values of a layer; (0, 1) if there are none, never an empty range.
struct ValueRange {
  double low = 0, high = 1;
};
ValueRange finite_range(const Image& image);

// What a display shows of a layer: R G B in [0, 1], sRGB encoded, not rounded. `range` is for LayerKind::measure.
// The first three channels count (one becomes grey, of two the third colour is 0); alpha: before black.
Image display_values(const Layer& layer, const ValueRange& range);

// 8-bit pixels of display_values.
DisplayImage quantize(const Image& display_values);

}  // namespace lekalo::render
