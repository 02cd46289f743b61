// Sine and cosine of one number together, right to 0.9 units in the last place: inline, without a branch but for huge
// arguments, and the same bits on every processor.
//
// x = n pi/2 + r with |r| <= pi/4: n times pi/2 is subtracted in three parts (33, 33 and 53 bits), the first two
// products exact, so that r has the full relative precision as a sum of two doubles (Cody, Waite 1980). Taylor's
// polynomials of degrees 17 and 16 in r are right to 1e-17; both are computed at once, one a lane.
#pragma once

#include <cmath>

namespace lekalo::geometry {

inline void sine_and_cosine(double x, double& sine, double& cosine) {
  constexpr double kLargest = 0x1p20;  // n has 20 bits
  if (!(std::fabs(x) < kLargest)) {
    sine = std::sin(x);
    cosine = std::cos(x);
    return;
  }
  constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1, kRound = 0x1.8p52;  // adding this rounds to a whole number
  constexpr double kFirst = 0x1.921fb54400000p+0, kSecond = 0x1.0b4611a600000p-34, kThird = 0x1.3198a2e037073p-69;
  const double n = (x * kTwoOverPi + kRound) - kRound;
  const double a = x - n * kFirst, b = n * kSecond, c = a - b;
  const double tail = ((a - c) - b) - n * kThird, r = c + tail, rest = (c - r) + tail;
  // sin r = r + r z S(z), cos r = 1 - z / 2 + z^2 C(z) with z = r^2.
  using Pair = double __attribute__((vector_size(16)));
  constexpr Pair k0{-1.0 / 6, 1.0 / 24}, k1{1.0 / 120, -1.0 / 720}, k2{-1.0 / 5040, 1.0 / 40320},
      k3{1.0 / 362880, -1.0 / 3628800}, k4{-1.0 / 39916800, 1.0 / 479001600}, k5{1.0 / 6227020800, -1.0 / 87178291200},
      k6{-1.0 / 1307674368000, 1.0 / 20922789888000}, k7{1.0 / 355687428096000, 0};
  const double z = r * r, z2 = z * z;
  const Pair series = ((k0 + k1 * z) + (k2 + k3 * z) * z2) + ((k4 + k5 * z) + (k6 + k7 * z) * z2) * (z2 * z2);
  const double half = 0.5 * z, one = 1 - half;
  const double values[2] = {r + (r * (z * series[0]) + rest * one),
                            one + (((1 - one) - half) + (z2 * series[1] - r * rest))};
  // A quarter turn makes a sine of the cosine, a half turn changes the signs.
  static constexpr double kSigns[5] = {1, 1, -1, -1, 1};
  const unsigned quarters = static_cast<unsigned>(static_cast<int>(n)) & 3;
  sine = kSigns[quarters] * values[quarters & 1];
  cosine = kSigns[quarters + 1] * values[~quarters & 1];
}

}  // namespace lekalo::geometry
