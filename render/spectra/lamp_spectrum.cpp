#include "render/spectra/lamp_spectrum.h"

#include <algorithm>

#include "render/spectra/hero_wavelengths.h"
#include "render/spectra/illuminants.h"
#include "render/spectra/observer.h"

namespace lekalo::render {

LampSpectrum::LampSpectrum(const std::function<double(double)>& power) {
  for (int i = 0; i < kSpectrumEntries; ++i)
    multiples_.push_back(power(entry_nanometres(i)) / illuminant_power("D65", entry_nanometres(i)));
  const Vec3 color = color_of([this](double nanometres) { return multiple(nanometres); });
  const double scale = 1 / luminance(color);
  for (double& multiple : multiples_) multiple *= scale;
  color_ = cut_to_rec709(scale * color);
}

double LampSpectrum::multiple(double nanometres) const {
  return entry_at(nanometres, [this](size_t i) { return multiples_[i]; });
}

Spectrum LampSpectrum::at(const Spectrum& colored, const Wavelengths& wavelengths) const {
  if (!is_spectral(wavelengths)) return colored;
  const double times = colored.largest() / std::max({color_.x, color_.y, color_.z});
  Spectrum light;
  for (int i = 0; i < 4; ++i)
    light.set(i, static_cast<float>(times * multiple(wavelengths.nanometres[static_cast<size_t>(i)])));
  return light;
}

void declare_lamp_spectrum(geometry::TypeDeclaration& type) {
  type.optional("spectrum", geometry::choice(illuminant_names()),
                "of a standard illuminant of the CIE in place of `color`: D65 and D50 daylight, A a filament lamp, F2, "
                "F7, F11 fluorescent ones; of luminance 1")
      .optional("temperature", geometry::number().between(500, 100000),
                "kelvin: the light of a black body in place of `color`, of luminance 1");
}

LampSpectrumPtr lamp_spectrum(const geometry::Fields& fields) {
  const bool is_named = fields.has("spectrum"), is_black = fields.has("temperature");
  if (is_named && is_black)
    throw geometry::FieldError("temperature", "both 'spectrum' and 'temperature' are given", "leave one out");
  if (!is_named && !is_black) return nullptr;
  if (!fields.holds<Vec3>("color") || fields.vec3("color") != Vec3(1))
    throw geometry::FieldError("color", "the lamp's spectrum says of what colour it is",
                               "leave 'color' out, or the spectrum");
  if (is_black)
    return std::make_shared<LampSpectrum>(
        [kelvin = fields.number("temperature")](double l) { return black_body_power(kelvin, l); });
  return std::make_shared<LampSpectrum>(
      [name = fields.text("spectrum")](double l) { return illuminant_power(name, l); });
}

}  // namespace lekalo::render
