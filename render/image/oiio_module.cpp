// Built as the module lekalo_oiio, never into the library: the only file that includes OpenImageIO.
#include "render/image/oiio_module.h"

#include <OpenImageIO/color.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <exception>
#include <utility>
#include <vector>

using lekalo::render::Channel;
using lekalo::render::ColorView;
using lekalo::render::ColorViewFault;
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

namespace {

// Names that configurations give to linear light with the primaries of Rec.709: those of ACES 1.3 and 1.2, of Blender.
constexpr const char* kLinearRec709[] = {"Linear Rec.709 (sRGB)",   "lin_rec709", "lin_srgb", "Linear Rec.709",
                                         "Utility - Linear - sRGB", "Linear"};

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMaxNames = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMaxNames); ++i) text += (i > 0 ? ", '" : "'") + names[i] + "'";
  return names.size() > kMaxNames ? text + ", and " + std::to_string(names.size() - kMaxNames) + " more" : text;
}

// The name, which is one of them; what it is by default where it is empty.
bool choose(std::string& name, const std::string& by_default, const std::vector<std::string>& names, const char* member,
            const std::string& where, ColorViewFault& fault) {
  if (name.empty()) name = by_default;
  if (has(names, name)) return true;
  if (name.empty())
    fault = {member, std::string("no ") + member + " of " + where + " is the usual one",
             "name one of " + listed(names)};
  else
    fault = {member, where + " has no " + member + " '" + name + "'", "it has " + listed(names)};
  return false;
}

std::string linear_rec709(const OIIO::ColorConfig& config) {
  const std::vector<std::string> spaces = config.getColorSpaceNames();
  for (const char* name : kLinearRec709) {
    if (has(spaces, name)) return name;
    for (const std::string& space : spaces)
      if (has(config.getAliases(space), name)) return space;
  }
  return {};
}

bool complete(const OIIO::ColorConfig& config, ColorView& view, ColorViewFault& fault) {
  const std::vector<std::string> displays = config.getDisplayNames();
  if (displays.empty()) {
    fault = {"config", "the configuration has no display", ""};
    return false;
  }
  const std::string all = "the configuration";
  if (!choose(view.display, displays.front(), displays, "display", all, fault)) return false;
  const std::vector<std::string> views = config.getViewNames(view.display);
  if (!choose(view.view, views.empty() ? "" : views.front(), views, "view", "the display '" + view.display + "'",
              fault))
    return false;
  return choose(view.space, linear_rec709(config), config.getColorSpaceNames(), "space", all, fault);
}

}  // namespace

extern "C" __attribute__((visibility("default"))) bool lekalo_oiio_color_view(ColorView& view, int width, int height,
                                                                              float* rgb, ColorViewFault& fault) {
  try {
    OIIO::ColorConfig config(view.config);
    if (config.has_error()) {
      fault = {"config", "cannot be read: " + config.geterror(), "a configuration of OpenColorIO, usually config.ocio"};
      return false;
    }
    if (!complete(config, view, fault)) return false;
    const auto transform = config.createDisplayTransform(view.display, view.view, view.space, view.looks);
    if (!transform) {
      fault = {"view", "OpenColorIO cannot show it: " + config.geterror(), "look at the files that the view names"};
      return false;
    }
    if (rgb == nullptr) return true;
    OIIO::ImageBuf pixels(OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::FLOAT), rgb);
    if (OIIO::ImageBufAlgo::colorconvert(pixels, pixels, transform.get(), false)) return true;
    fault = {"view", pixels.geterror(), ""};
  } catch (const std::exception& exception) {
    fault = {"config", exception.what(), ""};
  }
  return false;
}
