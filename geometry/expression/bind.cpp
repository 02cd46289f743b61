// Binding: names become variables or constants, measures are checked by running the program on measures instead of
// numbers, and constant small exponents become repeated multiplication.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/expression/expression.h"
#include "geometry/expression/nearest_name.h"
#include "geometry/expression/operations.h"
#include "geometry/numerics/quadrature.h"

namespace lekalo::geometry {
namespace {

constexpr int kLargestIntegerPower = 16;
constexpr int kMaxTerms = 1000, kGaussPoints = 32;

// What is known of a value before it is computed.
struct Known {
  Measure measure = Measure::plain;
  bool is_zero = false;   // the literal 0, which goes for an angle too
  bool holds_pi = false;  // see Expression::holds_pi
};

std::string_view described(Measure measure) {
  return measure == Measure::angle ? "an angle" : measure == Measure::truth ? "a comparison" : "a plain number";
}

constexpr std::string_view kTruthHint = "for a number write: 1 if a < b else 0";
constexpr std::string_view kMixedHint =
    "give the plain number a unit ('deg' or 'rad'), or divide the angle by one: a/(1 deg)";

}  // namespace

class ExpressionBinder {
 public:
  ExpressionBinder(Expression& expression, std::span<const Expression::Variable> variables,
                   std::span<const Expression::Constant> constants)
      : expression_(expression), variables_(variables), constants_(constants) {}

  std::optional<ExpressionError> run() {
    expression_.program_.clear();
    for (const Expression::Instruction& instruction : expression_.parsed_) {
      offset_ = instruction.offset;
      if (!step(instruction)) return error_;
    }
    expression_.measure_ = top().measure;
    expression_.holds_pi_ = top().measure == Measure::plain && top().holds_pi;
    expression_.compile();
    return {};
  }

 private:
  Known& top(int below = 0) { return stack_[stack_.size() - 1 - below]; }
  bool fail(std::string message, std::string_view hint) {
    error_ = {offset_, std::move(message), std::string(hint)};
    return false;
  }
  void emit(Operation operation, int index = 0, double value = 0) {
    expression_.program_.push_back(
        {static_cast<std::uint8_t>(operation), static_cast<std::uint32_t>(offset_), index, value});
  }
  // The operation's operands give way to its result.
  bool replace(int operands, Known result) {
    stack_.resize(stack_.size() - operands);
    stack_.push_back(result);
    return true;
  }
  bool is_literal(const Expression::Instruction& i) const {
    return i.operation == static_cast<int>(Operation::literal);
  }

  bool step(const Expression::Instruction& in) {
    const auto operation = static_cast<Operation>(in.operation);
    switch (operation) {
      case Operation::literal:
        emit(operation, 0, in.value);
        return replace(0, {Measure::plain, in.value == 0, false});
      case Operation::pi:
        emit(operation);
        return replace(0, {Measure::plain, false, true});
      case Operation::name:
        return name(expression_.names_[in.index]);
      case Operation::local:
        append(counters_[static_cast<std::size_t>(in.index)]);
        return replace(0, {});
      case Operation::block: {
        const Expression::Block& block = expression_.blocks_[static_cast<std::size_t>(in.index)];
        return block.is_sum ? sum(block) : integral(block);
      }
      case Operation::degrees:
      case Operation::radians:
      case Operation::turns:
        if (top().measure == Measure::angle) return fail("an angle already has its unit", "remove one of the units");
        if (top().measure == Measure::truth) return fail("a comparison has no unit", kTruthHint);
        emit(operation);
        return replace(1, {Measure::angle, false, false});
      case Operation::negate:
        if (top().measure == Measure::truth) return fail("a comparison has no sign", kTruthHint);
        if (is_literal(expression_.program_.back())) {
          expression_.program_.back().value *= -1;
        } else {
          emit(operation);
        }
        return true;
      case Operation::logical_not:
      case Operation::logical_and:
      case Operation::logical_or:
        return logical(operation);
      case Operation::select:
        return choice();
      case Operation::multiply:
      case Operation::divide:
        return product(operation);
      case Operation::power:
        return power();
      case Operation::add:
      case Operation::subtract: {
        const auto result = common(2, operation == Operation::add ? "add" : "subtract");
        emit(operation);
        return result && replace(2, *result);
      }
      case Operation::equal:
      case Operation::unequal:
      case Operation::less:
      case Operation::less_equal:
      case Operation::greater:
      case Operation::greater_equal:
        emit(operation);
        return common(2, "compare") && replace(2, {Measure::truth});
      default:
        return function(operation);
    }
  }

