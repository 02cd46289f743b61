// A number that depends on one other: a constant, or a formula of it (a radius along a curve, an angle along a path).
#pragma once

#include <memory>

#include "geometry/expression/expression.h"

namespace lekalo::geometry {

class ScalarLaw {
 public:
  explicit ScalarLaw(double constant) : constant_(constant) {}
  // The expression is bound to one variable.
  explicit ScalarLaw(Expression formula) {
    if (formula.is_constant())
      constant_ = formula.evaluate(std::span<const double>());
    else
      formula_ = std::make_shared<const Expression>(std::move(formula));
  }

  bool is_constant() const { return !formula_; }
  bool is_zero() const { return !formula_ && constant_ == 0; }

  // T: those of FormulaProgram.
  template <class T>
  T operator()(const T& x) const {
    return formula_ ? formula_->evaluate(std::span<const T>(&x, 1)) : T(constant_);
  }

 private:
  double constant_ = 0;
  std::shared_ptr<const Expression> formula_;  // null: the constant
};

}  // namespace lekalo::geometry
