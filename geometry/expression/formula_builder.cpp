// Compiles formulas to a flat program.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/expression/apply_operation.h"
#include "geometry/expression/expression.h"
#include "geometry/expression/formula_program.h"

namespace lekalo::geometry {

using namespace operations;

namespace {

bool is_exact(double x, const Interval& range) { return range.lo == x && range.hi == x; }

// Whole numbers and truths, which jump.
bool is_stepped(Operation operation) {
  switch (operation) {
    case Operation::equal:
    case Operation::unequal:
    case Operation::less:
    case Operation::less_equal:
    case Operation::greater:
    case Operation::greater_equal:
    case Operation::sign:
    case Operation::floor:
    case Operation::ceil:
    case Operation::round:
      return true;
    default:
      return false;
  }
}

// Division by such a number is multiplication by its inverse, without rounding.
bool has_exact_inverse(double x) {
  int exponent;
  return std::abs(std::frexp(x, &exponent)) == 0.5 && std::abs(exponent) < 1000;
}

}  // namespace

// Numbers the values of all formulas, and puts them in order.
class FormulaProgram::Builder {
 public:
  explicit Builder(FormulaProgram& program) : program_(program) {}

  void add(const Expression& formula) {
    std::vector<int> stack;
    for (const Expression::Instruction& in : formula.program_) {
      const auto operation = static_cast<Operation>(in.operation);
      int operands[3] = {-1, -1, -1};
      const int count = operand_count(operation);
      for (int k = count - 1; k >= 0; --k) operands[k] = stack.back(), stack.pop_back();
      stack.push_back(value_of(operation, operands[0], operands[1], operands[2], in.index, in.value));
    }
    results_.push_back(stack.empty() ? constant({}) : stack.back());
  }

  void finish() {
    needed_.assign(values_.size(), 0);
    last_use_.assign(values_.size(), -1);
    place_.assign(values_.size(), -1);
    for (const int result : results_) {
      need(result);
      last_use_[result] = static_cast<int>(values_.size());
    }
    for (int i = static_cast<int>(values_.size()) - 1; i >= 0; --i)
      if (needed_[i])
        for (const int operand : operands(values_[i])) need(operand);
    for (int i = 0; i < static_cast<int>(values_.size()); ++i)
      if (needed_[i])
        for (const int operand : operands(values_[i]))
          if (operand >= 0) last_use_[operand] = std::max(last_use_[operand], emitted_at(i));
    for (int i = 0; i < static_cast<int>(values_.size()); ++i) {
      // A constant gets its place where it is first used.
      if (needed_[i] && !values_[i].constant) emit(i);
    }
    for (const int result : results_) program_.results_.push_back(place_of(result));
  }

 private:
  // A value: an operation on other values.
  struct Value {
    Operation operation;
    int a = -1, b = -1, c = -1;
    int index = 0;  // of a variable, a constant; a whole exponent
    std::optional<Constant> constant;
  };
  static std::array<int, 3> operands(const Value& value) { return {value.a, value.b, value.c}; }

  int same_or_new(const Value& value) {
    const auto key = std::tuple(value.operation, value.a, value.b, value.c, value.index);
    const auto [found, is_new] = numbers_.try_emplace(key, static_cast<int>(values_.size()));
    if (is_new) values_.push_back(value);
    return found->second;
  }
  int table_index(const Constant& constant) {
    for (size_t i = 0; i < program_.constants_.size(); ++i) {
      const Constant& other = program_.constants_[i];
      if (std::bit_cast<std::uint64_t>(other.value) == std::bit_cast<std::uint64_t>(constant.value) &&
          other.range == constant.range)
        return static_cast<int>(i);
    }
    program_.constants_.push_back(constant);
    return static_cast<int>(program_.constants_.size()) - 1;
  }
  int constant(const Constant& constant) {
    return same_or_new({Operation::literal, -1, -1, -1, table_index(constant), constant});
  }
  int constant(double x) { return constant(Constant{x, x}); }
  // With the constant in the step.
  int with(Operation operation, int a, const Constant& c) {
    return same_or_new({operation, a, -1, -1, table_index(c), {}});
  }

