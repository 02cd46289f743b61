#include "geometry/expression/operations.h"

#include <algorithm>
#include <array>

#include "geometry/expression/expression.h"

namespace lekalo::geometry {
namespace {

constexpr int kMany = 100;

constexpr auto kFunctions = std::to_array<Function>({
    {"sin", Operation::sin, 1, 1, Signature::of_angle},
    {"cos", Operation::cos, 1, 1, Signature::of_angle},
    {"tan", Operation::tan, 1, 1, Signature::of_angle},
    {"asin", Operation::asin, 1, 1, Signature::to_angle},
    {"acos", Operation::acos, 1, 1, Signature::to_angle},
    {"atan", Operation::atan, 1, 1, Signature::to_angle},
    {"atan2", Operation::atan2, 2, 2, Signature::same_to_angle},
    {"sinh", Operation::sinh, 1, 1, Signature::plain},
    {"cosh", Operation::cosh, 1, 1, Signature::plain},
    {"tanh", Operation::tanh, 1, 1, Signature::plain},
    {"asinh", Operation::asinh, 1, 1, Signature::plain},
    {"acosh", Operation::acosh, 1, 1, Signature::plain},
    {"atanh", Operation::atanh, 1, 1, Signature::plain},
    {"exp", Operation::exp, 1, 1, Signature::plain},
    {"log", Operation::log, 1, 1, Signature::plain},
    {"log10", Operation::log10, 1, 1, Signature::plain},
    {"sqrt", Operation::sqrt, 1, 1, Signature::plain},
    {"cbrt", Operation::cbrt, 1, 1, Signature::plain},
    {"abs", Operation::abs, 1, 1, Signature::same},
    {"sign", Operation::sign, 1, 1, Signature::any_to_plain},
    {"floor", Operation::floor, 1, 1, Signature::plain},
    {"ceil", Operation::ceil, 1, 1, Signature::plain},
    {"round", Operation::round, 1, 1, Signature::plain},
    {"min", Operation::min, 2, kMany, Signature::same},
    {"max", Operation::max, 2, kMany, Signature::same},
    {"hypot", Operation::hypot, 2, kMany, Signature::same},
    {"mod", Operation::mod, 2, 2, Signature::same},
    {"clamp", Operation::clamp, 3, 3, Signature::same},
});

constexpr auto kFunctionNames = [] {
  std::array<std::string_view, kFunctions.size()> names;
  std::transform(kFunctions.begin(), kFunctions.end(), names.begin(), [](const Function& f) { return f.name; });
  return names;
}();
constexpr std::array<std::string_view, 3> kUnitNames{"deg", "rad", "turn"};
constexpr std::array<std::string_view, 6> kWords{"pi", "if", "else", "and", "or", "not"};

bool holds(std::span<const std::string_view> words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

std::span<const Function> functions() { return kFunctions; }

const Function* find_function(std::string_view name) {
  const auto found =
      std::find_if(kFunctions.begin(), kFunctions.end(), [&](const Function& f) { return f.name == name; });
  return found == kFunctions.end() ? nullptr : &*found;
}

const Function& function_of(Operation operation) {
  return *std::find_if(kFunctions.begin(), kFunctions.end(),
                       [&](const Function& f) { return f.operation == operation; });
}

int operand_count(Operation operation) {
  if (operation <= Operation::pi) return 0;
  if (operation == Operation::select || operation == Operation::clamp) return 3;
  if (operation <= Operation::turns || operation == Operation::negate || operation == Operation::integer_power ||
      operation == Operation::logical_not) {
    return 1;
  }
  return operation >= Operation::sin && operation <= Operation::round ? 1 : 2;
}

std::span<const std::string_view> function_names() { return kFunctionNames; }
std::span<const std::string_view> unit_names() { return kUnitNames; }
bool is_reserved_word(std::string_view name) {
  return holds(kFunctionNames, name) || holds(kUnitNames, name) || holds(kWords, name);
}

}  // namespace lekalo::geometry
