#include "render/image/flip.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "render/image/display.h"

// Symbols as in the paper of 2020. All filters are sums of products of one-dimensional ones, so each picture is
// filtered by rows and then by columns; single precision as in the authors' program.

namespace lekalo::render {
namespace {

constexpr float kPi = 3.14159265358979f;
constexpr float kQc = 0.7f, kPc = 0.4f, kPt = 0.95f;  // colour: exponent, knee and its image (section 4.1.3)
constexpr float kFeatureWidth = 0.082f, kQf = 0.5f;   // features: width in degrees (section 4.2), exponent

using Color = std::array<float, 3>;
constexpr Color kInverseWhite = {1.052156925f, 1.0f, 0.918357670f};  // D65
constexpr Color kWhite = {0.950428545f, 1.0f, 1.088900371f};

struct Plane {
  int width, height;
  std::vector<float> values;
  Plane(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  float* row(int y) { return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width); }
  const float* row(int y) const {
    return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
};

template <class Body>
void for_rows(int height, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<int>(0, height, 8), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) body(y);
  });
}

// Odd length, centred. Outside the picture its border is repeated.
using Kernel = std::vector<float>;

int radius(const Kernel& kernel) { return static_cast<int>(kernel.size() / 2); }

Plane filter_rows(const Plane& in, const Kernel& kernel) {
  Plane out(in.width, in.height);
  const int r = radius(kernel);
  for_rows(in.height, [&](int y) {
    std::vector<float> padded(static_cast<std::size_t>(in.width + 2 * r));
    const float* source = in.row(y);
    for (int x = -r; x < in.width + r; ++x) {
      padded[static_cast<std::size_t>(x + r)] = source[std::clamp(x, 0, in.width - 1)];
    }
    float* sum = out.row(y);
    for (std::size_t k = 0; k < kernel.size(); ++k) {
      const float weight = kernel[k];
      const float* shifted = padded.data() + k;
      for (int x = 0; x < in.width; ++x) sum[x] += weight * shifted[x];
    }
  });
  return out;
}

// Adds row y of the column-filtered plane to `sum`.
void add_filtered_column(const Plane& in, const Kernel& kernel, int y, float* sum) {
  const int r = radius(kernel);
  for (int k = -r; k <= r; ++k) {
    const float weight = kernel[static_cast<std::size_t>(k + r)];
    const float* source = in.row(std::clamp(y + k, 0, in.height - 1));
    for (int x = 0; x < in.width; ++x) sum[x] += weight * source[x];
  }
}

Color linear_to_xyz(const Color& c) {
  return {(10135552.0f * c[0] + 8788810.0f * c[1] + 4435075.0f * c[2]) / 24577794.0f,
          (2613072.0f * c[0] + 8788810.0f * c[1] + 887015.0f * c[2]) / 12288897.0f,
          (1425312.0f * c[0] + 8788810.0f * c[1] + 70074185.0f * c[2]) / 73733382.0f};
}

Color xyz_to_linear(const Color& c) {
  return {3.241003275f * c[0] - 1.537398934f * c[1] - 0.498615861f * c[2],
          -0.969224334f * c[0] + 1.875930071f * c[1] + 0.041554224f * c[2],
          0.055639423f * c[0] - 0.204011202f * c[1] + 1.057148933f * c[2]};
}

Color linear_to_ycxcz(const Color& linear) {
  const Color xyz = linear_to_xyz(linear);
  const float x = xyz[0] * kInverseWhite[0], y = xyz[1] * kInverseWhite[1], z = xyz[2] * kInverseWhite[2];
  return {116.0f * y - 16.0f, 500.0f * (x - y), 200.0f * (y - z)};
}

Color ycxcz_to_linear(const Color& c) {
  const float y = (c[0] + 16.0f) / 116.0f;
  return xyz_to_linear({(y + c[1] / 500.0f) * kWhite[0], y * kWhite[1], (y - c[2] / 200.0f) * kWhite[2]});
}

float lab_root(float t) {
  constexpr float kDelta = 6.0f / 29.0f;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0f * kDelta * kDelta) + 4.0f / 29.0f;
}

