// One evaluation for all number types: steps over numbered places of T.
#include "geometry/expression/formula_program.h"

#include <cstddef>

#include "geometry/expression/apply_operation.h"
#include "geometry/numerics/majorant.h"

namespace lekalo::geometry {

using namespace operations;

namespace {

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

}  // namespace

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
      case Operation::multiply_add:
        at[step.to] = product(a, b) + at[step.c];
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
template void FormulaProgram::evaluate(std::span<const Jet<Interval, 4>>, std::span<Jet<Interval, 4>>) const;
template void FormulaProgram::evaluate(std::span<const Jet2<Interval, 1>>, std::span<Jet2<Interval, 1>>) const;
template void FormulaProgram::evaluate(std::span<const Jet2<Interval, 2>>, std::span<Jet2<Interval, 2>>) const;
template void FormulaProgram::evaluate(std::span<const Jet2<Interval, 3>>, std::span<Jet2<Interval, 3>>) const;
template void FormulaProgram::evaluate(std::span<const Jet2<Interval, 4>>, std::span<Jet2<Interval, 4>>) const;
template void FormulaProgram::evaluate(std::span<const Jet3<double, 2>>, std::span<Jet3<double, 2>>) const;
template void FormulaProgram::evaluate(std::span<const Jet3<Interval, 2>>, std::span<Jet3<Interval, 2>>) const;
template void FormulaProgram::evaluate(std::span<const Jet3<double, 3>>, std::span<Jet3<double, 3>>) const;
template void FormulaProgram::evaluate(std::span<const Gradient<double>>, std::span<Gradient<double>>) const;
template void FormulaProgram::evaluate(std::span<const Gradient<Interval>>, std::span<Gradient<Interval>>) const;
template void FormulaProgram::evaluate(std::span<const Majorant<4>>, std::span<Majorant<4>>) const;

}  // namespace lekalo::geometry
