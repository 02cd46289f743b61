#include "render/lobes/film.h"

#include <algorithm>
#include <cmath>

#include "render/spectra/hero_wavelengths.h"
#include "render/spectra/observer.h"

namespace lekalo::render {

namespace {

using Complex = std::complex<double>;

constexpr int kCosines = 128, kThicknesses = 96;
// Of unpolarised light; `c` the cosines in the three substances.
double airy(const Complex (&n)[3], const Complex (&c)[3], const Complex& turn) {
  double sum = 0;
  for (const bool parallel : {false, true}) {
    const auto amplitude = [&](int i) {
      const Complex a = parallel ? n[i + 1] * c[i] : n[i] * c[i], b = parallel ? n[i] * c[i + 1] : n[i + 1] * c[i + 1];
      return (a - b) / (a + b);
    };
    const Complex upper = amplitude(0), lower = amplitude(1) * turn;
    sum += 0.5 * std::norm((upper + lower) / (1.0 + upper * lower));
  }
  return sum;
}

// Of white light.
Spectrum seen(const std::function<double(double)>& reflectance) {
  static const Vec3 white = observed([](double) { return 1; });
  return rgb(glm::clamp(observed(reflectance) / white, Vec3(0), Vec3(1)));
}

// Number of the entry below a place in [0, count - 1], and the share of the next one.
std::pair<int, float> entry(double place, int count) {
  const int i = std::clamp(static_cast<int>(place), 0, std::max(0, count - 2));
  return {i, static_cast<float>(std::clamp(place - i, 0.0, 1.0))};
}

}  // namespace

double film_reflectance(double cos_incident, double n0, double n1, Complex n2, double thickness, double wavelength) {
  const double c0 = std::clamp(cos_incident, 1e-9, 1.0), sine = n0 * std::sqrt(1 - c0 * c0);
  const auto cosine = [&](const Complex& n) {
    const Complex c = std::sqrt(1.0 - sine * sine / (n * n));
    return (n * c).imag() > 0 ? -c : c;  // waves that die away
  };
  const Complex n[3] = {n0, n1, n2}, c[3] = {c0, cosine(n1), cosine(n2)};
  const Complex turn = std::exp(Complex(0, -2) * (2 * geometry::kPi * thickness / wavelength) * n1 * c[1]);
  return airy(n, c, turn);
}

FilmTable::FilmTable(double index, double least, double most, const std::function<Complex(double)>& substance)
    : index_(index), substance_(substance), least_(least), most_(most), rows_(most > least ? kThicknesses : 1) {
  for (int row = 0; row < rows_; ++row) {
    const double thickness = rows_ == 1 ? least : least + (most - least) * row / (rows_ - 1);
    for (int k = 0; k < kCosines; ++k)
      table_.push_back(seen([&](double wavelength) {
        return film_reflectance(k / (kCosines - 1.0), 1, index, substance(wavelength), thickness, wavelength);
      }));
  }
}

Spectrum FilmTable::reflectance(double thickness, double cosine, const Wavelengths& wavelengths) const {
  if (!is_spectral(wavelengths)) return tabled(thickness, cosine);
  Spectrum value;
  for (int i = 0; i < 4; ++i) {
    const double nanometres = wavelengths.nanometres[static_cast<size_t>(i)];
    value.set(i,
              static_cast<float>(film_reflectance(cosine, 1, index_, substance_(nanometres), thickness, nanometres)));
  }
  return value;
}

Spectrum FilmTable::tabled(double thickness, double cosine) const {
  const auto [row, b] = entry(rows_ == 1 ? 0 : (thickness - least_) / (most_ - least_) * (rows_ - 1), rows_);
  const auto [k, a] = entry(std::clamp(cosine, 0.0, 1.0) * (kCosines - 1), kCosines);
  const auto in_row = [&](int r) {
    const Spectrum* const at = &table_[static_cast<size_t>(r) * kCosines + static_cast<size_t>(k)];
    return (1 - a) * at[0] + a * at[1];
  };
  return rows_ == 1 ? in_row(0) : (1 - b) * in_row(row) + b * in_row(row + 1);
}

}  // namespace lekalo::render