  using Program = std::vector<Expression::Instruction>;

  void append(const Program& program) {
    expression_.program_.insert(expression_.program_.end(), program.begin(), program.end());
  }
  bool steps(const Program& parsed) {
    const std::size_t offset = offset_;
    for (const Expression::Instruction& in : parsed) {
      offset_ = in.offset;
      if (!step(in)) return false;
      if (expression_.program_.size() > Expression::kMaxSteps)
        return fail("the formula has too many operations", "take fewer terms");
    }
    offset_ = offset;
    return true;
  }
  // What a part of a block computes, apart; a plain number.
  std::optional<Program> part(const Program& parsed) {
    Program outside;
    outside.swap(expression_.program_);
    if (!steps(parsed)) return std::nullopt;
    if (top().measure != Measure::plain) {
      fail("the ends are plain numbers", "divide an angle by its unit: a/(1 deg)");
      return std::nullopt;
    }
    stack_.pop_back();
    outside.swap(expression_.program_);
    return outside;
  }
  std::optional<double> number_of(const Program& program) {
    for (const Expression::Instruction& in : program)
      if (static_cast<Operation>(in.operation) == Operation::variable) return std::nullopt;
    Expression constant;
    constant.program_ = program;
    constant.compile();
    return constant();
  }
  bool body(const Expression::Block& block, Program counter) {
    counters_.push_back(std::move(counter));
    const bool good = steps(block.body);
    counters_.pop_back();
    if (good && top().measure != Measure::plain)
      return fail("the formula inside is no plain number", "divide an angle by its unit: a/(1 deg)");
    return good;
  }
  static Expression::Instruction literal(double value) {
    return {static_cast<std::uint8_t>(Operation::literal), 0, 0, value};
  }

  bool sum(const Expression::Block& block) {
    const auto from = part(block.from), to = from ? part(block.to) : std::nullopt;
    if (!from || !to) return false;
    const auto a = number_of(*from), b = number_of(*to);
    if (!a || !b || !(std::abs(*a) < kMaxTerms && std::abs(*b) < kMaxTerms) || *a != std::floor(*a) ||
        *b != std::floor(*b))
      return fail("a sum runs from one whole number to another",
                  fmt::format("its ends hold parameters and counters, but no variables, and are below {}", kMaxTerms));
    bool is_first = true;
    for (double i = *a; i <= *b; ++i) {
      if (!body(block, {literal(i)})) return false;
      if (!is_first) {
        emit(Operation::add);
        stack_.pop_back();
      }
      is_first = false;
    }
    if (!is_first) return true;
    emit(Operation::literal, 0, 0);
    return replace(0, {});
  }

  // (b - a)/2 sum w_k f(a + (b - a) (1 + x_k)/2) with the nodes and weights of Gauss's rule.
  bool integral(const Expression::Block& block) {
    const auto from = part(block.from), to = from ? part(block.to) : std::nullopt;
    if (!from || !to) return false;
    const auto width = [&] {
      append(*to);
      append(*from);
      emit(Operation::subtract);
    };
    static const GaussRule rule = gauss_legendre(kGaussPoints);
    for (int k = 0; k < kGaussPoints; ++k) {
      Program outside;
      outside.swap(expression_.program_);
      append(*from);
      width();
      emit(Operation::literal, 0, 0.5 * (1 + rule.nodes[static_cast<std::size_t>(k)]));
      emit(Operation::multiply);
      emit(Operation::add);
      outside.swap(expression_.program_);
      if (!body(block, std::move(outside))) return false;
      emit(Operation::literal, 0, 0.5 * rule.weights[static_cast<std::size_t>(k)]);
      emit(Operation::multiply);
      if (k == 0) continue;
      emit(Operation::add);
      stack_.pop_back();
    }
    width();
    emit(Operation::multiply);
    return replace(1, {});
  }

