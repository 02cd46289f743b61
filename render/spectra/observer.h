// Spectra as the eye sees them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include "render/spectrum.h"

namespace lekalo::render {

// The tables of spectra have entries from 380 to 780 nm in these steps; between them they are straight lines.
inline constexpr double kFirstNanometre = 380, kNanometreStep = 5;
inline constexpr int kSpectrumEntries = 81;
inline double entry_nanometres(int i) { return kFirstNanometre + kNanometreStep * i; }

// At a wavelength, of a table whose entry i is entry(i): constant beyond its ends.
template <class Entry>
double entry_at(double nanometres, const Entry& entry) {
  const double place = std::clamp((nanometres - kFirstNanometre) / kNanometreStep, 0.0, kSpectrumEntries - 1.0);
  const size_t i = std::min(static_cast<size_t>(place), static_cast<size_t>(kSpectrumEntries - 2));
  const double share = place - static_cast<double>(i);
  return (1 - share) * entry(i) + share * entry(i + 1);
}

// The CIE 1931 functions x, y, z of the 2-degree observer.
const std::vector<Vec3>& observer();

// XYZ to linear Rec.709 (ITU-R BT.709-6, white D65).
Vec3 rec709(const Vec3& xyz);

// Luminance of linear Rec.709.
double luminance(const Vec3& rgb);

// The nearest thing to a colour of positive luminance that Rec.709 has: cut to what is not negative, and as bright.
Vec3 cut_to_rec709(const Vec3& rgb);

// Linear Rec.709 of light with so much power per nanometre: of constant power 1 its luminance is the integral of the
// function y, 106.857.
Vec3 observed(const std::function<double(double nanometres)>& power);

}  // namespace lekalo::render
