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

// A piece without a rational form.
inline SurfacePiece plain_piece(const Rectangle& domain) {
  SurfacePiece piece;
  piece.domain = domain;
  piece.map_u = {ParameterMap::Kind::affine, domain.u.lo, domain.u.hi};
  piece.map_v = {ParameterMap::Kind::affine, domain.v.lo, domain.v.hi};
  return piece;
}

}  // namespace lekalo::geometry
