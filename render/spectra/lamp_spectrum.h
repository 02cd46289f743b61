// Spectra of lamps that are known better than by their colour.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "geometry/describe.h"
#include "render/spectrum.h"

namespace lekalo::render {

class LampSpectrum {
 public:
  // `power` per nanometre, up to a factor; some of it is visible.
  explicit LampSpectrum(const std::function<double(double nanometres)>& power);

  // Linear Rec.709 of luminance 1, none of it negative: the colour of the lamp where no wavelengths count.
  const Vec3& color() const { return color_; }
  // Light that has this spectrum and is `colored`, a multiple of color() in RGB, at the wavelengths.
  Spectrum at(const Spectrum& colored, const Wavelengths& wavelengths) const;

 private:
  double multiple(double nanometres) const;  // of D65, luminance 1

  std::vector<double> multiples_;  // at the entries of the tables of spectra (observer.h)
  Vec3 color_{1};
};
using LampSpectrumPtr = std::shared_ptr<const LampSpectrum>;

// Fields spectrum and temperature of what shines in a field `color`, which is then left at white; null without them.
void declare_lamp_spectrum(geometry::TypeDeclaration& type);
LampSpectrumPtr lamp_spectrum(const geometry::Fields& fields);

}  // namespace lekalo::render
