// Formulas compiled for evaluation: one flat program over the values that several expressions have in common.
//
// Equal parts are computed once (value numbering), the sine and the cosine of one argument together, a product with the
// sum that needs it alone, constant parts at build time, over doubles and over intervals each by its own arithmetic.
// Whole powers are products. Values live in few numbered places that are used again once nothing needs them, so that
// nothing is allocated and all stays in cache.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/numerics/gradient.h"
#include "geometry/numerics/interval.h"
#include "geometry/numerics/jet.h"
#include "geometry/numerics/jet3.h"

namespace lekalo::geometry {

class Expression;
enum class Operation : std::uint8_t;

class FormulaProgram {
 public:
  FormulaProgram() = default;
  // Of bound expressions of the same variables.
  explicit FormulaProgram(std::span<const Expression> formulas);

  // The value of each formula with `values` for the variables.
  // T: double, Interval, Jet<double, 1..6>, Jet2<double, 1..4>, Jet<Interval, 1, 2, 4>, Jet2<Interval, 1, 2, 4>,
  // Jet3<double, 2..3>, Jet3<Interval, 2>, Gradient<double>, Gradient<Interval>, Majorant<4>.
  template <class T>
  void evaluate(std::span<const T> values, std::span<T> results) const;

 private:
  class Builder;
  // A constant, as it is over each kind of number.
  struct Constant {
    double value = 0;
    Interval range;
  };
  // Operands and results are places; `index` is that of a variable or a constant, or a whole exponent.
  struct Step {
    Operation operation{};
    std::int32_t a = 0, b = 0, c = 0;
    std::int32_t to = 0, second = 0;
    std::int32_t index = 0;
  };

  std::vector<Step> steps_;
  std::vector<Constant> constants_;
  std::vector<std::int32_t> results_;  // the place of each formula's value
  std::int32_t places_ = 0;
};

}  // namespace lekalo::geometry
