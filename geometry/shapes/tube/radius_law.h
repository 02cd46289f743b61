// The radius of a ball that moves along a curve: constant, or a formula of the fraction s of the arc length.
//
//   R(t) = f(s(t)),   s' = |r'|/L,   s'' = (r' . r'')/(|r'| L)
#pragma once

#include "geometry/curves/operations/arc_fraction.h"
#include "geometry/expression/expression.h"

namespace lekalo::geometry {

class RadiusLaw {
 public:
  // Throws FieldError (field radius) for a radius that is not positive and finite.
  explicit RadiusLaw(double constant);
  // `law` is bound to the variable s. The curve's domain must be finite; throws FieldError (fields radius and of).
  RadiusLaw(const Expression& law, const Curve& curve);

  // True if the law may have kinks or jumps.
  bool has_branches() const { return has_branches_; }
  // R, R', R'' where the curve has this jet.
  std::array<double, 3> at(double t, const CurveJet& jet) const;
  // Certified enclosures of them over parameters where the curve has these. A law made of branches (if, min, abs) is
  // enclosed branch by branch.
  std::array<Interval, 3> over(const Interval& t, const CurveEnclosure& boxes) const;
  // The error for a radius that is not positive or has no value at the parameter.
  [[noreturn]] void refuse(double t, double radius) const;

 private:
  double constant_ = 0;
  bool has_branches_ = false;
  Expression law_;
  ArcFraction fraction_;  // of a formula
};

}  // namespace lekalo::geometry
