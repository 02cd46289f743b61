#include "geometry/curves/splines/knot_spans.h"

#include <algorithm>
#include <stdexcept>

#include "geometry/tolerances.h"

namespace lekalo::geometry {

std::vector<SpanPart> span_parts(int degree, std::span<const double> knots, std::span<const ParameterMap> maps,
                                 const Interval& domain) {
  const int last = static_cast<int>(knots.size()) - 1 - degree;
  const double sliver = kDomainSlack * std::max(domain.width(), 0.0);
  if (last <= degree || domain.lo < knots[degree] - sliver || domain.hi > knots[last] + sliver || domain.empty())
    throw std::invalid_argument("the domain lies outside the domain of the NURBS form");

  std::vector<SpanPart> parts;
  size_t number = 0;
  for (int span = degree; span < last; ++span) {
    if (!(knots[span] < knots[span + 1])) continue;
    if (!maps.empty() && number >= maps.size())
      throw std::invalid_argument("the NURBS form has fewer parameter maps than non-empty spans");
    const ParameterMap map =
        maps.empty() ? ParameterMap{ParameterMap::Kind::affine, knots[span], knots[span + 1]} : maps[number];
    ++number;
    const Interval inside = intersect({knots[span], knots[span + 1]}, domain);
    if (!(inside.width() > sliver)) continue;
    SpanPart part;
    part.span = span;
    part.natural = inside;
    part.map = map;
    parts.push_back(part);
  }
  if (parts.empty()) return parts;
  parts.front().natural.lo = domain.lo;
  parts.back().natural.hi = domain.hi;
  for (SpanPart& part : parts) {
    const ParameterMap full = part.map;
    part.rational = {full.rational(part.natural.lo), full.rational(part.natural.hi)};
    if (part.natural.lo != full.lo || part.natural.hi != full.hi) part.map = full.cut(part.natural.lo, part.natural.hi);
  }
  return parts;
}

std::array<SpanPart, 2> halves(const SpanPart& part) {
  SpanPart lower = part, upper = part;
  lower.rational.hi = upper.rational.lo = part.rational.middle();
  lower.natural.hi = upper.natural.lo = part.map.natural(part.rational.middle());
  return {lower, upper};
}

}  // namespace lekalo::geometry
