// Places along a part of a curve where it is asked whether the part lies on another curve or a surface. Their steps are
// uneven: at even ones a wave may cross.
#pragma once

#include <cmath>

namespace lekalo::geometry {

inline constexpr int kPlacesOfCommonPart = 24;
// From 0 at place 0 to 1 at the last, kPlacesOfCommonPart.
inline double share_of_place(int place) {
  constexpr double kGoldenRatio = 0.6180339887498949;
  const double by = place == kPlacesOfCommonPart ? 0 : 0.5 * std::fmod(place * kGoldenRatio, 1);
  return (place + by) / kPlacesOfCommonPart;
}

}  // namespace lekalo::geometry
