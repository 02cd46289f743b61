// One evaluation for all number types: steps over numbered places of T.
#include "geometry/expression/formula_program.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>

#include "geometry/expression/expression.h"
#include "geometry/expression/operations.h"
#include "geometry/numerics/sine_cosine.h"

namespace lekalo::geometry {
namespace {

template <class T>
struct ScalarOf {
  using Type = T;
};
template <class T>
requires requires { typename T::Scalar; }
struct ScalarOf<T> {
  using Type = typename T::Scalar;
};
template <class T>
using Scalar = typename ScalarOf<T>::Type;
template <class T>
constexpr bool kIsJet = !std::is_same_v<T, Scalar<T>>;

template <class T>
const Scalar<T>& value(const T& x) {
  if constexpr (kIsJet<T>) {
    return x.c[0];
  } else {
    return x;
  }
}

Truth opposite(Truth a) { return a == Truth::yes ? Truth::no : a == Truth::no ? Truth::yes : Truth::unknown; }
Truth both(Truth a, Truth b) {
  if (a == Truth::no || b == Truth::no) return Truth::no;
  return a == Truth::yes && b == Truth::yes ? Truth::yes : Truth::unknown;
}

Truth equal(double a, double b) { return a == b ? Truth::yes : Truth::no; }
Truth equal(const Interval& a, const Interval& b) {
  if (a.lo == a.hi && a == b) return Truth::yes;
  return intersects(a, b) ? Truth::unknown : Truth::no;
}
Truth at_most(double a, double b) { return a <= b ? Truth::yes : Truth::no; }
Truth at_most(const Interval& a, const Interval& b) { return opposite(less(b, a)); }

template <class T>
T number(Truth truth) {
  if constexpr (std::is_same_v<Scalar<T>, Interval>) {
    if (truth == Truth::unknown) return T(Interval(0, 1));
  }
  return T(truth == Truth::yes ? 1.0 : 0.0);
}
template <class T>
Truth truth(const T& x) {
  const Truth zero = equal(value(x), Scalar<T>(0));
  return opposite(zero);
}

template <class T>
T chosen(Truth condition, const T& a, const T& b) {
  if (condition == Truth::yes) return a;
  if (condition == Truth::no) return b;
  if constexpr (std::is_same_v<T, Interval>) {
    return hull(a, b);
  } else if constexpr (std::is_same_v<Scalar<T>, Interval>) {
    T r = a;
    for (int k = 0; k < T::kCount; ++k) r.c[k] = hull(a.c[k], b.c[k]);
    return r;
  } else {
    return b;
  }
}

// A value and first derivatives, whatever the variables: what rays ask for most gets the short rules.
template <class T>
constexpr bool kIsFirstOrder = false;
template <>
constexpr bool kIsFirstOrder<Jet<double, 1>> = true;
template <>
constexpr bool kIsFirstOrder<Jet2<double, 1>> = true;
template <>
constexpr bool kIsFirstOrder<Gradient<double>> = true;

template <class T>
T product(const T& a, const T& b) {
  if constexpr (kIsFirstOrder<T>) {
    T r;
    r.c[0] = a.c[0] * b.c[0];
    for (int k = 1; k < T::kCount; ++k) r.c[k] = a.c[0] * b.c[k] + a.c[k] * b.c[0];
    return r;
  } else {
    return a * b;
  }
}

template <class T>
T quotient(const T& a, const T& b) {
  if constexpr (kIsFirstOrder<T>) {
    T r;
    r.c[0] = a.c[0] / b.c[0];
    for (int k = 1; k < T::kCount; ++k) r.c[k] = (a.c[k] - r.c[0] * b.c[k]) / b.c[0];
    return r;
  } else {
    return a / b;
  }
}

// What rays ask for along a line.
template <class T>
constexpr bool kIsThirdOrder = std::is_same_v<T, Jet<double, 3>>;

// The function with the value f and the derivatives f1, f2, f3 at a.value(), of a (Faa di Bruno's formula).
Jet<double, 3> composed(double f, double f1, double f2, double f3, const Jet<double, 3>& a) {
  const double square = a.c[1] * a.c[1];
  Jet<double, 3> r(f);
  r.c[1] = f1 * a.c[1];
  r.c[2] = f1 * a.c[2] + 0.5 * f2 * square;
  r.c[3] = f1 * a.c[3] + a.c[1] * (f2 * a.c[2] + 1.0 / 6 * f3 * square);
  return r;
}

template <class T>
void sine_and_cosine(const T& a, T& sine, T& cosine) {
  if constexpr (kIsFirstOrder<T>) {
    double s, c;
    geometry::sine_and_cosine(a.c[0], s, c);
    sine.c[0] = s;
    cosine.c[0] = c;
    for (int k = 1; k < T::kCount; ++k) {
      sine.c[k] = c * a.c[k];
      cosine.c[k] = -s * a.c[k];
    }
  } else if constexpr (kIsThirdOrder<T>) {
    double s, c;
    geometry::sine_and_cosine(a.c[0], s, c);
    sine = composed(s, c, -s, -c, a);
    cosine = composed(c, -s, -c, s, a);
  } else if constexpr (std::is_same_v<T, double>) {
    geometry::sine_and_cosine(a, sine, cosine);
  } else if constexpr (kIsJet<T>) {
    sin_cos(a, sine, cosine);
  } else {
    sine = sin(a);
    cosine = cos(a);
  }
}

template <class T>
T integer_power(const T& x, int exponent) {
  // Over intervals powers are tighter than products.
  if constexpr (std::is_same_v<Scalar<T>, double>) {
    if (exponent == 3) return product(x, sqr(x));
    if (exponent == 4) return sqr(sqr(x));
  }
  if constexpr (std::is_same_v<T, double>) {
    double result = 1, square = x;
    for (int rest = std::abs(exponent); rest > 0; rest >>= 1) {
      if (rest & 1) result *= square;
      square *= square;
    }
    return exponent < 0 ? 1 / result : result;
  } else {
    return pow(x, exponent);
  }
}

// a - b floor(a / b): in [0, b), with the sign of b.
double remainder(double a, double b) {
  const double r = std::fmod(a, b);
  return r != 0 && (r < 0) != (b < 0) ? r + b : r;
}
Interval remainder(const Interval& a, const Interval& b) {
  const Interval r = a - b * floor(a / b), range = hull(0.0, b);
  const Interval common = intersect(r, range);
  return common.empty() ? range : common;
}
template <class J>
requires kIsJet<J> J remainder(const J& a, const J& b) {
  using std::floor;
  J r = a - b * floor(value(a) / value(b));
  r.c[0] = remainder(value(a), value(b));
  return r;
}

// What operations give that need no constant.
template <class T>
T result_of(Operation operation, const T& a, const T& b, const T& c, int exponent) {
  using std::abs, std::acos, std::acosh, std::asin, std::asinh, std::atan, std::atan2, std::atanh, std::cbrt, std::ceil;
  using std::cos, std::cosh, std::exp, std::floor, std::hypot, std::log, std::log10, std::max, std::min, std::pow;
  using std::round, std::sin, std::sinh, std::sqrt, std::tan, std::tanh;
  switch (operation) {
    case Operation::negate:
      return -a;
    case Operation::add:
      return a + b;
    case Operation::subtract:
      return a - b;
    case Operation::multiply:
      return a * b;
    case Operation::divide:
      return quotient(a, b);
    case Operation::square:
      return sqr(a);
    case Operation::power:
      return pow(a, b);
    case Operation::integer_power:
      return integer_power(a, exponent);
    case Operation::equal:
      return number<T>(equal(value(a), value(b)));
    case Operation::unequal:
      return number<T>(opposite(equal(value(a), value(b))));
    case Operation::less:
      return number<T>(less(value(a), value(b)));
    case Operation::less_equal:
      return number<T>(at_most(value(a), value(b)));
    case Operation::greater:
      return number<T>(less(value(b), value(a)));
    case Operation::greater_equal:
      return number<T>(at_most(value(b), value(a)));
    case Operation::logical_and:
      return number<T>(both(truth(a), truth(b)));
    case Operation::logical_or:
      return number<T>(opposite(both(opposite(truth(a)), opposite(truth(b)))));
    case Operation::logical_not:
      return number<T>(opposite(truth(a)));
    case Operation::select:
      return chosen(truth(b), a, c);
    case Operation::sin:
    case Operation::cos:
      if constexpr (kIsFirstOrder<T> || kIsThirdOrder<T> || std::is_same_v<T, double>) {
        T sine, cosine;
        sine_and_cosine(a, sine, cosine);
        return operation == Operation::sin ? sine : cosine;
      } else {
        return operation == Operation::sin ? sin(a) : cos(a);
      }
    case Operation::tan:
      return tan(a);
    case Operation::asin:
      return asin(a);
    case Operation::acos:
      return acos(a);
    case Operation::atan:
      return atan(a);
    case Operation::sinh:
      return sinh(a);
    case Operation::cosh:
      return cosh(a);
    case Operation::tanh:
      return tanh(a);
    case Operation::asinh:
      return asinh(a);
    case Operation::acosh:
      return acosh(a);
    case Operation::atanh:
      return atanh(a);
    case Operation::exp:
      if constexpr (kIsThirdOrder<T>) {
        const double e = exp(a.c[0]);
        return composed(e, e, e, e, a);
      } else {
        return exp(a);
      }
    case Operation::log:
      return log(a);
    case Operation::log10:
      return log10(a);
    case Operation::sqrt:
      return sqrt(a);
    case Operation::cbrt:
      return cbrt(a);
    case Operation::abs:
      return abs(a);
    case Operation::sign:
      return sign(a);
    case Operation::floor:
      return floor(a);
    case Operation::ceil:
      return ceil(a);
    case Operation::round:
      return round(a);
    case Operation::atan2:
      return atan2(a, b);
    case Operation::min:
      return min(a, b);
    case Operation::max:
      return max(a, b);
    case Operation::hypot:
      return hypot(a, b);
    case Operation::mod:
      return remainder(a, b);
    case Operation::clamp:
      return min(max(a, b), c);
    default:  // operands, units, and what has a constant or two results
      return a;
  }
}

// Values without initialization: most programs need few, and a jet is long.
template <class T>
class Places {
 public:
  explicit Places(std::size_t size) : data_(reinterpret_cast<T*>(near_)) {
    static_assert(std::is_trivially_destructible_v<T>);
    if (size <= kNear) return;
    thread_local std::vector<T> far;  // its room is kept
    if (far.size() < size) far.resize(size);
    data_ = far.data();
  }
  T& operator[](std::int32_t i) { return data_[i]; }

