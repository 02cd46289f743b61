// Thin films: oil on water, soap bubbles, tempered steel, coated lenses. Light is reflected by both faces of the film,
// and what comes back together is stronger or weaker by colour, angle and thickness.
#pragma once

#include <complex>
#include <functional>
#include <memory>
#include <vector>

#include "render/spectrum.h"

namespace lekalo::render {

// Reflectance of unpolarised light of a wavelength (of air, in the unit of the thickness) from a film of index n1
// between n0 and the substance n2 = n - i k; cos_incident in [0, 1] on the side of n0 (Airy's sum, Born and Wolf
// 1999, 7.6 and 14.4):
//   r = (r01 + r12 e) / (1 + r01 r12 e),  e = exp(-2 i b),  b = 2 pi n1 thickness cos_1 / wavelength,
// r01 and r12 Fresnel's amplitudes of both faces, for both polarisations; the mean of |r|^2.
double film_reflectance(double cos_incident, double n0, double n1, std::complex<double> n2, double thickness,
                        double wavelength);

// The same from air in colours: for each of red, green and blue the mean over the visible wavelengths, weighted by the
// CIE 1931 functions in linear Rec.709, cut to [0, 1]. A table over the cosine and the thickness, linear between its
// entries.
class FilmTable {
 public:
  // Thickness in nanometres, of which all between the two are asked for; `substance` the index below at a wavelength in
  // nanometres.
  FilmTable(double index, double least, double most, const std::function<std::complex<double>(double)>& substance);

  // At wavelengths of spectral rendering of these, without the table.
  Spectrum reflectance(double thickness, double cosine, const Wavelengths& wavelengths = {}) const;

 private:
  Spectrum tabled(double thickness, double cosine) const;

  double index_;
  std::function<std::complex<double>(double)> substance_;
  double least_, most_;
  int rows_;
  std::vector<Spectrum> table_;  // by thickness, then cosine
};
using FilmTablePtr = std::shared_ptr<const FilmTable>;

}  // namespace lekalo::render
