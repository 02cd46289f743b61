#include "render/image/image.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace lekalo::render {

Image make_image(int width, int height) {
  assert(width >= 1 && height >= 1);
  Image image;
  image.width = width;
  image.height = height;
  return image;
}

Channel& add_channel(Image& image, std::string name, PixelType type) {
  Channel channel{.name = std::move(name), .type = type, .values = {}, .ids = {}};
  if (type == PixelType::uint32)
    channel.ids = PixelPlane<std::uint32_t>(image.pixel_count());
  else
    channel.values = PixelPlane<float>(image.pixel_count());
  return image.channels.emplace_back(std::move(channel));
}

const Channel* find_channel(const Image& image, std::string_view name) {
  const auto found =
      std::find_if(image.channels.begin(), image.channels.end(), [&](const Channel& c) { return c.name == name; });
  return found == image.channels.end() ? nullptr : &*found;
}

Channel* find_channel(Image& image, std::string_view name) {
  return const_cast<Channel*>(find_channel(std::as_const(image), name));
}

double value_at(const Channel& channel, std::size_t i) {
  return channel.type == PixelType::uint32 ? static_cast<double>(channel.ids[i])
                                           : static_cast<double>(channel.values[i]);
}

namespace {

const Channel* find_float_channel(const Image& image, std::string_view name) {
  const Channel* channel = find_channel(image, name);
  return channel != nullptr && channel->type != PixelType::uint32 ? channel : nullptr;
}

}  // namespace

bool has_color(const Image& image) {
  const bool rgb = find_float_channel(image, "R") && find_float_channel(image, "G") && find_float_channel(image, "B");
  return rgb || find_float_channel(image, "Y") != nullptr;
}

ColorPlanes color_planes(const Image& image) {
  assert(has_color(image));
  ColorPlanes planes;
  const Channel* r = find_float_channel(image, "R");
  const Channel* g = find_float_channel(image, "G");
  const Channel* b = find_float_channel(image, "B");
  if (r == nullptr || g == nullptr || b == nullptr) r = g = b = find_float_channel(image, "Y");
  planes.r = r->values;
  planes.g = g->values;
  planes.b = b->values;
  if (const Channel* a = find_float_channel(image, "A")) planes.alpha = a->values;
  return planes;
}

std::size_t non_finite_count(const Image& image) {
  std::size_t count = 0;
  for (const Channel& channel : image.channels) {
    count += static_cast<std::size_t>(
        std::count_if(channel.values.begin(), channel.values.end(), [](float v) { return !std::isfinite(v); }));
  }
  return count;
}

}  // namespace lekalo::render