// L*a*b* with the chroma scaled by the lightness, after Hunt.
Color linear_to_hunt_lab(const Color& linear) {
  const Color xyz = linear_to_xyz(linear);
  const float x = lab_root(xyz[0] * kInverseWhite[0]);
  const float y = lab_root(xyz[1] * kInverseWhite[1]);
  const float z = lab_root(xyz[2] * kInverseWhite[2]);
  const float lightness = 116.0f * y - 16.0f;
  return {lightness, 0.01f * lightness * 500.0f * (x - y), 0.01f * lightness * 200.0f * (y - z)};
}

// HyAB distance: lightness and chroma are added, not squared together.
float hyab(const Color& a, const Color& b) {
  const float da = a[1] - b[1], db = a[2] - b[2];
  return std::abs(a[0] - b[0]) + std::sqrt(da * da + db * db);
}

// Contrast sensitivity in the picture plane: a sum of Gaussians a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees.
struct SpatialFilters {
  Kernel achromatic, red_green, blue_yellow_1, blue_yellow_2;

  explicit SpatialFilters(float pixels_per_degree) {
    constexpr float kWidest = 0.04f;
    const int r = static_cast<int>(std::ceil(3.0f * std::sqrt(kWidest / (2.0f * kPi * kPi)) * pixels_per_degree));
    float sums[4] = {};
    for (int i = -r; i <= r; ++i) {
      const float x = static_cast<float>(i) / pixels_per_degree;
      const auto gaussian = [&](float b) { return std::exp(-kPi * kPi * x * x / b); };
      achromatic.push_back(gaussian(0.0047f));
      red_green.push_back(gaussian(0.0053f));
      // The two-dimensional amplitude is the product of two one-dimensional ones.
      blue_yellow_1.push_back(std::sqrt(34.1f * std::sqrt(kPi / 0.04f)) * gaussian(0.04f));
      blue_yellow_2.push_back(std::sqrt(13.5f * std::sqrt(kPi / 0.025f)) * gaussian(0.025f));
      sums[0] += achromatic.back();
      sums[1] += red_green.back();
      sums[2] += blue_yellow_1.back();
      sums[3] += blue_yellow_2.back();
    }
    // The plane sum of the blue-yellow filter is the sum of the squares of its two line sums.
    const float blue_yellow_sum = std::sqrt(sums[2] * sums[2] + sums[3] * sums[3]);
    for (float& w : achromatic) w /= sums[0];
    for (float& w : red_green) w /= sums[1];
    for (float& w : blue_yellow_1) w /= blue_yellow_sum;
    for (float& w : blue_yellow_2) w /= blue_yellow_sum;
  }
};

// A Gaussian and its first and second derivative, positive and negative weights of the latter two summing to 1 and -1.
struct FeatureFilters {
  Kernel smooth, edge, point;

  explicit FeatureFilters(float pixels_per_degree) {
    const float deviation = 0.5f * kFeatureWidth * pixels_per_degree;
    const int r = static_cast<int>(std::ceil(3.0f * deviation));
    for (int i = -r; i <= r; ++i) {
      const float x = static_cast<float>(i);
      const float g = std::exp(-(x * x) / (2.0f * deviation * deviation));
      smooth.push_back(g);
      edge.push_back(-x * g);
      point.push_back((x * x / (deviation * deviation) - 1.0f) * g);
    }
    for (Kernel* kernel : {&smooth, &edge, &point}) {
      float positive = 0, negative = 0;
      for (const float w : *kernel) (w > 0 ? positive : negative) += std::abs(w);
      for (float& w : *kernel) w /= w > 0 ? positive : negative > 0 ? negative : 1.0f;
    }
  }
};

// A picture after the contrast sensitivity filter by rows, and the three features by rows.
struct HalfFiltered {
  Plane y, cx, cz1, cz2, smooth, edge, point;
};

