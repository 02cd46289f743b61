// FLIP: how visible the difference is to a person who alternates between two pictures, 0 to 1 for each pixel.
//
// P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. D. Fairchild, "FLIP: A Difference
// Evaluator
//   for Alternating Images", HPG 2020 (with the erratum: the achromatic channel is normalised by 116, not 100);
// P. Andersson, J. Nilsson, P. Shirley, T. Akenine-Moeller, "Visualizing Errors in Rendered High Dynamic Range Images",
//   Eurographics 2021 (HDR-FLIP).
// Equal to the authors' own program on the pairs in tests/data/flip.
#pragma once

#include "render/image/image.h"
#include "render/image/metrics.h"

namespace lekalo::render {

// Pixels of the picture per degree of the viewer's eye: a display 0.7 m wide with 3840 pixels, seen from 0.7 m
// (3840 pi / 180); the default of the authors.
inline constexpr float kPixelsPerDegree = 67.0206433f;

// Both images require colour (linear Rec.709), finite values and the same size. Values outside [0, 1] are clipped.
ErrorMap ldr_flip(const Image& reference, const Image& test, float pixels_per_degree = kPixelsPerDegree);

struct HdrFlip {
  ErrorMap error;                               // the largest LDR-FLIP of all exposures, pixel by pixel
  float start_exposure = 0, stop_exposure = 0;  // stops
  int exposure_count = 0;                       // evenly from start to stop
};

// The exposures come from the reference: the tone curve (filmic, display.h) brings its brightest pixel to 0.85 at the
// start and its median at the stop, in steps of at most about one stop. If the median is black the median of the
// pixels that are not is taken (the paper leaves the case open); a black reference is seen at exposure 0 only.
HdrFlip hdr_flip(const Image& reference, const Image& test, float pixels_per_degree = kPixelsPerDegree);

}  // namespace lekalo::render
