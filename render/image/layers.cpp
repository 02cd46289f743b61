#include "render/image/layers.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "render/image/display.h"
#include "render/image/image_error.h"

namespace lekalo::render {
namespace {

struct NamedLayer {
  const char* name;
  const char* channels;  // OpenEXR layer or channel
  LayerKind kind;
};

constexpr NamedLayer kNamedLayers[] = {
    {"normal", "N", LayerKind::direction}, {"geometric_normal", "Ng", LayerKind::direction},
    {"depth", "Z", LayerKind::measure},    {"position", "P", LayerKind::measure},
    {"uv", "uv", LayerKind::measure},      {"albedo", "albedo", LayerKind::color}};

bool is_color_channel(std::string_view name) {
  return name == "R" || name == "G" || name == "B" || name == "A" || name == "Y";
}

// The part before the last dot: OpenEXR's layer.
std::string_view layer_of(std::string_view channel) { return channel.substr(0, channel.rfind('.')); }

std::string_view component_of(std::string_view channel) {
  const std::size_t dot = channel.rfind('.');
  return dot == std::string_view::npos ? channel : channel.substr(dot + 1);
}

// R G B A, X Y Z, U V stand in their usual order, whatever the file's; others follow by name.
std::tuple<std::size_t, std::string_view> order(const Channel& channel) {
  constexpr std::string_view kOrder = "RGBXYZUVA";
  const std::string_view component = component_of(channel.name);
  const std::size_t rank = component.size() == 1 ? kOrder.find(component[0]) : std::string_view::npos;
  return {std::min(rank, kOrder.size()), channel.name};
}

std::string layer_names(const Image& image) {
  std::set<std::string> names;
  for (const Channel& channel : image.channels) {
    std::string name(is_color_channel(channel.name) ? "color" : layer_of(channel.name));
    for (const NamedLayer& known : kNamedLayers) {
      if (name == known.channels) name = known.name;
    }
    names.insert(name);
  }
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

// Whether a channel belongs to a layer, given by its name in files; empty: colour.
bool belongs(const Channel& channel, const std::string& layer) {
  if (layer.empty()) return is_color_channel(channel.name);
  return channel.name == layer || channel.name.starts_with(layer + ".");
}

// The OpenEXR layer or channel that a user's name means; empty: colour.
std::string channels_of(const std::string& name) {
  if (name.empty() || name == "color") return {};
  for (const NamedLayer& known : kNamedLayers)
    if (name == known.name) return known.channels;
  return name;
}

}  // namespace

Image keep_layer(Image image, const std::string& name, const std::filesystem::path& file) {
  select_layer(image, name, file);  // complains if it is missing
  std::erase_if(image.channels, [&](const Channel& channel) { return !belongs(channel, channels_of(name)); });
  return image;
}

Layer select_layer(const Image& image, const std::string& name, const std::filesystem::path& file) {
  const bool color = name.empty() || name == "color";
  Layer layer;
  layer.kind = color ? LayerKind::color : LayerKind::measure;
  const std::string channels = channels_of(name);
  for (const NamedLayer& known : kNamedLayers) {
    if (channels == known.channels) layer.kind = known.kind;
  }
  layer.image = make_image(image.width, image.height);
  std::vector<Channel>& found = layer.image.channels;
  std::copy_if(image.channels.begin(), image.channels.end(), std::back_inserter(found),
               [&](const Channel& channel) { return belongs(channel, channels); });
  if (found.empty() || (color && !has_color(layer.image))) {
    throw ImageError(file, "has no layer '" + (color ? "color" : name) + "'", "it has: " + layer_names(image));
  }
  std::sort(found.begin(), found.end(), [](const Channel& a, const Channel& b) { return order(a) < order(b); });
  if (!color) {
    std::vector<std::string> names;
    for (Channel& channel : found) {
      names.push_back(channel.name);
      channel.name = component_of(channel.name);
    }
    if (has_color(layer.image)) {
      layer.kind = LayerKind::color;
    } else {
      if (layer.kind == LayerKind::color) layer.kind = LayerKind::measure;
      for (std::size_t c = 0; c < names.size(); ++c) found[c].name = names[c];
    }
  }
  return layer;
}

ValueRange finite_range(const Image& image) {
  ValueRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Channel& channel : image.channels) {
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
      const double value = value_at(channel, i);
      if (!std::isfinite(value)) continue;
      range.low = std::min(range.low, value);
      range.high = std::max(range.high, value);
    }
  }
  if (range.low > range.high) return {};
  if (range.low == range.high) range.high = range.low + 1;
  return range;
}

Image display_values(const Layer& layer, const ValueRange& range) {
  const auto shown = [&](double value) {
    switch (layer.kind) {
      case LayerKind::color:
        value = srgb_encode(std::clamp(value, 0.0, 1.0));
        break;
      case LayerKind::direction:
        value = 0.5 * value + 0.5;
        break;
      case LayerKind::measure:
        value = (value - range.low) / (range.high - range.low);
        break;
    }
    return std::isnan(value) ? 0.0f : static_cast<float>(std::clamp(value, 0.0, 1.0));
  };
  const std::vector<Channel>& in = layer.image.channels;
  std::vector<const Channel*> sources;
  for (const Channel& channel : in) {
    if (component_of(channel.name) != "A" || in.size() == 1) sources.push_back(&channel);
  }
  if (sources.size() == 1) sources = {sources[0], sources[0], sources[0]};
  Image result = make_image(layer.image.width, layer.image.height);
  for (std::size_t c = 0; c < 3; ++c) {
    Channel& channel = add_channel(result, std::string(1, "RGB"[c]));
    if (c >= sources.size()) continue;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, channel.values.size()), [&](const auto& pixels) {
      for (std::size_t i = pixels.begin(); i < pixels.end(); ++i) channel.values[i] = shown(value_at(*sources[c], i));
    });
  }
  return result;
}

DisplayImage quantize(const Image& display_values) {
  const ColorPlanes planes = color_planes(display_values);
  DisplayImage result{.width = display_values.width, .height = display_values.height, .samples = {}, .text = {}};
  result.samples.resize(3 * display_values.pixel_count());
  for (std::size_t i = 0; i < display_values.pixel_count(); ++i) {
    result.samples[3 * i] = static_cast<std::uint16_t>(std::lround(255 * planes.r[i]));
    result.samples[3 * i + 1] = static_cast<std::uint16_t>(std::lround(255 * planes.g[i]));
    result.samples[3 * i + 2] = static_cast<std::uint16_t>(std::lround(255 * planes.b[i]));
  }
  return result;
}

}  // namespace lekalo::render
