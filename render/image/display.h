// From light to a display: the one stated transform between an Image and the numbers of a PNG.
//
//   value = OETF(curve(2^exposure * radiance)), rounded to the nearest of 2^bits levels, without dithering.
//
// OETF: IEC 61966-2-1 (sRGB), the exact two-part curve: 12.92 x up to 0.0031308, then 1.055 x^(1/2.4) - 0.055.
// Curve: none (values above 1 clip) or filmic: K. Narkowicz, "ACES Filmic Tone Mapping Curve" (2015),
//   f(x) = x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14), taken at 0.6 times the radiance (his remark on the
//   original's exposure), as HDR-FLIP takes it too (Andersson et al. 2021); it reaches 1 at 12.1 times white.
#pragma once

#include <cstddef>

#include "render/image/image.h"
#include "render/image/png.h"

namespace lekalo::render {

enum class ToneCurve { none, filmic };

struct DisplayTransform {
  double exposure = 0;  // stops: +1 doubles the light
  ToneCurve curve = ToneCurve::none;
  int bits = 8;        // 8 or 16
  bool alpha = false;  // keep the channel A (colours are divided by it); without it the picture stands before black
};

// sRGB of linear light and back, for values in [0, 1]; both continue below 0 and above 1 by the same formulas.
double srgb_encode(double linear);
double srgb_decode(double encoded);

// The filmic curve above, the factor 0.6 included: linear light >= 0 to linear light, not yet clipped at 1.
double filmic(double linear);

struct DisplayResult {
  DisplayImage image;
  // Pixels with a NaN or infinite colour or alpha. They are shown: NaN as 0, infinity as the largest value. The
  // caller must say so when this is not 0.
  std::size_t non_finite = 0;
};

// Requires has_color(image). Text metadata go along.
DisplayResult to_display(const Image& image, const DisplayTransform& transform);

}  // namespace lekalo::render
