// Parts of a curve over which its speed is steady, so that the error of a rule of integration can be told from its
// nodes.
//
// The speed sqrt(r' . r') is analytic but for complex t where r' . r' = 0. With |r''| h <= |r'| over a part of half
// width h, certified by enclosures, |r'(t + i y) - r'(t)| is less than (sqrt 2 - 1) |r'(t)| as far as y = 0.4 h, and
// r' . r' has no zero there: a turn so sharp that all nodes miss it lies in a part of its own.
#pragma once

#include <vector>

#include "geometry/curve.h"

namespace lekalo::geometry {

// A part too narrow to be divided, or as short as rounding, in which the speed is not steady: it counts as its chord.
struct ChordPart {
  Interval t;
  double length = 0;  // of the chord
  double error = 0;   // by which the part may be longer: as the sides of its box, which no monotone curve exceeds
};
struct SteadyParts {
  std::vector<double> breaks;     // increasing, the ends of `range` and of smooth pieces among them
  std::vector<ChordPart> chords;  // between breaks, by t
  double rounding = 0;            // what that of the parameter changes, a length
  double least = 0;               // the length of the polygon through the curve's points at the breaks

  // The chord part that t lies in, or null.
  const ChordPart* chord_at(double t) const;
  // By how much a length found by these parts may be wrong because of chords, rounding and what its nodes missed.
  double error(double found) const;
};

// Pieces with more parts than kMaxSteadyParts, or without enclosures, are only halved towards their ends.
inline constexpr int kMaxSteadyParts = 1024;
SteadyParts steady_parts(const Curve& curve, const Interval& range);

}  // namespace lekalo::geometry
