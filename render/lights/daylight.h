// The clear sky and the sun by A. J. Preetham, P. Shirley, B. Smits, "A practical analytic model for daylight" (1999).
#pragma once

#include "render/spectrum.h"

namespace lekalo::render {

// Light of the sky from where the sun stands at `to_sun` (unit, z >= 0) and the air has so much haze: turbidity 1.7
// (the clearest) to 10 (thick haze).
class Daylight {
 public:
  Daylight(const Vec3& to_sun, double turbidity);

  // Luminance in kcd/m^2 and chromaticity of the sky in a unit direction; below the horizon as at it.
  struct Look {
    double luminance, x, y;
  };
  Look look(const Vec3& direction) const;
  // The same as linear Rec.709 whose luminance is that, cut at zero.
  Vec3 radiance(const Vec3& direction) const;
  // Of the sun on a surface that faces it, in klx: the solar constant of 128 klx of a black body of 5778 K through air
  // (Rayleigh's scattering, haze by Angstrom, ozone).
  Vec3 sun() const;
  // Its power per nanometre in any unit; the sun stands less than 93 degrees from the zenith.
  double sun_power(double nanometres) const;

 private:
  struct Perez {
    double a, b, c, d, e;
    double at(double cos_zenith, double gamma) const;
  };
  double quantity(const Perez& f, double zenith, double cos_zenith, double gamma) const;

  Vec3 to_sun_;
  double turbidity_, sun_zenith_;  // radians
  Perez luminance_, x_, y_;
  double zenith_luminance_, zenith_x_, zenith_y_;
};

}  // namespace lekalo::render