HalfFiltered filter_picture_rows(const Image& image, const SpatialFilters& spatial, const FeatureFilters& feature,
                                 const std::vector<float>& tone_mapped) {
  const int width = image.width, height = image.height;
  const std::size_t pixels = image.pixel_count();
  Plane y(width, height), cx(width, height), cz(width, height), normalized(width, height);
  for_rows(height, [&](int row) {
    const std::size_t begin = static_cast<std::size_t>(row) * static_cast<std::size_t>(width);
    for (std::size_t i = begin; i < begin + static_cast<std::size_t>(width); ++i) {
      const Color c = linear_to_ycxcz({tone_mapped[i], tone_mapped[pixels + i], tone_mapped[2 * pixels + i]});
      y.values[i] = c[0];
      cx.values[i] = c[1];
      cz.values[i] = c[2];
      normalized.values[i] = c[0] * (1.0f / 116.0f) + 16.0f / 116.0f;
    }
  });
  return {filter_rows(y, spatial.achromatic),      filter_rows(cx, spatial.red_green),
          filter_rows(cz, spatial.blue_yellow_1),  filter_rows(cz, spatial.blue_yellow_2),
          filter_rows(normalized, feature.smooth), filter_rows(normalized, feature.edge),
          filter_rows(normalized, feature.point)};
}

// Rows of working numbers for one row of the result.
class Columns {
 public:
  explicit Columns(int width) : width_(static_cast<std::size_t>(width)), values_(8 * width_) {}

  void filter(const HalfFiltered& picture, const SpatialFilters& spatial, const FeatureFilters& feature, int y) {
    std::fill(values_.begin(), values_.end(), 0.0f);
    add_filtered_column(picture.y, spatial.achromatic, y, row(0));
    add_filtered_column(picture.cx, spatial.red_green, y, row(1));
    add_filtered_column(picture.cz1, spatial.blue_yellow_1, y, row(2));
    add_filtered_column(picture.cz2, spatial.blue_yellow_2, y, row(2));
    add_filtered_column(picture.edge, feature.smooth, y, row(3));
    add_filtered_column(picture.smooth, feature.edge, y, row(4));
    add_filtered_column(picture.point, feature.smooth, y, row(5));
    add_filtered_column(picture.smooth, feature.point, y, row(6));
  }
  Color lab(int x) const {
    Color linear = ycxcz_to_linear({at(0, x), at(1, x), at(2, x)});
    for (float& c : linear) c = std::clamp(c, 0.0f, 1.0f);
    return linear_to_hunt_lab(linear);
  }
  float edge(int x) const { return std::sqrt(at(3, x) * at(3, x) + at(4, x) * at(4, x)); }
  float point(int x) const { return std::sqrt(at(5, x) * at(5, x) + at(6, x) * at(6, x)); }

 private:
  float* row(std::size_t i) { return values_.data() + i * width_; }
  float at(std::size_t i, int x) const { return values_[i * width_ + static_cast<std::size_t>(x)]; }
  std::size_t width_;
  std::vector<float> values_;
};

// Colour differences up to kPc of the largest one (between green and blue) take [0, kPt], the rest what is left.
float redistribute(float distance, float largest) {
  const float power = std::pow(distance, kQc);
  const float knee = kPc * largest;
  return power < knee ? power * (kPt / knee) : kPt + (power - knee) / (largest - knee) * (1.0f - kPt);
}

// Planar red, green and blue in [0, 1] -> error.
ErrorMap flip(const Image& reference, const Image& test, const std::vector<float>& reference_rgb,
              const std::vector<float>& test_rgb, float pixels_per_degree) {
  const SpatialFilters spatial(pixels_per_degree);
  const FeatureFilters feature(pixels_per_degree);
  const HalfFiltered a = filter_picture_rows(reference, spatial, feature, reference_rgb);
  const HalfFiltered b = filter_picture_rows(test, spatial, feature, test_rgb);
  const float largest = std::pow(hyab(linear_to_hunt_lab({0, 1, 0}), linear_to_hunt_lab({0, 0, 1})), kQc);
  ErrorMap map{reference.width, reference.height, std::vector<float>(reference.pixel_count())};
  for_rows(map.height, [&](int y) {
    Columns columns_a(map.width), columns_b(map.width);
    columns_a.filter(a, spatial, feature, y);
    columns_b.filter(b, spatial, feature, y);
    float* out = map.values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width);
    for (int x = 0; x < map.width; ++x) {
      const float color = redistribute(hyab(columns_a.lab(x), columns_b.lab(x)), largest);
      const float edge = std::abs(columns_a.edge(x) - columns_b.edge(x));
      const float point = std::abs(columns_a.point(x) - columns_b.point(x));
      const float features = std::pow(std::max(edge, point) / std::sqrt(2.0f), kQf);
      out[x] = std::pow(color, 1.0f - features);
    }
  });
  return map;
}

