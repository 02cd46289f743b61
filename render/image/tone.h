// Tone curves: light without bounds to what a display can show, for whole colours.
//
//   filmic       K. Narkowicz, "ACES Filmic Tone Mapping Curve" (2015), of each channel alone:
//                f(x) = x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14), taken at 0.6 times the radiance (his remark on
//                the original's exposure), as HDR-FLIP takes it too (Andersson et al. 2021); 1 at 12.1 times white
//   agx          T. Sobotka's AgX in B. Wrensch's form ("Minimal AgX implementation", 2022): colours are drawn together
//                by a matrix, their logarithms to base 2 from -12.47393 to 4.026069 mapped by a polynomial of degree 6,
//                spread again, and taken to the power 2.2; bright colours go to white without turning
//   pbr_neutral  Khronos' PBR Neutral (2024): colours up to 0.8 less 0.04 are kept as they are, brighter ones pressed
//                together and drawn to white
#pragma once

#include <array>

namespace lekalo::render {

enum class ToneCurve { none, filmic, agx, pbr_neutral };

// The filmic curve above, the factor 0.6 included: linear light >= 0 to linear light, not yet clipped at 1.
double filmic(double linear);

// Linear Rec.709, finite, none negative: the linear light to show, which none leaves as it is; not yet clipped at 1.
std::array<double, 3> toned(ToneCurve curve, const std::array<double, 3>& color);

}  // namespace lekalo::render