  int value_of(Operation operation, int a, int b = -1, int c = -1, int index = 0, double literal = 0) {
    switch (operation) {
      case Operation::literal:
        return constant(literal);
      case Operation::pi:  // over intervals the two doubles around it: certain for the number pi and for its double
        return constant(Constant{std::numbers::pi, {std::numbers::pi, next_up(std::numbers::pi)}});
      case Operation::variable:
        return same_or_new({operation, -1, -1, -1, index, {}});
      case Operation::name:  // bound expressions have none
        return constant({});
      case Operation::radians:
        return a;
      case Operation::degrees:
        return value_of(Operation::multiply, value_of(Operation::divide, a, constant(180.0)),
                        value_of(Operation::pi, -1));
      case Operation::turns:
        return value_of(Operation::multiply, value_of(Operation::multiply, a, constant(2.0)),
                        value_of(Operation::pi, -1));
      default:
        break;
    }
    const auto known = [&](int i) { return i < 0 ? std::optional<Constant>() : values_[i].constant; };
    const std::optional<Constant> x = known(a), y = known(b), z = known(c);
    if (x && (b < 0 || y) && (c < 0 || z)) {
      const Constant& p = *x;
      const Constant q = y.value_or(p), r = z.value_or(p);
      // What a jump of constants gives is not left open by their rounding: floor(3/3) is 1 over intervals too.
      if (is_stepped(operation)) return constant(result_of(operation, p.value, q.value, r.value, index));
      return constant(Constant{result_of(operation, p.value, q.value, r.value, index),
                               result_of(operation, p.range, q.range, r.range, index)});
    }
    const auto exact = [](const std::optional<Constant>& k, double is) {
      return k && k->value == is && is_exact(is, k->range);
    };
    switch (operation) {
      case Operation::add:
        if (x) return value_of(Operation::add, b, a);
        if (exact(y, 0)) return a;
        if (y) return with(Operation::shift, a, *y);
        if (a > b) std::swap(a, b);
        break;
      case Operation::subtract:
        if (exact(y, 0)) return a;
        if (y) return with(Operation::shift, a, {-y->value, -y->range});
        if (x) return with(Operation::subtract_of, b, *x);
        break;
      case Operation::multiply:
        if (x) return value_of(Operation::multiply, b, a);
        if (exact(y, 1)) return a;
        if (y) return with(Operation::scale, a, *y);
        if (a == b) return value_of(Operation::square, a);
        if (a > b) std::swap(a, b);
        break;
      case Operation::divide:
        if (exact(y, y ? y->value : 0) && has_exact_inverse(y->value))
          return value_of(Operation::multiply, a, constant(1 / y->value));
        if (y) return with(Operation::divide_by, a, *y);
        if (x) return with(Operation::divide_of, b, *x);
        break;
      case Operation::integer_power:
        if (index == 0) return constant(1.0);
        if (index == 1) return a;
        if (index == 2) return value_of(Operation::square, a);
        return same_or_new({operation, a, -1, -1, index, {}});
      default:
        break;
    }
    return same_or_new({operation, a, b, c, 0, {}});
  }

  void need(int i) {
    if (i >= 0) needed_[i] = 1;
  }
  int new_place() {
    if (free_.empty()) return program_.places_++;
    const int place = free_.back();
    free_.pop_back();
    return place;
  }
  int place_of(int i) {
    if (i < 0) return 0;
    if (place_[i] < 0) {
      Step step;
      step.operation = Operation::literal;
      step.to = place_[i] = new_place();
      step.index = values_[i].index;
      program_.steps_.push_back(step);
    }
    return place_[i];
  }
  // The cosine of a sine's argument, or the other way round, where that is needed too.
  int partner_of(int i) const {
    const Value& value = values_[i];
    if (value.operation != Operation::sin && value.operation != Operation::cos) return -1;
    const Operation other = value.operation == Operation::sin ? Operation::cos : Operation::sin;
    const auto found = numbers_.find(std::tuple(other, value.a, value.b, value.c, value.index));
    return found != numbers_.end() && needed_[found->second] ? found->second : -1;
  }
  // A pair is computed where the first of the two stands.
  int emitted_at(int i) const {
    const int partner = partner_of(i);
    return partner >= 0 ? std::min(i, partner) : i;
  }
  // A product that was computed last, and is needed for this sum alone, becomes one step with it.
  bool add_to_product(int i) {
    const Value& value = values_[i];
    if (value.operation != Operation::add || program_.steps_.empty()) return false;
    Step& last = program_.steps_.back();
    for (const auto& [product, other] : {std::pair(value.a, value.b), std::pair(value.b, value.a)}) {
      if (last.operation != Operation::multiply || values_[product].operation != Operation::multiply) continue;
      if (place_[product] != last.to || last_use_[product] != i || product == other || place_[other] < 0) continue;
      last.operation = Operation::multiply_add;
      last.c = place_[other];
      if (last_use_[other] == i) free_.push_back(place_[other]);
      place_[i] = last.to;
      return true;
    }
    return false;
  }
  void emit(int i) {
    if (place_[i] >= 0) return;  // with its partner
    if (add_to_product(i)) return;
    const Value& value = values_[i];
    const int partner = partner_of(i);
    Step step;
    step.operation = partner >= 0 ? Operation::sin_cos : value.operation;
    step.a = place_of(value.a);
    step.b = place_of(value.b);
    step.c = place_of(value.c);
    step.index = value.index;
    // A result may take the place of an operand: steps read before they write.
    for (int k = 0; k < 3; ++k) {
      const int operand = operands(value)[k];
      const bool again = (k > 0 && operand == value.a) || (k > 1 && operand == value.b);
      if (operand >= 0 && !again && last_use_[operand] == i) free_.push_back(place_[operand]);
    }
    step.to = place_[i] = new_place();
    if (partner >= 0) {
      step.second = place_[partner] = new_place();
      if (value.operation == Operation::cos) std::swap(step.to, step.second);
    }
    program_.steps_.push_back(step);
  }

  FormulaProgram& program_;
  std::vector<Value> values_;
  std::map<std::tuple<Operation, int, int, int, int>, int> numbers_;
  std::vector<int> results_;
  std::vector<char> needed_;
  std::vector<int> last_use_, place_, free_;
};

FormulaProgram::FormulaProgram(std::span<const Expression> formulas) {
  Builder builder(*this);
  for (const Expression& formula : formulas) builder.add(formula);
  builder.finish();
}

}  // namespace lekalo::geometry