 private:
  static constexpr std::size_t kNear = 32;
  alignas(T) std::byte near_[kNear * sizeof(T)];
  T* data_;
};

bool is_exact(double x, const Interval& range) { return range.lo == x && range.hi == x; }

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
  void emit(int i) {
    if (place_[i] >= 0) return;  // with its partner
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

template <class T>
void FormulaProgram::evaluate(std::span<const T> values, std::span<T> results) const {
  Places<T> at(static_cast<std::size_t>(places_));
  const auto constant = [&](const Step& step) -> const Scalar<T>& {
    if constexpr (std::is_same_v<Scalar<T>, Interval>) {
      return constants_[step.index].range;
    } else {
      return constants_[step.index].value;
    }
  };
  for (const Step& step : steps_) {
    const T &a = at[step.a], &b = at[step.b];
    switch (step.operation) {
      case Operation::literal:
        at[step.to] = T(constant(step));
        break;
      case Operation::variable:
        at[step.to] = values[step.index];
        break;
      case Operation::add:
        at[step.to] = a + b;
        break;
      case Operation::subtract:
        at[step.to] = a - b;
        break;
      case Operation::multiply:
        at[step.to] = product(a, b);
        break;
      case Operation::square:
        at[step.to] = sqr(a);
        break;
      case Operation::scale:
        at[step.to] = a * constant(step);
        break;
      case Operation::shift:
        at[step.to] = a + constant(step);
        break;
      case Operation::divide_by:
        at[step.to] = a / constant(step);
        break;
      case Operation::subtract_of:
        at[step.to] = constant(step) - a;
        break;
      case Operation::divide_of:
        at[step.to] = constant(step) / a;
        break;
      case Operation::sin_cos: {
        T sine, cosine;
        sine_and_cosine(a, sine, cosine);
        at[step.to] = sine;
        at[step.second] = cosine;
        break;
      }
      default:
        at[step.to] = result_of(step.operation, a, b, at[step.c], step.index);
        break;
    }
  }
  for (std::size_t k = 0; k < results.size(); ++k) results[k] = at[results_[k]];
}

template void FormulaProgram::evaluate(std::span<const double>, std::span<double>) const;
template void FormulaProgram::evaluate(std::span<const Interval>, std::span<Interval>) const;
template void FormulaProgram::evaluate(std::span<const Jet<double, 1>>, std::span<Jet<double, 1>>) const;
template void FormulaProgram::evaluate(std::span<const Jet<double, 2>>, std::span<Jet<double, 2>>) const;
template void FormulaProgram::evaluate(std::span<const Jet<double, 3>>, std::span<Jet<double, 3>>) const;
template void FormulaProgram::evaluate(std::span<const Jet<double, 4>>, std::span<Jet<double, 4>>) const;
template void FormulaProgram::evaluate(std::span<const Jet<double, 5>>, std::span<Jet<double, 5>>) const;
template void FormulaProgram::evaluate(std::span<const Jet<double, 6>>, std::span<Jet<double, 6>>) const;
template void FormulaProgram::evaluate(std::span<const Jet2<double, 1>>, std::span<Jet2<double, 1>>) const;
template void FormulaProgram::evaluate(std::span<const Jet2<double, 2>>, std::span<Jet2<double, 2>>) const;
template void FormulaProgram::evaluate(std::span<const Jet2<double, 3>>, std::span<Jet2<double, 3>>) const;
template void FormulaProgram::evaluate(std::span<const Jet2<double, 4>>, std::span<Jet2<double, 4>>) const;
template void FormulaProgram::evaluate(std::span<const Jet<Interval, 1>>, std::span<Jet<Interval, 1>>) const;
template void FormulaProgram::evaluate(std::span<const Jet<Interval, 2>>, std::span<Jet<Interval, 2>>) const;
template void FormulaProgram::evaluate(std::span<const Jet2<Interval, 1>>, std::span<Jet2<Interval, 1>>) const;
template void FormulaProgram::evaluate(std::span<const Jet2<Interval, 2>>, std::span<Jet2<Interval, 2>>) const;
template void FormulaProgram::evaluate(std::span<const Jet2<Interval, 4>>, std::span<Jet2<Interval, 4>>) const;
template void FormulaProgram::evaluate(std::span<const Jet3<double, 3>>, std::span<Jet3<double, 3>>) const;
template void FormulaProgram::evaluate(std::span<const Gradient<double>>, std::span<Gradient<double>>) const;
template void FormulaProgram::evaluate(std::span<const Gradient<Interval>>, std::span<Gradient<Interval>>) const;

}  // namespace lekalo::geometry
