// One evaluation for all number types: the program runs over a stack of T.
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>

#include "geometry/expression/expression.h"
#include "geometry/expression/operations.h"

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

// Over intervals pi is the two doubles around it: certain for the number pi and for its double.
template <class T>
T pi() {
  if constexpr (std::is_same_v<Scalar<T>, Interval>) {
    return T(Interval(std::numbers::pi, next_up(std::numbers::pi)));
  } else {
    return T(std::numbers::pi);
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

template <class T>
T integer_power(const T& x, int exponent) {
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

// Values without initialization: most programs need few, and a jet is long.
template <class T>
class Stack {
 public:
  explicit Stack(std::size_t size) : data_(reinterpret_cast<T*>(near_)) {
    static_assert(std::is_trivially_destructible_v<T>);
    if (size > kNear) {
      far_.resize(size);
      data_ = far_.data();
    }
  }
  T* begin() { return data_; }

 private:
  static constexpr std::size_t kNear = 32;
  alignas(T) std::byte near_[kNear * sizeof(T)];
  std::vector<T> far_;
  T* data_;
};

}  // namespace

template <class T>
T Expression::evaluate(std::span<const T> values) const {
  using std::abs, std::acos, std::acosh, std::asin, std::asinh, std::atan, std::atan2, std::atanh, std::cbrt, std::ceil;
  using std::cos, std::cosh, std::exp, std::floor, std::hypot, std::log, std::log10, std::max, std::min, std::pow;
  using std::round, std::sin, std::sinh, std::sqrt, std::tan, std::tanh;
  Stack<T> stack(stack_size_);
  T* top = stack.begin() - 1;  // the last value pushed; for binary operations b, the one before is a
  for (const Instruction& in : program_) {
    const auto operation = static_cast<Operation>(in.operation);
    switch (operation) {
      case Operation::literal:
        std::construct_at(++top, in.value);
        continue;
      case Operation::variable:
        std::construct_at(++top, values[in.index]);
        continue;
      case Operation::pi:
        std::construct_at(++top, pi<T>());
        continue;
      case Operation::name:  // bound expressions have none
      case Operation::radians:
        continue;
      case Operation::degrees:
        *top = *top / 180.0 * value(pi<T>());
        continue;
      case Operation::turns:
        *top = *top * 2.0 * value(pi<T>());
        continue;
      case Operation::negate:
        *top = -*top;
        continue;
      case Operation::integer_power:
        *top = integer_power(*top, in.index);
        continue;
      case Operation::logical_not:
        *top = number<T>(opposite(truth(*top)));
        continue;
      case Operation::sin:
        *top = sin(*top);
        continue;
      case Operation::cos:
        *top = cos(*top);
        continue;
      case Operation::tan:
        *top = tan(*top);
        continue;
      case Operation::asin:
        *top = asin(*top);
        continue;
      case Operation::acos:
        *top = acos(*top);
        continue;
      case Operation::atan:
        *top = atan(*top);
        continue;
      case Operation::sinh:
        *top = sinh(*top);
        continue;
      case Operation::cosh:
        *top = cosh(*top);
        continue;
      case Operation::tanh:
        *top = tanh(*top);
        continue;
      case Operation::asinh:
        *top = asinh(*top);
        continue;
      case Operation::acosh:
        *top = acosh(*top);
        continue;
      case Operation::atanh:
        *top = atanh(*top);
        continue;
      case Operation::exp:
        *top = exp(*top);
        continue;
      case Operation::log:
        *top = log(*top);
        continue;
      case Operation::log10:
        *top = log10(*top);
        continue;
      case Operation::sqrt:
        *top = sqrt(*top);
        continue;
      case Operation::cbrt:
        *top = cbrt(*top);
        continue;
      case Operation::abs:
        *top = abs(*top);
        continue;
      case Operation::sign:
        *top = sign(*top);
        continue;
      case Operation::floor:
        *top = floor(*top);
        continue;
      case Operation::ceil:
        *top = ceil(*top);
        continue;
      case Operation::round:
        *top = round(*top);
        continue;
      default:
        break;
    }
    if (operation == Operation::select || operation == Operation::clamp) {
      top -= 2;
      top[0] =
          operation == Operation::select ? chosen(truth(top[1]), top[0], top[2]) : min(max(top[0], top[1]), top[2]);
      continue;
    }
    const T& b = *top--;
    T& a = *top;
    switch (operation) {
      case Operation::add:
        a = a + b;
        break;
      case Operation::subtract:
        a = a - b;
        break;
      case Operation::multiply:
        a = a * b;
        break;
      case Operation::divide:
        a = a / b;
        break;
      case Operation::power:
        a = pow(a, b);
        break;
      case Operation::equal:
        a = number<T>(equal(value(a), value(b)));
        break;
      case Operation::unequal:
        a = number<T>(opposite(equal(value(a), value(b))));
        break;
      case Operation::less:
        a = number<T>(less(value(a), value(b)));
        break;
      case Operation::less_equal:
        a = number<T>(at_most(value(a), value(b)));
        break;
      case Operation::greater:
        a = number<T>(less(value(b), value(a)));
        break;
      case Operation::greater_equal:
        a = number<T>(at_most(value(b), value(a)));
        break;
      case Operation::logical_and:
        a = number<T>(both(truth(a), truth(b)));
        break;
      case Operation::logical_or:
        a = number<T>(opposite(both(opposite(truth(a)), opposite(truth(b)))));
        break;
      case Operation::atan2:
        a = atan2(a, b);
        break;
      case Operation::min:
        a = min(a, b);
        break;
      case Operation::max:
        a = max(a, b);
        break;
      case Operation::hypot:
        a = hypot(a, b);
        break;
      case Operation::mod:
        a = remainder(a, b);
        break;
      default:
        break;
    }
  }
  return *top;
}

template double Expression::evaluate(std::span<const double>) const;
template Interval Expression::evaluate(std::span<const Interval>) const;
template Jet<double, 1> Expression::evaluate(std::span<const Jet<double, 1>>) const;
template Jet<double, 2> Expression::evaluate(std::span<const Jet<double, 2>>) const;
template Jet<double, 3> Expression::evaluate(std::span<const Jet<double, 3>>) const;
template Jet<double, 4> Expression::evaluate(std::span<const Jet<double, 4>>) const;
template Jet<double, 5> Expression::evaluate(std::span<const Jet<double, 5>>) const;
template Jet<double, 6> Expression::evaluate(std::span<const Jet<double, 6>>) const;
template Jet2<double, 1> Expression::evaluate(std::span<const Jet2<double, 1>>) const;
template Jet2<double, 2> Expression::evaluate(std::span<const Jet2<double, 2>>) const;
template Jet2<double, 3> Expression::evaluate(std::span<const Jet2<double, 3>>) const;
template Jet2<double, 4> Expression::evaluate(std::span<const Jet2<double, 4>>) const;
template Jet<Interval, 1> Expression::evaluate(std::span<const Jet<Interval, 1>>) const;
template Jet<Interval, 2> Expression::evaluate(std::span<const Jet<Interval, 2>>) const;
template Jet2<Interval, 1> Expression::evaluate(std::span<const Jet2<Interval, 1>>) const;
template Jet2<Interval, 2> Expression::evaluate(std::span<const Jet2<Interval, 2>>) const;

}  // namespace lekalo::geometry
