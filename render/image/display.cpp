// Eight bits of a channel are found in a table and not by the curve: the least light of each level is known, and so is
// the level at which each of kSteps equal parts of the light begins. The same numbers as by the curve, in a tenth of
// the time.
#include "render/image/display.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace lekalo::render {

double srgb_encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

namespace {

constexpr double kMaxLight = 1e9;

std::uint16_t level_of(double value, int levels) {
  if (std::isnan(value)) return 0;
  return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, 1.0) * levels));
}

// The 8-bit levels of sRGB by their light, as level_of(srgb_encode(light), 255) gives them.
class SrgbLevels {
 public:
  SrgbLevels() {
    const auto level = [](double light) { return level_of(srgb_encode(light), 255); };
    for (int k = 1; k < 256; ++k) {
      // The inverse of the curve, and the few doubles beside it that its rounding and that of the curve leave open.
      double light = srgb_decode((k - 0.5) / 255);
      while (level(light) >= k) light = std::nextafter(light, 0.0);
      while (level(light) < k) light = std::nextafter(light, 1.0);
      least_[k] = light;
    }
    least_[256] = std::numeric_limits<double>::infinity();
    for (int step = 0, k = 0; step <= kSteps; ++step) {
      while (least_[k + 1] <= step / double(kSteps)) ++k;
      at_step_[step] = static_cast<std::uint8_t>(k);
    }
  }
  // 0 <= light <= 1.
  std::uint16_t operator()(double light) const {
    std::uint16_t level = at_step_[static_cast<int>(light * kSteps)];
    while (light >= least_[level + 1]) ++level;
    return level;
  }

 private:
  static constexpr int kSteps = 4096;  // the curve rises by at most 12.92 * 255 levels: less than one a step
  std::array<double, 257> least_{};
  std::array<std::uint8_t, kSteps + 1> at_step_{};
};

class Quantizer {
 public:
  explicit Quantizer(const DisplayTransform& transform)
      : scale_(std::exp2(transform.exposure)), curve_(transform.curve), levels_((1 << transform.bits) - 1) {
    static const SrgbLevels eight_bits;
    if (transform.bits == 8) srgb_ = &eight_bits;
  }

  std::uint16_t level(double value) const { return level_of(value, levels_); }

  // Exposed, and by the curve. Curves are made for light, and infinity over infinity is no number.
  std::array<double, 3> light_of(std::array<double, 3> radiance) const {
    for (double& light : radiance) light *= scale_;
    if (curve_ == ToneCurve::none || !std::isfinite(radiance[0] + radiance[1] + radiance[2])) return radiance;
    for (double& light : radiance) light = std::max(light, 0.0);
    return toned(curve_, radiance);
  }

  std::uint16_t color_level(double light) const {
    if (!(light > 0)) return 0;  // NaN too
    light = std::min(light, 1.0);
    return srgb_ ? (*srgb_)(light) : level(srgb_encode(light));
  }

 private:
  double scale_;
  ToneCurve curve_;
  int levels_;
  const SrgbLevels* srgb_ = nullptr;  // of 8 bits
};

// What a display is to be sent by the view. Infinite light is the largest, as no transform knows what to do with it.
std::vector<float> seen(const ColorPlanes& planes, const Image& image, const DisplayTransform& transform, bool alpha) {
  const double scale = std::exp2(transform.exposure);
  std::vector<float> rgb(3 * image.pixel_count());
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const double opacity = alpha ? planes.alpha[i] : 1;
    if (!(opacity > 0)) continue;
    const float radiance[3] = {planes.r[i], planes.g[i], planes.b[i]};
    for (std::size_t c = 0; c < 3; ++c) {
      const double light = scale * radiance[c] / opacity;
      rgb[3 * i + c] = std::isnan(light) ? 0 : static_cast<float>(std::clamp(light, -kMaxLight, kMaxLight));
    }
  }
  apply(*transform.view, image.width, image.height, rgb);
  return rgb;
}

}  // namespace

DisplayResult to_display(const Image& image, const DisplayTransform& transform) {
  assert(transform.bits == 8 || transform.bits == 16);
  const ColorPlanes planes = color_planes(image);
  const bool grey = planes.r.data() == planes.g.data() && !transform.view;
  const bool alpha = transform.alpha && !planes.alpha.empty();
  const int colors = grey ? 1 : 3;

  DisplayResult result;
  DisplayImage& display = result.image;
  display.width = image.width;
  display.height = image.height;
  display.channels = colors + (alpha ? 1 : 0);
  display.bits = transform.bits;
  display.is_srgb = !transform.view;
  display.samples.resize(image.pixel_count() * static_cast<std::size_t>(display.channels));
  for (const auto& [name, value] : image.metadata) {
    if (const auto* text = std::get_if<std::string>(&value)) display.text[name] = *text;
  }

  const Quantizer quantizer(transform);
  const std::vector<float> viewed = transform.view ? seen(planes, image, transform, alpha) : std::vector<float>();
  std::atomic<std::size_t> non_finite{0};
  const std::size_t width = static_cast<std::size_t>(image.width);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, static_cast<std::size_t>(image.height)), [&](const auto& rows) {
    std::size_t bad = 0;
    for (std::size_t i = rows.begin() * width; i < rows.end() * width; ++i) {
      const double rgb[3] = {planes.r[i], planes.g[i], planes.b[i]};
      const double opacity = alpha ? planes.alpha[i] : 1;
      if (!std::isfinite(rgb[0] + rgb[1] + rgb[2] + opacity)) ++bad;  // sums of floats are no larger than doubles
      std::uint16_t* out = &display.samples[i * static_cast<std::size_t>(display.channels)];
      if (!viewed.empty()) {
        for (size_t c = 0; c < 3; ++c) out[c] = quantizer.level(viewed[3 * i + c]);
      } else if (!alpha || opacity > 0) {
        const std::array<double, 3> light = quantizer.light_of({rgb[0] / opacity, rgb[1] / opacity, rgb[2] / opacity});
        for (int c = 0; c < colors; ++c) out[c] = quantizer.color_level(light[static_cast<size_t>(c)]);
      } else {
        std::fill_n(out, colors, std::uint16_t{0});
      }
      if (alpha) out[colors] = quantizer.level(opacity);
    }
    non_finite += bad;
  });
  result.non_finite = non_finite;
  return result;
}

}  // namespace lekalo::render
