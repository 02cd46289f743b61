#include "geometry/expression/operations.h"

#include <algorithm>
#include <array>

#include "geometry/expression/expression.h"
#include "geometry/expression/function_list.h"

namespace lekalo::geometry {
namespace {

constexpr int kMany = 100;

constexpr auto kFunctions = std::to_array<Function>({
    {"sin", Operation::sin, 1, 1, Signature::of_angle, "sin(x): sine of an angle, or of a number of radians"},
    {"cos", Operation::cos, 1, 1, Signature::of_angle, "cos(x): cosine"},
    {"tan", Operation::tan, 1, 1, Signature::of_angle, "tan(x): tangent"},
    {"asin", Operation::asin, 1, 1, Signature::to_angle, "asin(x): angle whose sine is x, -90 to 90 deg"},
    {"acos", Operation::acos, 1, 1, Signature::to_angle, "acos(x): angle whose cosine is x, 0 to 180 deg"},
    {"atan", Operation::atan, 1, 1, Signature::to_angle, "atan(x): angle whose tangent is x, -90 to 90 deg"},
    {"atan2", Operation::atan2, 2, 2, Signature::same_to_angle,
     "atan2(y, x): angle of the direction (x, y), -180 to 180 deg"},
    {"sinh", Operation::sinh, 1, 1, Signature::plain, "sinh(x): hyperbolic sine"},
    {"cosh", Operation::cosh, 1, 1, Signature::plain, "cosh(x): hyperbolic cosine"},
    {"tanh", Operation::tanh, 1, 1, Signature::plain, "tanh(x): hyperbolic tangent"},
    {"asinh", Operation::asinh, 1, 1, Signature::plain, "asinh(x): inverse of sinh"},
    {"acosh", Operation::acosh, 1, 1, Signature::plain, "acosh(x): inverse of cosh, x at least 1"},
    {"atanh", Operation::atanh, 1, 1, Signature::plain, "atanh(x): inverse of tanh, x between -1 and 1"},
    {"exp", Operation::exp, 1, 1, Signature::plain, "exp(x): e to the power x"},
    {"log", Operation::log, 1, 1, Signature::plain, "log(x): natural logarithm"},
    {"log10", Operation::log10, 1, 1, Signature::plain, "log10(x): decimal logarithm"},
    {"sqrt", Operation::sqrt, 1, 1, Signature::plain, "sqrt(x): square root"},
    {"cbrt", Operation::cbrt, 1, 1, Signature::plain, "cbrt(x): cube root, of negative numbers too"},
    {"abs", Operation::abs, 1, 1, Signature::same, "abs(x): magnitude"},
    {"sign", Operation::sign, 1, 1, Signature::any_to_plain, "sign(x): -1, 0 or 1"},
    {"floor", Operation::floor, 1, 1, Signature::plain, "floor(x): largest whole number not above x"},
    {"ceil", Operation::ceil, 1, 1, Signature::plain, "ceil(x): smallest whole number not below x"},
    {"round", Operation::round, 1, 1, Signature::plain, "round(x): nearest whole number, halves away from zero"},
    {"erf", Operation::erf, 1, 1, Signature::plain,
     "erf(x): error function, 2/sqrt(pi) times the integral of exp(-v^2) from 0 to x"},
    {"fresnel_s", Operation::fresnel_s, 1, 1, Signature::plain, "fresnel_s(x): integral of sin(pi v^2/2) from 0 to x"},
    {"fresnel_c", Operation::fresnel_c, 1, 1, Signature::plain, "fresnel_c(x): integral of cos(pi v^2/2) from 0 to x"},
    {"sinc", Operation::sinc, 1, 1, Signature::plain, "sinc(x): sin(x)/x, 1 at 0"},
    {"factorial", Operation::factorial, 1, 1, Signature::plain, "factorial(n): of a whole number from 0 to 170"},
    {"min", Operation::min, 2, kMany, Signature::same, "min(a, b, ...): the smallest"},
    {"max", Operation::max, 2, kMany, Signature::same, "max(a, b, ...): the largest"},
    {"hypot", Operation::hypot, 2, kMany, Signature::same, "hypot(x, y, ...): root of the sum of squares"},
    {"mod", Operation::mod, 2, 2, Signature::same, "mod(a, b): remainder a - b floor(a/b), with the sign of b"},
    {"clamp", Operation::clamp, 3, 3, Signature::same, "clamp(x, a, b): x moved into a to b"},
    {"lerp", Operation::lerp, 3, 3, Signature::plain, "lerp(a, b, w): a + (b - a) w, from a at w = 0 to b at w = 1"},
    {"binom", Operation::binom, 2, 2, Signature::plain, "binom(n, k): n over k, of a whole number k from 0 to 1000"},
});

// What is a formula of its counter: sum(i, a, b, formula of i).
struct BlockFunction {
  std::string_view name, description;
};
constexpr std::array kBlockFunctions{
    BlockFunction{"sum", "sum(i, a, b, formula): of the formula for i = a, a + 1, ..., b; a and b without variables"},
    BlockFunction{"integral",
                  "integral(x, a, b, formula): over x from a to b, by Gauss's rule of 32 points: for formulas that are "
                  "smooth there, with few waves"},
};

constexpr auto kFunctionNames = [] {
  std::array<std::string_view, kFunctions.size() + kBlockFunctions.size()> names;
  const auto next =
      std::transform(kFunctions.begin(), kFunctions.end(), names.begin(), [](const Function& f) { return f.name; });
  std::transform(kBlockFunctions.begin(), kBlockFunctions.end(), next, [](const BlockFunction& f) { return f.name; });
  return names;
}();
constexpr std::array<std::string_view, 3> kUnitNames{"deg", "rad", "turn"};
constexpr std::array<std::string_view, 6> kWords{"pi", "if", "else", "and", "or", "not"};

bool holds(std::span<const std::string_view> words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

std::span<const Function> functions() { return kFunctions; }
std::vector<std::string_view> function_descriptions() {
  std::vector<std::string_view> result;
  for (const Function& function : kFunctions) result.push_back(function.description);
  for (const BlockFunction& function : kBlockFunctions) result.push_back(function.description);
  return result;
}

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
  if (operation == Operation::select || operation == Operation::clamp || operation == Operation::lerp) return 3;
  if (operation <= Operation::turns || operation == Operation::negate || operation == Operation::integer_power ||
      operation == Operation::logical_not) {
    return 1;
  }
  return operation >= Operation::sin && operation <= Operation::factorial ? 1 : 2;
}

std::span<const std::string_view> function_names() { return kFunctionNames; }
std::span<const std::string_view> unit_names() { return kUnitNames; }
bool is_reserved_word(std::string_view name) {
  return holds(kFunctionNames, name) || holds(kUnitNames, name) || holds(kWords, name);
}

}  // namespace lekalo::geometry
