#include "render/spectra/upsampling.h"

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "render/spectra/hero_wavelengths.h"
#include "render/spectra/observer.h"

namespace lekalo::render {

namespace {

using Row = std::array<double, kSpectrumEntries>;

double reduced(double nanometres) { return (nanometres - 580) / 200; }

// The integrals of r (hero_wavelengths.h) over the entries, colour by colour.
struct Grid {
  Row x;
  std::array<Row, 3> weight;
  Grid() {
    for (size_t i = 0; i < x.size(); ++i) {
      x[i] = reduced(entry_nanometres(static_cast<int>(i)));
      const double width = kNanometreStep * (i == 0 || i + 1 == x.size() ? 0.5 : 1);
      for (int c = 0; c < 3; ++c) weight[static_cast<size_t>(c)][i] = width * white_response()[i][c];
    }
  }
};
const Grid& grid() {
  static const Grid one;
  return one;
}

// Coefficients of 1, x, x^2.
using Coefficients = Eigen::Vector3d;

double sigmoid(double u) { return 0.5 + 0.5 * u / std::sqrt(1 + u * u); }

struct Fit {
  Eigen::Vector3d color;
  Eigen::Matrix3d slope;  // of the colour, by the coefficients
};

Fit fit_at(const Coefficients& c) {
  const Grid& g = grid();
  Fit fit{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  for (size_t i = 0; i < g.x.size(); ++i) {
    const double x = g.x[i], u = c[0] + x * (c[1] + x * c[2]);
    const double inverse = 1 / std::sqrt(1 + u * u), s = 0.5 + 0.5 * u * inverse;
    const double slope = 0.5 * inverse * inverse * inverse;
    for (int k = 0; k < 3; ++k) {
      const double w = g.weight[static_cast<size_t>(k)][i], d = w * slope;
      fit.color[k] += w * s;
      fit.slope(k, 0) += d;
      fit.slope(k, 1) += d * x;
      fit.slope(k, 2) += d * x * x;
    }
  }
  return fit;
}

// The polynomial that has the colour's lanes at the wavelengths that stand for them (Wavelengths).
Coefficients first_guess(const Eigen::Vector3d& color) {
  Eigen::Matrix3d powers;
  Eigen::Vector3d u;
  for (int i = 0; i < 3; ++i) {
    const double x = reduced(Wavelengths{}.nanometres[static_cast<size_t>(i)]);
    const double v = 2 * std::clamp(color[i], 0.02, 0.98) - 1;
    powers.row(i) << 1, x, x * x;
    u[i] = v / std::sqrt(1 - v * v);
  }
  return powers.inverse() * u;
}

// Levenberg and Marquardt's damping: steps that lead away from the colour are made shorter.
Coefficients fitted(const Eigen::Vector3d& color) {
  constexpr int kMaxSteps = 80;
  constexpr double kNear = 1e-12;  // square of the error of the colour
  Coefficients c = first_guess(color);
  Fit fit = fit_at(c);
  double error = (fit.color - color).squaredNorm(), damping = 1e-3;
  for (int step = 0; step < kMaxSteps && error > kNear; ++step) {
    Eigen::Matrix3d normal = fit.slope.transpose() * fit.slope;
    normal.diagonal() *= 1 + damping;
    normal.diagonal().array() += 1e-14;
    const Coefficients tried = c - normal.ldlt().solve(fit.slope.transpose() * (fit.color - color));
    const Fit there = fit_at(tried);
    const double left = (there.color - color).squaredNorm();
    if (left < error) {
      c = tried, fit = there, error = left;
      damping = std::max(1e-12, 0.1 * damping);
    } else {
      damping *= 8;
      if (damping > 1e12) break;
    }
  }
  return c;
}

struct Polynomial {
  float color[3] = {-1, -1, -1};
  Coefficients coefficients;

  double at(double nanometres) const {
    const double x = reduced(nanometres);
    return sigmoid(coefficients[0] + x * (coefficients[1] + x * coefficients[2]));
  }
};

// The last colours asked for by this thread. A fit depends on the colour alone, so that it is of no matter which these
// are.
const Polynomial& polynomial(const std::array<float, 3>& color) {
  constexpr size_t kPlaces = 4096;
  thread_local std::vector<Polynomial> known(kPlaces);
  uint64_t hash = 0;
  for (const float lane : color) hash = (hash ^ std::bit_cast<uint32_t>(lane)) * 0x9e3779b97f4a7c15u;
  Polynomial& place = known[(hash >> 40) % kPlaces];
  if (place.color[0] != color[0] || place.color[1] != color[1] || place.color[2] != color[2]) {
    place.coefficients = fitted({color[0], color[1], color[2]});
    std::copy(color.begin(), color.end(), place.color);
  }
  return place;
}

bool is_grey(const Spectrum& color) { return color[0] == color[1] && color[1] == color[2]; }

// Colours are told apart by 1 / 65536: one lamp seen from many distances is of one colour for all rounding.
float rounded(float share) { return std::round(std::clamp(share, 0.0f, 1.0f) * 65536) / 65536; }

Spectrum of_color(const Spectrum& color, const Wavelengths& wavelengths) {
  const Polynomial& p = polynomial({rounded(color[0]), rounded(color[1]), rounded(color[2])});
  Spectrum s;
  for (int i = 0; i < 4; ++i) s.set(i, static_cast<float>(p.at(wavelengths.nanometres[static_cast<size_t>(i)])));
  return s;
}

// The spectra of LinearUpsampling at the entries, by columns: the least of s^T D^T D s, D second differences, under
// M s = the primary's colour.
Eigen::MatrixXd smoothest_primaries() {
  constexpr int n = kSpectrumEntries;
  Eigen::MatrixXd bending = Eigen::MatrixXd::Zero(n - 2, n), system = Eigen::MatrixXd::Zero(n + 3, n + 3);
  for (int i = 0; i < n - 2; ++i) bending.block(i, i, 1, 3) << 1, -2, 1;
  system.topLeftCorner(n, n) = bending.transpose() * bending;
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < n; ++i)
      system(n + c, i) = system(i, n + c) = grid().weight[static_cast<size_t>(c)][static_cast<size_t>(i)];
  Eigen::MatrixXd colors = Eigen::MatrixXd::Zero(n + 3, 3);
  colors.bottomRows(3).setIdentity();
  return system.fullPivLu().solve(colors).topRows(n);
}

}  // namespace

Spectrum upsampled_reflectance(const Spectrum& color, const Wavelengths& wavelengths) {
  if (!is_spectral(wavelengths)) return color;
  return is_grey(color) ? Spectrum(color[0]) : of_color(color, wavelengths);
}

Spectrum upsampled_light(const Spectrum& color, const Wavelengths& wavelengths) {
  if (!is_spectral(wavelengths)) return color;
  if (is_grey(color)) return Spectrum(color[0]);
  const float twice = 2 * std::max({color[0], color[1], color[2]});
  return twice > 0 ? twice * of_color(1 / twice * color, wavelengths) : Spectrum();
}

LinearUpsampling::LinearUpsampling(const Wavelengths& wavelengths) : spectral_(is_spectral(wavelengths)) {
  static const Eigen::MatrixXd table = smoothest_primaries();
  if (!spectral_) return;
  for (int i = 0; i < 4; ++i) {
    const double nanometres = wavelengths.nanometres[static_cast<size_t>(i)];
    for (int c = 0; c < 3; ++c)
      primaries_[static_cast<size_t>(c)].set(i, static_cast<float>(entry_at(nanometres, [c](size_t entry) {
                                               return table(static_cast<Eigen::Index>(entry), c);
                                             })));
  }
}

}  // namespace lekalo::render
