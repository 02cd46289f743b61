// The operations of expressions: one list of what a program's instructions do, and of how functions are called.
// Internal to geometry/expression.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace lekalo::geometry {

enum class Operation : std::uint8_t {
  // operands
  literal,
  name,
  variable,
  pi,
  // units: a plain number becomes an angle
  degrees,
  radians,
  turns,
  // operators
  negate,
  add,
  subtract,
  multiply,
  divide,
  power,
  integer_power,  // the exponent is in the instruction
  equal,
  unequal,
  less,
  less_equal,
  greater,
  greater_equal,
  logical_and,
  logical_or,
  logical_not,
  select,  // value if true, condition, value if false
  // written out when names are bound: a block of formulas and the name of its counter
  local,
  block,
  // functions of one argument
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  sinh,
  cosh,
  tanh,
  asinh,
  acosh,
  atanh,
  exp,
  log,
  log10,
  sqrt,
  cbrt,
  abs,
  sign,
  floor,
  ceil,
  round,
  erf,
  fresnel_s,
  fresnel_c,
  sinc,
  factorial,
  // of two or more
  atan2,
  min,
  max,
  hypot,
  mod,
  clamp,
  lerp,
  binom,
  // what FormulaProgram makes of the others: a sum with a product, one operand and a constant in the step, two results
  multiply_add,  // a * b + c
  square,
  scale,        // a * constant
  shift,        // a + constant
  divide_by,    // a / constant
  subtract_of,  // constant - a
  divide_of,    // constant / a
  sin_cos       // two results
};

// How a function's measures go together; see expression.h.
enum class Signature {
  plain,     // plain numbers to a plain number
  of_angle,  // an angle, or radians, to a plain number
  to_angle,  // plain numbers to an angle
  same,      // arguments of one measure, which the result has
  same_to_angle,
  any_to_plain
};

struct Function {
  std::string_view name;
  Operation operation;
  int fewest, most;  // arguments; min, max, hypot apply their operation again for each further one
  Signature signature;
  std::string_view description;  // with its arguments: "sin(x)  sine"
};

std::span<const Function> functions();
const Function* find_function(std::string_view name);
const Function& function_of(Operation operation);  // operation is one of the functions

// How many values an operation takes from the stack; a function's further arguments are applied one at a time.
int operand_count(Operation operation);

}  // namespace lekalo::geometry