  bool name(const std::string& name) {
    const auto named = [&](const auto& x) { return x.name == name; };
    const auto variable = std::find_if(variables_.begin(), variables_.end(), named);
    if (variable != variables_.end()) {
      emit(Operation::variable, static_cast<int>(variable - variables_.begin()));
      return replace(0, {variable->measure});
    }
    const auto constant = std::find_if(constants_.begin(), constants_.end(), named);
    if (constant != constants_.end()) {
      emit(Operation::literal, 0, constant->value);
      return replace(0, {constant->measure, false, constant->holds_pi});
    }
    std::vector<std::string_view> known;
    for (const auto& x : variables_) known.push_back(x.name);
    for (const auto& x : constants_) known.push_back(x.name);
    std::string hint;
    const auto nearest = nearest_name(name, known);
    if (name == "e") {
      hint = "there is no constant e; write exp(1)";
    } else if (name == "PI" || name == "Pi") {
      hint = "write 'pi'";
    } else if (nearest) {
      hint = fmt::format("did you mean '{}'?", *nearest);
    } else if (!variables_.empty()) {
      std::string list;
      for (const auto& x : variables_) list += (list.empty() ? "'" : ", '") + x.name + "'";
      hint = fmt::format("this formula is one of {}; other names are defined under 'parameters'", list);
    } else {
      hint = "names of numbers are defined under 'parameters'";
    }
    return fail(fmt::format("unknown name '{}'", name), hint);
  }

  // The measure that the operands share, if they do.
  std::optional<Known> common(int operands, std::string_view verb) {
    Known result = top(operands - 1);
    for (int i = operands - 1; i >= 0; --i) {
      const Known& next = top(i);
      if (next.measure == Measure::truth) {
        fail(fmt::format("cannot {} comparisons", verb), kTruthHint);
        return {};
      }
      if (next.measure != result.measure) {
        if (!next.is_zero && !result.is_zero) {
          fail(fmt::format("cannot {} an angle and a plain number", verb), kMixedHint);
          return {};
        }
        result.measure = Measure::angle;
      }
      result.is_zero = result.is_zero && next.is_zero;
      result.holds_pi = result.holds_pi || next.holds_pi;
    }
    result.is_zero = false;
    return result;
  }

  bool logical(Operation operation) {
    const int operands = operand_count(operation);
    const std::string_view word = operation == Operation::logical_not   ? "not"
                                  : operation == Operation::logical_and ? "and"
                                                                        : "or";
    for (int i = 0; i < operands; ++i) {
      if (top(i).measure == Measure::truth) continue;
      return fail(fmt::format("'{}' needs a comparison, not {}", word, described(top(i).measure)),
                  "write for instance: x > 0");
    }
    emit(operation);
    return replace(operands, {Measure::truth});
  }

  bool choice() {
    if (top(1).measure != Measure::truth) {
      return fail(fmt::format("'if' needs a comparison, not {}", described(top(1).measure)),
                  "write for instance: a if x > 0 else b");
    }
    std::swap(top(1), top(2));  // the condition aside
    std::optional<Known> result;
    if (top().measure == Measure::truth && top(1).measure == Measure::truth) {
      result = Known{Measure::truth};
    } else {
      result = common(2, "choose between");
    }
    emit(Operation::select);
    return result && replace(3, *result);
  }

  bool product(Operation operation) {
    const Known &a = top(1), &b = top();
    const bool division = operation == Operation::divide;
    if (a.measure == Measure::truth || b.measure == Measure::truth) {
      return fail(division ? "cannot divide comparisons" : "cannot multiply comparisons", kTruthHint);
    }
    Known result{Measure::plain, false, a.holds_pi || b.holds_pi};
    if (b.measure == Measure::angle && !division) {
      if (a.measure == Measure::angle)
        return fail("cannot multiply two angles", "divide one of them by its unit: a/(1 deg)");
      result.measure = Measure::angle;
    } else if (b.measure == Measure::angle) {
      if (a.measure == Measure::plain) {
        return fail("cannot divide a plain number by an angle",
                    "divide the angle by its unit first: a/(1 rad); '(pi/2) rad' needs its parentheses");
      }
    } else {
      result.measure = a.measure;
    }
    emit(operation);
    return replace(2, result);
  }

