// Spectra as the eye sees them.
#pragma once

#include <functional>

#include "render/spectrum.h"

namespace lekalo::render {

// Linear Rec.709 (ITU-R BT.709-6, white D65) of light with so much power per nanometre, by the CIE 1931 functions every
// 5 nm from 380 to 780 nm: of constant power 1 its luminance is the integral of the function y, 106.857.
Vec3 observed(const std::function<double(double nanometres)>& power);

}  // namespace lekalo::render
