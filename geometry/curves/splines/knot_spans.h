// The non-empty spans of a knot vector, cut to a domain.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/curve.h"

namespace lekalo::geometry {

// The part of one knot span inside a domain: the natural parameters, the rational ones (the knot vector's own) and the
// map of the Bezier piece over it.
struct SpanPart {
  int span = 0;  // knots[span] < knots[span + 1]
  Interval natural;
  Interval rational;
  ParameterMap map;
};

// Parts of the non-empty spans of knots[degree..size - 1 - degree] that meet the domain, in order, covering it without
// gaps. `maps` has one entry for each non-empty span or is empty (affine). A sliver at an end of the domain, narrower
// than kDomainSlack of it, is left to the neighbouring part.
// Throws std::invalid_argument when the domain does not lie in the knots' (to rounding) or the maps are too few.
std::vector<SpanPart> span_parts(int degree, std::span<const double> knots, std::span<const ParameterMap> maps,
                                 const Interval& domain);

// Its lower and upper half.
std::array<SpanPart, 2> halves(const SpanPart& part);

// Halvings after which a Bezier piece with a positive denominator is taken to have positive weights, as all have sooner
// or later. Pieces are cut so, because the hull of their control points bounds nothing before.
inline constexpr int kMaxHalvingsForWeights = 12;

}  // namespace lekalo::geometry
