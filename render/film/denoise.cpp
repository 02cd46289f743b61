#include "render/film/denoise.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lekalo::render {

namespace {

constexpr int kGuides = 7;      // normal, albedo, depth
constexpr int kReach = 5;       // of windows, pixels to each side
constexpr int kTrustReach = 2;  // of the windows in which the filter is judged
constexpr double kRidge = 1e-3;
// Neighbours differ by less in normal, albedo and logarithm of the depth unless they show different things.
constexpr double kTurn = 0.3, kOtherAlbedo = 0.1, kStep = 0.1;

using Guides = Eigen::Matrix<double, kGuides, 1>;
using Color = Eigen::Vector3d;
// Colour by (g, 1).
using LinearColor = Eigen::Matrix<float, 3, kGuides + 1>;

class Denoiser {
 public:
  explicit Denoiser(Image& image) : width_(image.width), height_(image.height) {
    for (const char* name : {"N.X", "N.Y", "N.Z", "albedo.R", "albedo.G", "albedo.B", "Z"})
      guides_.push_back(find_channel(image, name)->values.data());
    for (int c = 0; c < 3; ++c) {
      const std::string lane(1, "RGB"[c]);
      colors_.push_back(find_channel(image, lane)->values.data());
      variances_.push_back(find_channel(image, "variance." + lane)->values.data());
      results_.push_back(find_channel(image, "denoised." + lane)->values.data());
    }
  }

  void run() {
    parted_.resize(static_cast<size_t>(width_) * height_);
    each_row([&](int y) {
      for (int x = 0; x < width_; ++x) parted_[at(x, y)] = is_parted(x, y);
    });
    std::vector<LinearColor> models(static_cast<size_t>(width_) * height_);
    each_row([&](int y) {
      for (int x = 0; x < width_; ++x) models[at(x, y)] = model(x, y);
    });
    std::vector<Color> filtered(models.size());
    each_row([&](int y) {
      for (int x = 0; x < width_; ++x) filtered[at(x, y)] = value(mean_model(models, x, y), x, y);
    });
    each_row([&](int y) {
      for (int x = 0; x < width_; ++x) blend(filtered, x, y);
    });
  }

 private:
  template <class Row>
  void each_row(const Row& row) const {
    tbb::parallel_for(tbb::blocked_range<int>(0, height_, 8), [&](const tbb::blocked_range<int>& rows) {
      for (int y = rows.begin(); y < rows.end(); ++y) row(y);
    });
  }
  template <class Visit>
  void each_near(int x, int y, int reach, const Visit& visit) const {
    for (int j = std::max(0, y - reach); j <= std::min(height_ - 1, y + reach); ++j)
      for (int i = std::max(0, x - reach); i <= std::min(width_ - 1, x + reach); ++i)
        if (!parted_[at(i, j)]) visit(i, j);
  }
  // Whether the guides of a neighbour are those of another thing.
  bool is_parted(int x, int y) const {
    const Guides own = guides(x, y);
    bool parted = false;
    for (int j = std::max(0, y - 1); j <= std::min(height_ - 1, y + 1); ++j)
      for (int i = std::max(0, x - 1); i <= std::min(width_ - 1, x + 1); ++i) {
        const Guides off = guides(i, j) - own;
        parted = parted || off.head<3>().norm() > kTurn || off.segment<3>(3).norm() > kOtherAlbedo ||
                 std::fabs(off[kGuides - 1]) > kStep;
      }
    return parted;
  }
  size_t at(int x, int y) const { return static_cast<size_t>(y) * width_ + x; }
  Guides guides(int x, int y) const {
    const size_t i = at(x, y);
    Guides g;
    for (int k = 0; k < kGuides - 1; ++k) g[k] = guides_[static_cast<size_t>(k)][i];
    const double depth = guides_.back()[i];
    g[kGuides - 1] = depth > 0 ? std::log(depth) : 0;  // nothing there: as the other guides, which are 0
    return g;
  }
  Color color(const std::vector<float*>& planes, int x, int y) const {
    const size_t i = at(x, y);
    return {planes[0][i], planes[1][i], planes[2][i]};
  }

  LinearColor model(int x, int y) const {
    if (parted_[at(x, y)]) return LinearColor::Zero();
    Guides sum = Guides::Zero();
    Color of_colors = Color::Zero();
    Eigen::Matrix<double, kGuides, kGuides> squares = Eigen::Matrix<double, kGuides, kGuides>::Zero();
    Eigen::Matrix<double, kGuides, 3> products = Eigen::Matrix<double, kGuides, 3>::Zero();
    double count = 0;
    const Guides middle = guides(x, y);  // about which the sums keep their digits
    each_near(x, y, kReach, [&](int i, int j) {
      const Guides g = guides(i, j) - middle;
      const Color c = color(colors_, i, j);
      sum += g;
      of_colors += c;
      squares.noalias() += g * g.transpose();
      products.noalias() += g * c.transpose();
      ++count;
    });
    const Guides mean = sum / count;
    const Color mean_color = of_colors / count;
    squares = squares / count - mean * mean.transpose();
    products = products / count - mean * mean_color.transpose();
    squares.diagonal().array() += kRidge;
    const Eigen::Matrix<double, kGuides, 3> a = squares.ldlt().solve(products);
    LinearColor result;
    result.leftCols<kGuides>() = a.transpose().cast<float>();
    result.col(kGuides) = (mean_color - a.transpose() * (mean + middle)).cast<float>();
    return result;
  }
  LinearColor mean_model(const std::vector<LinearColor>& models, int x, int y) const {
    LinearColor sum = LinearColor::Zero();
    float count = 0;
    each_near(x, y, kReach, [&](int i, int j) {
      sum += models[at(i, j)];
      ++count;
    });
    return count > 0 ? LinearColor(sum / count) : sum;
  }
  Color value(const LinearColor& model, int x, int y) const {
    const Color linear = model.leftCols<kGuides>().cast<double>() * guides(x, y);
    return (linear + model.col(kGuides).cast<double>()).cwiseMax(0);
  }
  void blend(const std::vector<Color>& filtered, int x, int y) const {
    if (parted_[at(x, y)]) {
      for (size_t c = 0; c < 3; ++c) results_[c][at(x, y)] = colors_[c][at(x, y)];
      return;
    }
    double variance = 0, square = 0;
    each_near(x, y, kTrustReach, [&](int i, int j) {
      variance += color(variances_, i, j).sum();
      square += (filtered[at(i, j)] - color(colors_, i, j)).squaredNorm();
    });
    const double share = square > variance ? variance / square : 1;
    const Color own = color(colors_, x, y), result = own + share * (filtered[at(x, y)] - own);
    for (int c = 0; c < 3; ++c) results_[static_cast<size_t>(c)][at(x, y)] = static_cast<float>(result[c]);
  }

  int width_, height_;
  std::vector<char> parted_;  // by pixel
  std::vector<const float*> guides_;
  std::vector<float*> colors_, variances_, results_;
};

}  // namespace

void denoise(Image& image) { Denoiser(image).run(); }

}  // namespace lekalo::render
