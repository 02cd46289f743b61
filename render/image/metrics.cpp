#include "render/image/metrics.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

namespace lekalo::render {
namespace {

// The values from small to large until `share` of their sum is exceeded.
double weighted_percentile(const std::vector<float>& sorted, double sum, double share) {
  double running = 0;
  for (const float value : sorted) {
    running += value;
    if (running > share * sum) return value;
  }
  return sorted.back();
}

[[maybe_unused]] bool comparable(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && !a.channels.empty() && a.channels.size() == b.channels.size();
}

// Equal infinities do not differ; inf - inf would be NaN.
double difference(double a, double b) { return a == b ? 0 : std::abs(a - b); }

}  // namespace

ErrorStatistics pool(const ErrorMap& map) {
  assert(!map.values.empty());
  std::vector<float> sorted = map.values;
  std::sort(sorted.begin(), sorted.end());
  double sum = 0;
  for (const float value : sorted) sum += value;
  ErrorStatistics statistics;
  statistics.mean = sum / static_cast<double>(sorted.size());
  statistics.weighted_first_quartile = weighted_percentile(sorted, sum, 0.25);
  statistics.weighted_median = weighted_percentile(sorted, sum, 0.5);
  statistics.weighted_third_quartile = weighted_percentile(sorted, sum, 0.75);
  statistics.minimum = sorted.front();
  statistics.maximum = sorted.back();
  const auto at = std::find(map.values.begin(), map.values.end(), sorted.back()) - map.values.begin();
  statistics.maximum_x = static_cast<int>(at % map.width);
  statistics.maximum_y = static_cast<int>(at / map.width);
  return statistics;
}

ErrorMap absolute_difference(const Image& a, const Image& b) {
  assert(comparable(a, b));
  ErrorMap map{a.width, a.height, std::vector<float>(a.pixel_count())};
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    for (std::size_t i = 0; i < map.values.size(); ++i) {
      const double d = difference(value_at(a.channels[c], i), value_at(b.channels[c], i));
      map.values[i] = std::max(map.values[i], static_cast<float>(d));
    }
  }
  return map;
}

double rmse(const Image& a, const Image& b) {
  assert(comparable(a, b));
  double sum = 0;
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    for (std::size_t i = 0; i < a.pixel_count(); ++i) {
      const double d = difference(value_at(a.channels[c], i), value_at(b.channels[c], i));
      sum += d * d;
    }
  }
  return std::sqrt(sum / static_cast<double>(a.pixel_count() * a.channels.size()));
}

double psnr(double rmse, double peak) {
  return rmse == 0 ? std::numeric_limits<double>::infinity() : 20 * std::log10(peak / rmse);
}

namespace {

constexpr int kRadius = 5;
using Window = std::array<double, 2 * kRadius + 1>;

Window gaussian_window() {
  constexpr double kDeviation = 1.5;
  Window window;
  double sum = 0;
  for (int i = -kRadius; i <= kRadius; ++i) {
    const double weight = std::exp(-i * i / (2 * kDeviation * kDeviation));
    window[static_cast<std::size_t>(i + kRadius)] = weight;
    sum += weight;
  }
  for (double& weight : window) weight /= sum;
  return window;
}

// Weighted sums over the window around each pixel: a, b, a^2, b^2, ab.
using Moments = std::array<double, 5>;

}  // namespace

SsimResult ssim(const std::vector<float>& a, const std::vector<float>& b, int width, int height, double range) {
  assert(a.size() == b.size() && a.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const Window window = gaussian_window();
  const double c1 = 0.01 * range * 0.01 * range;
  const double c2 = 0.03 * range * 0.03 * range;
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(std::clamp(x, 0, width - 1));
  };
  // The window is a product of two one-dimensional ones: rows first, then columns.
  std::vector<Moments> rows(a.size());
  tbb::parallel_for(tbb::blocked_range<int>(0, height), [&](const auto& range_y) {
    for (int y = range_y.begin(); y < range_y.end(); ++y) {
      for (int x = 0; x < width; ++x) {
        Moments m{};
        for (int k = -kRadius; k <= kRadius; ++k) {
          const double weight = window[static_cast<std::size_t>(k + kRadius)];
          const double va = a[index(x + k, y)], vb = b[index(x + k, y)];
          const Moments terms = {va, vb, va * va, vb * vb, va * vb};
          for (std::size_t j = 0; j < m.size(); ++j) m[j] += weight * terms[j];
        }
        rows[index(x, y)] = m;
      }
    }
  });
  std::vector<double> values(a.size());
  SsimResult result{0, {width, height, std::vector<float>(a.size())}};
  tbb::parallel_for(tbb::blocked_range<int>(0, height), [&](const auto& range_y) {
    for (int y = range_y.begin(); y < range_y.end(); ++y) {
      for (int x = 0; x < width; ++x) {
        Moments m{};
        for (int k = -kRadius; k <= kRadius; ++k) {
          const Moments& row = rows[index(x, y + k)];
          for (std::size_t j = 0; j < m.size(); ++j) m[j] += window[static_cast<std::size_t>(k + kRadius)] * row[j];
        }
        const double variance_a = m[2] - m[0] * m[0], variance_b = m[3] - m[1] * m[1];
        const double covariance = m[4] - m[0] * m[1];
        const double value = (2 * m[0] * m[1] + c1) * (2 * covariance + c2) /
                             ((m[0] * m[0] + m[1] * m[1] + c1) * (variance_a + variance_b + c2));
        values[index(x, y)] = value;
        result.map.values[index(x, y)] = static_cast<float>(std::max(0.0, 1 - value));
      }
    }
  });
  const bool inside = width > 2 * kRadius && height > 2 * kRadius;
  const int border = inside ? kRadius : 0;
  for (int y = border; y < height - border; ++y) {
    for (int x = border; x < width - border; ++x) result.mean += values[index(x, y)];
  }
  result.mean /= static_cast<double>(width - 2 * border) * static_cast<double>(height - 2 * border);
  return result;
}

}  // namespace lekalo::render
