#include "geometry/queries/implicit_curves/implicit_branches.h"

#include <algorithm>

#include "geometry/curves/operations/curve_sign_changes.h"
#include "geometry/expression/branches.h"

namespace lekalo::geometry {

Interval ImplicitSide::range(const Box3& box) const {
  const Interval range = height->enclose(to_formula.is_identity() ? box : transformed(box, to_formula));
  return positive ? range : -range;
}

bool hold(const std::vector<ImplicitSide>& sides, const Vec3& p) {
  return std::all_of(sides.begin(), sides.end(), [&](const ImplicitSide& side) { return side.value(p) >= 0; });
}

void each_kept(const Interval& domain, bool closed, const std::vector<double>& cuts,
               const std::function<bool(double)>& keeps, const std::function<void(const Interval&)>& put) {
  constexpr double kMinPart = 1e-9;  // of the domain
  std::vector<double> ends;
  if (!closed || cuts.empty()) ends.push_back(domain.lo);
  ends.insert(ends.end(), cuts.begin(), cuts.end());
  ends.push_back(closed && !cuts.empty() ? cuts.front() + domain.width() : domain.hi);
  for (size_t k = 0; k + 1 < ends.size(); ++k) {
    const Interval t{ends[k], ends[k + 1]};
    double inside = place_inside(t);
    if (inside > domain.hi) inside -= domain.width();
    if (t.width() > kMinPart * domain.width() && keeps(inside)) put(t);
  }
}

void each_kept(const Curve& curve, bool closed, const std::vector<ImplicitSide>& sides,
               const std::function<void(const Interval&)>& put) {
  std::vector<double> cuts;
  for (const ImplicitSide& side : sides) {
    const std::vector<double> found = sign_changes(
        curve, closed, [&](const Box3& box) { return side.range(box); }, [&](const Vec3& p) { return side.value(p); });
    cuts.insert(cuts.end(), found.begin(), found.end());
  }
  std::sort(cuts.begin(), cuts.end());
  const Interval domain = curve.domain();
  const auto at = [&](double t) { return curve.point(t > domain.hi ? t - domain.width() : t); };
  each_kept(
      domain, closed, cuts, [&](double t) { return hold(sides, at(t)); }, put);
}

bool may_hold(const std::vector<ImplicitSide>& sides, const Box3& box) {
  return std::none_of(sides.begin(), sides.end(), [&](const ImplicitSide& side) { return side.range(box).hi < 0; });
}

std::vector<ImplicitBranch> implicit_branches(const ImplicitFormula& formula, const Box3& box,
                                              const Affine& to_formula) {
  const std::shared_ptr<const ImplicitFormula> whole(std::shared_ptr<const ImplicitFormula>(), &formula);
  if (formula.smoothness() == Expression::Smoothness::smooth) return {{whole, {}}};
  const auto found = expression_branches({&formula.expression(), 1});
  if (!found) return {{whole, {}}};
  std::vector<ImplicitBranch> branches;
  for (const ExpressionBranch& one : *found) {
    ImplicitBranch branch;
    for (const ExpressionBranch::Side& side : one.sides)
      branch.sides.push_back({std::make_shared<ImplicitFormula>(side.height, 0), side.positive, to_formula});
    if (!may_hold(branch.sides, box)) continue;
    branch.formula = std::make_shared<ImplicitFormula>(one.formulas[0], formula.level());
    branches.push_back(std::move(branch));
  }
  return branches;
}

}  // namespace lekalo::geometry
