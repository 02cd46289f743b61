#include "render/image/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "render/image/display.h"
#include "render/image/flip.h"
#include "render/image/image_error.h"
#include "render/image/layers.h"
#include "render/image/read_image.h"

namespace lekalo::render {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::array<std::pair<const char*, Metric>, 5> kMetrics = {{{"flip", Metric::flip},
                                                                     {"rmse", Metric::rmse},
                                                                     {"psnr", Metric::psnr},
                                                                     {"ssim", Metric::ssim},
                                                                     {"max", Metric::max}}};

double strictest(Metric metric) {
  switch (metric) {
    case Metric::psnr:
      return kInfinity;
    case Metric::ssim:
      return 1;
    default:
      return 0;
  }
}

std::string size_text(const Image& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels";
}

// The part of a picture that a window of the same full picture has, if there is one.
std::optional<Image> part_of(const Image& whole, const Image& window) {
  const auto full = [](int known, int own) { return known > 0 ? known : own; };
  const bool same_picture =
      full(whole.full_width, whole.x + whole.width) == full(window.full_width, window.x + window.width) &&
      full(whole.full_height, whole.y + whole.height) == full(window.full_height, window.y + window.height);
  const int left = window.x - whole.x, top = window.y - whole.y;
  if (!same_picture || left < 0 || top < 0 || left + window.width > whole.width || top + window.height > whole.height)
    return std::nullopt;
  Image part = whole;
  part.width = window.width, part.height = window.height, part.x = window.x, part.y = window.y;
  const auto cut = [&](auto& plane) {
    if (plane.empty()) return;
    std::decay_t<decltype(plane)> kept(part.pixel_count());
    for (int y = 0; y < part.height; ++y)
      for (int x = 0; x < part.width; ++x)
        kept[static_cast<std::size_t>(y) * static_cast<std::size_t>(part.width) + static_cast<std::size_t>(x)] =
            plane[static_cast<std::size_t>(top + y) * static_cast<std::size_t>(whole.width) +
                  static_cast<std::size_t>(left + x)];
    plane = std::move(kept);
  };
  for (Channel& channel : part.channels) {
    cut(channel.values);
    cut(channel.ids);
  }
  return part;
}

bool same_window(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.x == b.x && a.y == b.y;
}

void require_same_window(const Image& a, const Image& b, const std::filesystem::path& path_a,
                         const std::filesystem::path& path_b) {
  if (a.width != b.width || a.height != b.height) {
    throw ImageError(path_b, "is " + size_text(b) + ", but " + path_a.string() + " is " + size_text(a),
                     "render both with the same --size");
  }
  if (a.x != b.x || a.y != b.y) {
    throw ImageError(path_b, "shows another part of the picture than " + path_a.string(),
                     "render both with the same --crop");
  }
}

// Colour is R, G, B in both, and alpha only where both have it; other layers must have the same channels.
void match_channels(Layer& a, Layer& b, bool color, const std::filesystem::path& path_a,
                    const std::filesystem::path& path_b) {
  if (color) {
    const bool alpha = find_channel(a.image, "A") != nullptr && find_channel(b.image, "A") != nullptr;
    for (Image* image : {&a.image, &b.image}) {
      if (!alpha) std::erase_if(image->channels, [](const Channel& channel) { return channel.name == "A"; });
      if (find_channel(*image, "R") != nullptr) {
        std::erase_if(image->channels, [](const Channel& channel) { return channel.name == "Y"; });
        continue;
      }
      Channel grey = *find_channel(*image, "Y");
      std::erase_if(image->channels, [](const Channel& channel) { return channel.name == "Y"; });
      for (const std::size_t c : {2, 1, 0}) {
        grey.name = std::string(1, "RGB"[c]);
        image->channels.insert(image->channels.begin(), grey);
      }
    }
    return;
  }
  const bool same =
      std::equal(a.image.channels.begin(), a.image.channels.end(), b.image.channels.begin(), b.image.channels.end(),
                 [](const Channel& p, const Channel& q) { return p.name == q.name; });
  if (!same) {
    throw ImageError(path_b, "has other channels in this layer than " + path_a.string(), "name one channel instead");
  }
}

bool same_non_finite(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

// Sets non-finite values of both to 0 and returns the pixels where the two pictures do not have the same ones.
std::vector<bool> clear_non_finite(Image& a, Image& b) {
  std::vector<bool> mismatch(a.pixel_count(), false);
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    PixelPlane<float>& va = a.channels[c].values;
    PixelPlane<float>& vb = b.channels[c].values;
    if (va.size() != vb.size()) continue;  // ids, which are always finite
    for (std::size_t i = 0; i < va.size(); ++i) {
      if (std::isfinite(va[i]) && std::isfinite(vb[i])) continue;
      if (!same_non_finite(va[i], vb[i])) mismatch[i] = true;
      va[i] = vb[i] = 0;
    }
  }
  return mismatch;
}

bool same_pixel(const Image& a, const Image& b, std::size_t i) {
  return std::equal(a.channels.begin(), a.channels.end(), b.channels.begin(), b.channels.end(),
                    [i](const Channel& p, const Channel& q) { return value_at(p, i) == value_at(q, i); });
}

std::vector<float> luminance(const Image& image) {
  const ColorPlanes planes = color_planes(image);
  std::vector<float> result(image.pixel_count());
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = 0.2126f * planes.r[i] + 0.7152f * planes.g[i] + 0.0722f * planes.b[i];
  }
  return result;
}

