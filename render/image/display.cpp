#include "render/image/display.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

namespace lekalo::render {

double srgb_encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double filmic(double linear) {
  const double x = 0.6 * linear;
  return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

namespace {

class Quantizer {
 public:
  explicit Quantizer(const DisplayTransform& transform)
      : scale_(std::exp2(transform.exposure)), curve_(transform.curve), levels_((1 << transform.bits) - 1) {}

  std::uint16_t level(double value) const {
    if (std::isnan(value)) return 0;
    return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, 1.0) * levels_));
  }

  std::uint16_t color_level(double radiance) const {
    double light = scale_ * radiance;
    // The curve is made for light; its denominator may vanish below zero, and infinity over infinity is no number.
    if (curve_ == ToneCurve::filmic && std::isfinite(light)) light = filmic(std::max(light, 0.0));
    return level(srgb_encode(std::clamp(light, 0.0, 1.0)));
  }

 private:
  double scale_;
  ToneCurve curve_;
  int levels_;
};

}  // namespace

DisplayResult to_display(const Image& image, const DisplayTransform& transform) {
  assert(transform.bits == 8 || transform.bits == 16);
  const ColorPlanes planes = color_planes(image);
  const bool grey = planes.r.data() == planes.g.data();
  const bool alpha = transform.alpha && !planes.alpha.empty();
  const int colors = grey ? 1 : 3;

  DisplayResult result;
  DisplayImage& display = result.image;
  display.width = image.width;
  display.height = image.height;
  display.channels = colors + (alpha ? 1 : 0);
  display.bits = transform.bits;
  display.samples.resize(image.pixel_count() * static_cast<std::size_t>(display.channels));
  for (const auto& [name, value] : image.metadata) {
    if (const auto* text = std::get_if<std::string>(&value)) display.text[name] = *text;
  }

  const Quantizer quantizer(transform);
  std::atomic<std::size_t> non_finite{0};
  const std::size_t width = static_cast<std::size_t>(image.width);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, static_cast<std::size_t>(image.height)), [&](const auto& rows) {
    std::size_t bad = 0;
    for (std::size_t i = rows.begin() * width; i < rows.end() * width; ++i) {
      const double rgb[3] = {planes.r[i], planes.g[i], planes.b[i]};
      const double opacity = alpha ? planes.alpha[i] : 1;
      if (!std::isfinite(rgb[0]) || !std::isfinite(rgb[1]) || !std::isfinite(rgb[2]) || !std::isfinite(opacity)) ++bad;
      std::uint16_t* out = &display.samples[i * static_cast<std::size_t>(display.channels)];
      for (int c = 0; c < colors; ++c) {
        out[c] = opacity > 0 ? quantizer.color_level(rgb[c] / opacity) : std::uint16_t{0};
      }
      if (alpha) out[colors] = quantizer.level(opacity);
    }
    non_finite += bad;
  });
  result.non_finite = non_finite;
  return result;
}

}  // namespace lekalo::render
