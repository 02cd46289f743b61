// Built as the module lekalo_oiio, never into the library: the only file that includes OpenImageIO.
#include "render/image/oiio_module.h"

#include <OpenImageIO/imageio.h>

#include <exception>
#include <utility>
#include <vector>

using lekalo::render::Channel;
using lekalo::render::Image;
using lekalo::render::kMaximumPixels;
using lekalo::render::PixelType;

extern "C" __attribute__((visibility("default"))) bool lekalo_oiio_read(const char* path, Image& image,
                                                                        std::string& error) {
  try {
    OIIO::ImageSpec wish;
    wish["oiio:UnassociatedAlpha"] = 1;
    const auto input = OIIO::ImageInput::open(path, &wish);
    if (!input) {
      error = OIIO::geterror();
      return false;
    }
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 ||
        std::int64_t{spec.width} * spec.height > kMaximumPixels) {
      error = "unusual size: " + std::to_string(spec.width) + " x " + std::to_string(spec.height) + " x " +
              std::to_string(spec.depth) + " pixels, " + std::to_string(spec.nchannels) + " channels; " +
              lekalo::render::kTooManyPixels;
      return false;
    }
    const std::size_t channels = static_cast<std::size_t>(spec.nchannels);
    image = Image{};
    image.width = spec.width;
    image.height = spec.height;
    image.low_dynamic_range = !spec.format.is_floating_point();
    std::vector<float> pixels(image.pixel_count() * channels);
    if (!input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, pixels.data())) {
      error = input->geterror();
      return false;
    }
    const bool alpha = spec.alpha_channel >= 0;
    const int colors = spec.nchannels - (alpha ? 1 : 0);
    for (std::size_t c = 0; c < channels; ++c) {
      Channel channel;
      channel.name = spec.channel_name(static_cast<int>(c));
      if (alpha && static_cast<int>(c) == spec.alpha_channel) {
        channel.name = "A";
      } else if (colors == 1) {
        channel.name = "Y";
      }
      channel.type = PixelType::float32;
      channel.values = lekalo::render::PixelPlane<float>(image.pixel_count());
      for (std::size_t i = 0; i < channel.values.size(); ++i) channel.values[i] = pixels[i * channels + c];
      image.channels.push_back(std::move(channel));
    }
    return true;
  } catch (const std::exception& exception) {
    error = exception.what();
    return false;
  }
}