  bool power() {
    const Known &base = top(1), &exponent = top();
    if (base.measure == Measure::truth || exponent.measure == Measure::truth) {
      return fail("cannot raise comparisons to a power", kTruthHint);
    }
    if (base.measure == Measure::angle || exponent.measure == Measure::angle) {
      return fail("an angle cannot stand in a power", "divide the angle by its unit: (a/(1 rad))^2");
    }
    const Known result{Measure::plain, false, base.holds_pi || exponent.holds_pi};
    const Expression::Instruction last = expression_.program_.back();
    if (is_literal(last) && last.value == std::floor(last.value) && std::fabs(last.value) <= kLargestIntegerPower) {
      expression_.program_.pop_back();
      emit(Operation::integer_power, static_cast<int>(last.value));
    } else {
      emit(Operation::power);
    }
    return replace(2, result);
  }

  bool function(Operation operation) {
    const Function& function = function_of(operation);
    const int operands = operand_count(operation);
    for (int i = 0; i < operands; ++i) {
      if (top(i).measure == Measure::truth) return fail(fmt::format("{} of a comparison", function.name), kTruthHint);
    }
    Known result;
    switch (function.signature) {
      case Signature::plain:
      case Signature::to_angle:
        if (std::any_of(stack_.end() - operands, stack_.end(),
                        [](const Known& known) { return known.measure == Measure::angle; })) {
          return fail(fmt::format("{} takes a plain number, not an angle", function.name),
                      fmt::format("divide the angle by its unit: {}(a/(1 deg))", function.name));
        }
        result.measure = function.signature == Signature::plain ? Measure::plain : Measure::angle;
        // Rounding a number of radians does not make it degrees.
        result.holds_pi = top().holds_pi && (operation == Operation::floor || operation == Operation::ceil ||
                                             operation == Operation::round);
        break;
      case Signature::same:
      case Signature::same_to_angle: {
        const auto shared =
            operands == 1 ? std::optional(top()) : common(operands, fmt::format("take {} of", function.name));
        if (!shared) return false;
        result = *shared;
        result.is_zero = false;
        if (function.signature == Signature::same_to_angle) result = {Measure::angle};
        break;
      }
      case Signature::of_angle:
      case Signature::any_to_plain:
        break;
    }
    emit(operation);
    return replace(operands, result);
  }

  Expression& expression_;
  std::span<const Expression::Variable> variables_;
  std::span<const Expression::Constant> constants_;
  std::vector<Known> stack_;
  std::vector<Program> counters_;  // what stands for the counters of the blocks around
  std::size_t offset_ = 0;
  ExpressionError error_;
};

std::optional<ExpressionError> Expression::bind(std::span<const Variable> variables,
                                                std::span<const Constant> constants) {
  return ExpressionBinder(*this, variables, constants).run();
}

Expression Expression::of(std::span<const Expression> arguments) const {
  Expression result = *this;
  result.program_.clear();
  for (const Instruction& in : program_) {
    if (static_cast<Operation>(in.operation) == Operation::variable) {
      const std::vector<Instruction>& argument = arguments[static_cast<std::size_t>(in.index)].program_;
      result.program_.insert(result.program_.end(), argument.begin(), argument.end());
    } else {
      result.program_.push_back(in);
    }
    if (result.program_.size() > kMaxSteps) throw std::length_error("the formula has too many operations");
  }
  result.compile();
  return result;
}

void Expression::compile() { code_ = FormulaProgram(std::span<const Expression>(this, 1)); }

Expression::Smoothness Expression::smoothness() const {
  Smoothness result = Smoothness::smooth;
  for (const Instruction& in : program_) {
    switch (static_cast<Operation>(in.operation)) {
      case Operation::floor:
      case Operation::ceil:
      case Operation::round:
      case Operation::sign:
      case Operation::mod:
      case Operation::atan2:
      case Operation::select:
        return Smoothness::jumps;
      case Operation::abs:
      case Operation::min:
      case Operation::max:
      case Operation::clamp:
        result = Smoothness::kinks;
        break;
      default:
        break;
    }
  }
  return result;
}

std::optional<ExpressionError> Expression::convert_to_angle() {
  if (measure_ == Measure::angle) return {};
  if (measure_ == Measure::truth)
    return ExpressionError{0, "expected an angle, found a comparison", "write for instance: 30 deg"};
  if (holds_pi_) {
    return ExpressionError{0, "pi without a unit: a plain number means degrees here",
                           fmt::format("write '({}) rad', or give the angle in degrees", text_)};
  }
  program_.push_back({static_cast<std::uint8_t>(Operation::degrees)});
  compile();
  measure_ = Measure::angle;
  return {};
}

}  // namespace lekalo::geometry
