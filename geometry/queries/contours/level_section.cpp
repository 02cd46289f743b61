#include "geometry/queries/contours/level_section.h"

#include <algorithm>
#include <cmath>

#include "geometry/queries/contours/contour_approximation.h"
#include "geometry/queries/contours/contour_parts.h"
#include "geometry/queries/contours/contours_of_function.h"
#include "geometry/queries/implicit_curves/implicit_branches.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

static Contours smooth_level_section(const SurfacePtr& surface, const ImplicitFormula& formula,
                                     const Affine& to_formula) {
  // Divided by what it changes over a length, so that its values are about distances.
  constexpr int kSteps = 8;
  const Rectangle domain = surface->domain();
  double most = 0;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const Vec3 p =
          surface->point(domain.u.lo + domain.u.width() * i / kSteps, domain.v.lo + domain.v.width() * j / kSteps);
      const double slope = glm::length(glm::transpose(to_formula.linear) * formula.gradient(to_formula.point(p)));
      if (std::isfinite(slope)) most = std::max(most, slope);
    }
  const double by = most > 0 ? 1 / most : 1;
  const auto value = [formula, m = to_formula.linear, o = to_formula.offset, by](const auto& s, const auto&,
                                                                                 const auto&) {
    using T = std::decay_t<decltype(s.x)>;
    const auto coordinate = [&](int k) -> T { return s.x * m[0][k] + s.y * m[1][k] + s.z * m[2][k] + o[k]; };
    return T(formula(coordinate(0), coordinate(1), coordinate(2)) * by);
  };
  Contours found = contours_of(surface, {false, value});
  if (formula.smoothness() != Expression::Smoothness::smooth) found.complete = false;
  return found;
}

Contours level_section(const SurfacePtr& surface, const ImplicitFormula& formula, const Affine& to_formula) {
  demand_bounded(*surface);
  Contours all;
  for (const ImplicitBranch& branch : implicit_branches(formula, transformed(bounds(*surface), to_formula))) {
    Contours found = of_parts(
        surface, 0, [&](const SurfacePtr& part) { return smooth_level_section(part, *branch.formula, to_formula); });
    all.points.insert(all.points.end(), found.points.begin(), found.points.end());
    all.coincident = all.coincident || found.coincident;
    all.complete = all.complete && found.complete;
    for (const Contour& contour : found.branches)
      add_kept(contour, *transformed(contour_approximation(contour.curve), to_formula), branch.sides, all.branches);
  }
  return all;
}

}  // namespace lekalo::geometry
