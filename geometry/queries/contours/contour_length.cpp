#include "geometry/queries/contours/contour_length.h"

#include <cmath>

#include "geometry/numerics/quadrature.h"
#include "geometry/queries/contours/contour_approximation.h"
#include "geometry/queries/contours/contour_curve.h"

namespace lekalo::geometry {

Measured contour_length(const Contour& contour, const Interval& t) {
  if (const Interval all = contour.curve->domain(); contour.closed && t.hi > all.hi) {
    const Measured first = contour_length(contour, {t.lo, all.hi}),
                   rest = contour_length(contour, {all.lo, t.hi - all.width()});
    return {first.value + rest.value, first.error + rest.error};
  }
  if (!is_searched(*contour.curve)) return arc_length(*contour.curve, t.lo, t.hi);
  static const GaussRule coarse = gauss_legendre(6), fine = gauss_legendre(9);
  Measured sum;
  for (const CurvePiece& piece : contour.curve->pieces()) {
    const Interval part = intersect(t, piece.domain);
    if (!(part.width() > 0)) continue;
    const auto by = [&](const GaussRule& rule) {
      double length = 0;
      for (size_t k = 0; k < rule.nodes.size(); ++k)
        length += 0.5 * part.width() * rule.weights[k] *
                  glm::length(contour.curve->evaluate(part.middle() + 0.5 * part.width() * rule.nodes[k], 1).d[1]);
      return length;
    };
    const double length = by(fine);
    sum.value += length;
    sum.error += std::abs(length - by(coarse)) + 1e-16 * length;
  }
  return sum;
}

}  // namespace lekalo::geometry