template <class Transform>
std::vector<float> planar(const Image& image, const Transform& transform) {
  const ColorPlanes planes = color_planes(image);
  const std::size_t pixels = image.pixel_count();
  std::vector<float> result(3 * pixels);
  std::size_t first = 0;
  for (const auto& plane : {planes.r, planes.g, planes.b}) {
    for (std::size_t i = 0; i < pixels; ++i) result[first + i] = std::clamp(transform(plane[i]), 0.0f, 1.0f);
    first += pixels;
  }
  return result;
}

// f(x) = x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14) at 0.6 x, in the precision of the authors' program.
float tone_curve(float x) {
  x = std::min(x, 1e9f);  // the square of a firefly must not overflow; the curve is flat long before
  const float square = x * x;
  return (square * (0.36f * 2.51f) + x * (0.6f * 0.03f)) / (square * (0.36f * 2.43f) + x * (0.6f * 0.59f) + 0.14f);
}

// The radiance that the tone curve brings to 0.85: the larger root of a quadratic.
float bright_radiance() {
  constexpr double kBright = 0.85;
  const double a = 0.36 * (2.51 - kBright * 2.43), b = 0.6 * (0.03 - kBright * 0.59), c = -kBright * 0.14;
  const double half = -b / (2 * a);
  return static_cast<float>(half + std::sqrt(half * half - c / a));
}

void choose_exposures(const Image& reference, HdrFlip& result) {
  const ColorPlanes planes = color_planes(reference);
  std::vector<float> luminances(reference.pixel_count());
  for (std::size_t i = 0; i < luminances.size(); ++i) {
    luminances[i] = 0.2126f * planes.r[i] + 0.7152f * planes.g[i] + 0.0722f * planes.b[i];
  }
  const auto median = [&] {
    const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
    std::nth_element(luminances.begin(), middle, luminances.end());
    return *middle;
  };
  const float brightest = *std::max_element(luminances.begin(), luminances.end());
  if (brightest <= 0) {
    result.exposure_count = 1;
    return;
  }
  float middle = median();
  if (middle <= 0) {
    std::erase_if(luminances, [](float v) { return v <= 0; });
    middle = median();
  }
  const float bright = bright_radiance();
  result.start_exposure = std::log2(bright / brightest);
  result.stop_exposure = std::log2(bright / middle);
  result.exposure_count = static_cast<int>(std::max(2.0f, std::ceil(result.stop_exposure - result.start_exposure)));
}

}  // namespace

ErrorMap ldr_flip(const Image& reference, const Image& test, float pixels_per_degree) {
  assert(reference.width == test.width && reference.height == test.height);
  const auto identity = [](float v) { return v; };
  return flip(reference, test, planar(reference, identity), planar(test, identity), pixels_per_degree);
}

HdrFlip hdr_flip(const Image& reference, const Image& test, float pixels_per_degree) {
  assert(reference.width == test.width && reference.height == test.height);
  HdrFlip result;
  choose_exposures(reference, result);
  result.error = {reference.width, reference.height, std::vector<float>(reference.pixel_count())};
  for (int i = 0; i < result.exposure_count; ++i) {
    const float step =
        (result.stop_exposure - result.start_exposure) / static_cast<float>(std::max(result.exposure_count - 1, 1));
    const float scale = std::exp2(result.start_exposure + static_cast<float>(i) * step);
    const auto expose = [scale](float v) { return tone_curve(scale * v); };
    const ErrorMap map = flip(reference, test, planar(reference, expose), planar(test, expose), pixels_per_degree);
    std::transform(map.values.begin(), map.values.end(), result.error.values.begin(), result.error.values.begin(),
                   [](float a, float b) { return std::max(a, b); });
  }
  return result;
}

}  // namespace lekalo::render
