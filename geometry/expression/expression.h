// Formulas of scene files: parsed once, evaluated as numbers, jets (derivatives) and intervals (enclosures).
//
// Grammar, loosest first:
//
//   a if c else b   or   and   not   == != < <= > >=   + -   * /   unary + -   ^ (to the right: 2^3^2 = 2^9, -2^2 = -4,
//   2^-1) number [unit] | pi [unit] | name | function(arguments) [unit] | (expression) [unit]
//
// Numbers: 12, 0.5, .5, 1e-3. Units: deg, rad, turn. A product is always written with *, but for a number before its
// unit. There is no constant e (write exp(1)); comparisons do not chain (write a < b and b < c).
//
// Every expression has a measure, which keeps radians and degrees apart:
//
//   plain   a number. The literal 0 goes for an angle too.
//   angle   30 deg, 1.2 rad, (n/8) turn, asin acos atan atan2 of plain numbers; inside, always radians
//   truth   a comparison, and, or, not: for conditions only
//
//   + - comparisons, the branches of `if`, abs min max clamp hypot mod: operands of one measure, which the result has
//   angle * plain, angle / plain: angle;   angle / angle: plain;   sign: plain;   other products and quotients: an
//   error sin cos tan: an angle, or a plain number in radians;   all other functions, ^ and units: plain numbers only
//
// In an angle field a plain expression means degrees (convert_to_angle), also when it was computed, and also that of a
// parameter. One that came from pi by + - * / and the like is an error there: whoever writes pi thinks in radians. The
// result of a function such as cos(pi/4) has lost its pi. In a plain field, an angle counts as its radians.
//
// sum(i, a, b, formula) and integral(x, a, b, formula) name their counter first; they are written out when names are
// bound, where the ends of a sum must be known.
//
// Nothing throws. Division by zero, the root of a negative number and the like evaluate to infinity or NaN (over
// intervals: to the whole line), which the caller reports.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "geometry/expression/formula_program.h"

namespace lekalo::geometry {

enum class Measure { plain, angle, truth };

// What is wrong, where (in bytes from the start of the text), and the cure; the hint may be empty.
struct ExpressionError {
  std::size_t offset = 0;
  std::string message;
  std::string hint;
};

class Expression {
 public:
  static constexpr int kDeepest = 200;            // nested parentheses, functions, signs, powers, else branches
  static constexpr std::size_t kLongest = 10000;  // bytes of text
  static constexpr std::size_t kMaxSteps = 20000;

  // A name that gets its value at each evaluation (t, u, v, s).
  struct Variable {
    std::string name;
    Measure measure = Measure::plain;
  };
  // A name whose value is known when the expression is bound: a parameter, a counter.
  struct Constant {
    std::string name;
    double value = 0;  // an angle in radians
    Measure measure = Measure::plain;
    bool holds_pi = false;  // of the expression that made it
  };

  // One expression. If it has no names it is bound already.
  static std::variant<Expression, ExpressionError> parse(std::string_view text);

  const std::string& text() const { return text_; }
  // Free names in order of appearance, each once.
  const std::vector<std::string>& names() const { return names_; }
  bool is_constant() const { return names_.empty(); }

  // Gives every name its place among the variables or its constant value (variables come first), and checks the
  // measures. May be called again, with other values. An unknown name is an error that suggests the nearest known one.
  std::optional<ExpressionError> bind(std::span<const Variable> variables, std::span<const Constant> constants = {});

  // The rest needs a bound expression.
  // This one with an expression in the place of each variable, in their order in bind(); all have plain measures.
  // Its variables are those of the arguments. std::length_error where it would have more than kMaxSteps operations.
  Expression of(std::span<const Expression> arguments) const;
  Measure measure() const { return measure_; }
  // A plain value in which pi survives: probably meant as radians.
  bool holds_pi() const { return holds_pi_; }
  // By its operations: kinks are those of abs, min, max and clamp, jumps those of floor, ceil, round, sign, mod, atan2
  // and if. Jets know neither.
  enum class Smoothness { smooth, kinks, jumps };
  Smoothness smoothness() const;
  // Makes the value an angle by the rule above: a plain one is taken as degrees. Errors: pi without a unit, a truth.
  std::optional<ExpressionError> convert_to_angle();

  // The value with `values` for the variables, in their order in bind(). Truth is 1 or 0, over intervals also [0, 1];
  // an `if` that is open over an interval gives the hull of both branches.
  // T: those of FormulaProgram.
  template <class T>
  T evaluate(std::span<const T> values) const {
    T result;
    code_.evaluate(values, std::span<T>(&result, 1));
    return result;
  }

  double operator()() const { return evaluate<double>({}); }
  template <class T>
  T operator()(const T& t) const {
    return evaluate<T>(std::span<const T>(&t, 1));
  }
  template <class T>
  T operator()(const T& u, const T& v) const {
    const std::array<T, 2> values{u, v};
    return evaluate<T>(values);
  }
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const std::array<T, 3> values{x, y, z};
    return evaluate<T>(values);
  }

 private:
  friend class ExpressionParser;
  friend class ExpressionBinder;
  friend class ExpressionBrancher;
  friend class FormulaProgram;
  friend class LinePolynomial;

  // The program is in postfix order: operands push a value, operators replace theirs by the result.
  struct Instruction {
    std::uint8_t operation = 0;
    std::uint32_t offset = 0;  // in the text, for messages
    std::int32_t index = 0;    // of a name, a variable; an integer exponent
    double value = 0;          // of a literal
  };

  std::string text_;
  std::vector<std::string> names_;
  void compile();
  // sum(i, from, to, body), integral(x, from, to, body) as parsed; their counters are numbered from the outside.
  struct Block {
    bool is_sum = true;
    std::string counter;
    std::vector<Instruction> from, to, body;
  };

  std::vector<Instruction> parsed_, program_;
  std::vector<Block> blocks_;
  FormulaProgram code_;  // what the program computes
  Measure measure_ = Measure::plain;
  bool holds_pi_ = false;
};

// Words that mean something in every expression, so that nothing else may be called so: functions, units, pi, if, else,
// ...
std::span<const std::string_view> function_names();
std::span<const std::string_view> unit_names();
bool is_reserved_word(std::string_view name);

}  // namespace lekalo::geometry
