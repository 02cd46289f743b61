// From light to a display: the one stated transform between an Image and the numbers of a PNG.
//
//   value = OETF(curve(2^exposure * radiance)), rounded to the nearest of 2^bits levels, without dithering.
//
// OETF: IEC 61966-2-1 (sRGB), the exact two-part curve: 12.92 x up to 0.0031308, then 1.055 x^(1/2.4) - 0.055.
// Curve: none (values above 1 clip), or one of tone.h, which see the colour as a whole. A view of an OpenColorIO
// configuration stands in the place of both.
#pragma once

#include <cstddef>
#include <optional>

#include "render/image/color_view.h"
#include "render/image/image.h"
#include "render/image/png.h"
#include "render/image/tone.h"

namespace lekalo::render {

struct DisplayTransform {
  double exposure = 0;  // stops: +1 doubles the light
  ToneCurve curve = ToneCurve::none;
  std::optional<ColorView> view;  // in place of the curve
  int bits = 8;                   // 8 or 16
  bool alpha = false;  // keep the channel A (colours are divided by it); without it the picture stands before black
};

// sRGB of linear light and back, for values in [0, 1]; both continue below 0 and above 1 by the same formulas.
double srgb_encode(double linear);
double srgb_decode(double encoded);

struct DisplayResult {
  DisplayImage image;
  // Pixels with a NaN or infinite colour or alpha. They are shown: NaN as 0, infinity as the largest value. The
  // caller must say so when this is not 0.
  std::size_t non_finite = 0;
};

// Requires has_color(image). Text metadata go along. Throws ImageError where the view cannot be applied.
DisplayResult to_display(const Image& image, const DisplayTransform& transform);

}  // namespace lekalo::render
