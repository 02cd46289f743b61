// Comparing two picture files, for `lekalo compare`, regression suites and reports.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "render/image/image.h"
#include "render/image/metrics.h"
#include "render/image/png.h"

namespace lekalo::render {

// Smaller is better for flip (mean error), rmse and max; larger for psnr (decibels) and ssim.
enum class Metric { flip, rmse, psnr, ssim, max };

std::optional<Metric> metric_from_name(std::string_view name);
const char* metric_name(Metric metric);
bool larger_is_better(Metric metric);

struct CompareOptions {
  Metric metric = Metric::flip;
  // The worst value that still passes. Without one only equal pictures pass (0; infinity for psnr, 1 for ssim).
  std::optional<double> threshold;
  std::string layer;  // as select_layer takes it; empty: colour
  float pixels_per_degree = 67.0206433f;
};

struct ComparisonResult {
  std::string path_a, path_b;  // as given
  std::string layer;           // "color", "normal", ...
  int width = 0, height = 0;
  Metric metric = Metric::flip;
  double value = 0, threshold = 0;
  bool passed = false;
  // Error of each pixel: FLIP; 1 - ssim; largest absolute difference of the channels for the others.
  ErrorMap error;
  ErrorStatistics statistics;  // of the error map
  // NaN and infinite values of each picture, and the pixels where they are not the same ones in both. Such a pixel has
  // the error 1 (flip, ssim) or infinity, and the comparison does not pass.
  std::size_t non_finite_a = 0, non_finite_b = 0, non_finite_mismatches = 0;
  // HDR-FLIP only: exposures in stops, count 0 otherwise.
  double start_exposure = 0, stop_exposure = 0;
  int exposure_count = 0;
  DisplayImage shown_a, shown_b;  // as a display shows the layer
};

// What is compared:
//   rmse, max    the stored numbers (of PNG and the like: level / largest level; alpha too if both have it);
//   psnr, ssim   what a display shows (layers.h), ssim by its luminance 0.2126 R + 0.7152 G + 0.0722 B, peak 1;
//   flip         HDR-FLIP between two floating-point pictures, else LDR-FLIP of what a display shows.
// A floating-point picture against an integer one is compared as a display shows it by every metric. A (the reference)
// gives the range of layers that are shown by their range, and HDR-FLIP its exposures.
// Throws ImageError: unreadable, different sizes or crops, layer missing or with other channels.
ComparisonResult compare_images(const std::filesystem::path& a, const std::filesystem::path& b,
                                const CompareOptions& options);

// The same of pictures in memory; the paths are for messages only.
ComparisonResult compare_images(const Image& a, const Image& b, const std::filesystem::path& path_a,
                                const std::filesystem::path& path_b, const CompareOptions& options);

}  // namespace lekalo::render
