// Smooth parts of curves, for surfaces made of curves that have no rational form.
#pragma once

#include "geometry/surface.h"

namespace lekalo::geometry {

// The domains of the curve's pieces that lie in the range, cut to it.
inline std::vector<Interval> parts_of(const Curve& curve, const Interval& range) {
  std::vector<Interval> parts;
  for (const CurvePiece& piece : curve.pieces()) {
    const Interval part = intersect(piece.domain, range);
    if (part.width() > 0) parts.push_back(part);
  }
  return parts;
}

}  // namespace lekalo::geometry
