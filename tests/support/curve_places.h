// Measures of curves by places on them, which know nothing of their derivatives.
#pragma once

#include <algorithm>

#include "geometry/curve.h"

namespace lekalo::checks {

// Of the chords between so many places and one more.
inline double chord_length(const geometry::Curve& curve, int chords) {
  const geometry::Interval t = curve.domain();
  const auto place = [&](int k) { return curve.point(t.lo + t.width() * k / chords); };
  double length = 0;
  for (int k = 0; k < chords; ++k) length += glm::length(place(k + 1) - place(k));
  return length;
}

// How near a point is to a curve: where it is nearer than at both neighbours of 61 places, by thirds.
inline double distance_to(const geometry::Curve& curve, const geometry::Vec3& p) {
  constexpr int kPlaces = 60, kSteps = 60;
  const geometry::Interval all = curve.domain();
  const auto distance = [&](double t) { return glm::length(curve.point(t) - p); };
  const auto place = [&](int k) { return all.clamp(all.lo + all.width() * k / kPlaces); };
  double least = geometry::kInfinity;
  for (int k = 0; k <= kPlaces; ++k) {
    if (distance(place(k)) > std::min(distance(place(k - 1)), distance(place(k + 1)))) continue;
    double lo = place(k - 1), hi = place(k + 1);
    for (int i = 0; i < kSteps; ++i) {
      const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
      (distance(a) < distance(b) ? hi : lo) = distance(a) < distance(b) ? b : a;
    }
    least = std::min(least, distance(0.5 * (lo + hi)));
  }
  return least;
}

}  // namespace lekalo::checks
