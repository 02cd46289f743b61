// Numbers for the difference of two pictures of the same size, each with a map of where it is.
//
//   rmse = sqrt(mean (a - b)^2),  psnr = 20 log10(peak / rmse),  max = max |a - b|, over all channels;
//   ssim: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image Quality Assessment: From Error Visibility to
//   Structural Similarity", IEEE Transactions on Image Processing 13(4), 2004.
// FLIP is in flip.h.
#pragma once

#include <cstddef>
#include <vector>

#include "render/image/image.h"

namespace lekalo::render {

// One number per pixel, row by row from the top left.
struct ErrorMap {
  int width = 0, height = 0;
  std::vector<float> values;
};

// A map in a few numbers. A weighted percentile p is the smallest value v such that the values up to v hold more than
// the share p of the sum of all values (Andersson et al. 2020, section 5: large errors count for more).
struct ErrorStatistics {
  double mean = 0;
  double weighted_median = 0;
  double weighted_first_quartile = 0;
  double weighted_third_quartile = 0;
  double minimum = 0;
  double maximum = 0;
  int maximum_x = 0, maximum_y = 0;  // the first pixel with the maximum
};

// Requires values >= 0, at least one. An infinite value makes the mean infinite.
ErrorStatistics pool(const ErrorMap& map);

// The following require two images of the same size with the same channels in the same order.

// The largest absolute difference among the channels of each pixel.
ErrorMap absolute_difference(const Image& a, const Image& b);

// Over all channels of all pixels.
double rmse(const Image& a, const Image& b);

// Decibels; infinity for equal images.
double psnr(double rmse, double peak);

struct SsimResult {
  double mean;   // over all pixels whose window lies inside the picture (all pixels of a picture below 11 x 11)
  ErrorMap map;  // max(0, 1 - ssim) of each pixel; outside the picture its border is repeated
};

// SSIM of two planes with the published constants: Gaussian window of 11 x 11 pixels and deviation 1.5,
// K1 = 0.01, K2 = 0.03; `range` is the range of the values (1 for display values).
SsimResult ssim(const std::vector<float>& a, const std::vector<float>& b, int width, int height, double range);

}  // namespace lekalo::render