Image decoded(Image image) {
  for (Channel& channel : image.channels) {
    std::transform(channel.values.begin(), channel.values.end(), channel.values.begin(),
                   [](float v) { return static_cast<float>(srgb_decode(v)); });
  }
  return image;
}

void measure_flip(const Layer& a, const Layer& b, bool hdr, const Image& shown_a, const Image& shown_b,
                  float pixels_per_degree, ComparisonResult& result) {
  if (hdr) {
    HdrFlip flip = hdr_flip(a.image, b.image, pixels_per_degree);
    result.error = std::move(flip.error);
    result.start_exposure = flip.start_exposure;
    result.stop_exposure = flip.stop_exposure;
    result.exposure_count = flip.exposure_count;
  } else {
    result.error = ldr_flip(decoded(shown_a), decoded(shown_b), pixels_per_degree);
  }
}

}  // namespace

std::optional<Metric> metric_from_name(std::string_view name) {
  for (const auto& [text, metric] : kMetrics) {
    if (name == text) return metric;
  }
  return std::nullopt;
}

const char* metric_name(Metric metric) {
  return std::find_if(kMetrics.begin(), kMetrics.end(), [&](const auto& entry) { return entry.second == metric; })
      ->first;
}

bool larger_is_better(Metric metric) { return metric == Metric::psnr || metric == Metric::ssim; }

ComparisonResult compare_images(const Image& image_a, const Image& image_b, const std::filesystem::path& path_a,
                                const std::filesystem::path& path_b, const CompareOptions& options) {
  // A crop is compared with what the whole picture has there.
  if (!same_window(image_a, image_b)) {
    if (const auto part = part_of(image_a, image_b)) return compare_images(*part, image_b, path_a, path_b, options);
    if (const auto part = part_of(image_b, image_a)) return compare_images(image_a, *part, path_a, path_b, options);
  }
  require_same_window(image_a, image_b, path_a, path_b);
  const bool color = options.layer.empty() || options.layer == "color";
  Layer a = select_layer(image_a, options.layer, path_a);
  Layer b = select_layer(image_b, options.layer, path_b);
  match_channels(a, b, color, path_a, path_b);

  ComparisonResult result;
  result.path_a = path_a.string();
  result.path_b = path_b.string();
  result.layer = color ? "color" : options.layer;
  result.width = image_a.width;
  result.height = image_a.height;
  result.metric = options.metric;
  result.threshold = options.threshold.value_or(strictest(options.metric));
  result.non_finite_a = non_finite_count(a.image);
  result.non_finite_b = non_finite_count(b.image);
  const std::vector<bool> mismatch = clear_non_finite(a.image, b.image);
  result.non_finite_mismatches = static_cast<std::size_t>(std::count(mismatch.begin(), mismatch.end(), true));

  const ValueRange range = finite_range(a.image);
  const Image shown_a = display_values(a, range), shown_b = display_values(b, range);
  const bool any_integer = image_a.low_dynamic_range || image_b.low_dynamic_range;
  const Image& number_a = color && any_integer ? shown_a : a.image;
  const Image& number_b = color && any_integer ? shown_b : b.image;

  switch (options.metric) {
    case Metric::flip:
      measure_flip(a, b, a.kind == LayerKind::color && !any_integer, shown_a, shown_b, options.pixels_per_degree,
                   result);
      break;
    case Metric::ssim: {
      SsimResult similarity = ssim(luminance(shown_a), luminance(shown_b), result.width, result.height, 1);
      result.value = similarity.mean;
      result.error = std::move(similarity.map);
      break;
    }
    case Metric::psnr:
      result.error = absolute_difference(shown_a, shown_b);
      result.value = psnr(rmse(shown_a, shown_b), 1);
      break;
    case Metric::rmse:
      result.error = absolute_difference(number_a, number_b);
      result.value = rmse(number_a, number_b);
      break;
    case Metric::max:
      result.error = absolute_difference(number_a, number_b);
      break;
  }
  const bool bounded = options.metric == Metric::flip || options.metric == Metric::ssim;
  for (std::size_t i = 0; i < mismatch.size(); ++i) {
    if (mismatch[i]) result.error.values[i] = bounded ? 1.0f : std::numeric_limits<float>::infinity();
  }
  // Values near the largest float may leave no number, which sorting and maxima would forget.
  for (std::size_t i = 0; i < mismatch.size(); ++i) {
    float& error = result.error.values[i];
    if (!std::isnan(error)) continue;
    error = same_pixel(a.image, b.image, i) ? 0.0f : bounded ? 1.0f : std::numeric_limits<float>::infinity();
  }
  result.statistics = pool(result.error);
  if (options.metric == Metric::flip) result.value = result.statistics.mean;
  if (options.metric == Metric::max) result.value = result.statistics.maximum;
  if (result.non_finite_mismatches > 0) {
    if (options.metric == Metric::ssim) result.value = 1 - result.statistics.mean;
    if (options.metric == Metric::rmse) result.value = kInfinity;
    if (options.metric == Metric::psnr) result.value = -kInfinity;
  }
  const bool within =
      larger_is_better(options.metric) ? result.value >= result.threshold : result.value <= result.threshold;
  result.passed = within && result.non_finite_mismatches == 0;
  result.shown_a = quantize(shown_a);
  result.shown_b = quantize(shown_b);
  return result;
}

ComparisonResult compare_images(const std::filesystem::path& a, const std::filesystem::path& b,
                                const CompareOptions& options) {
  const Image image_a = read_image(a);
  const Image image_b = read_image(b);
  return compare_images(image_a, image_b, a, b, options);
}

}  // namespace lekalo::render
