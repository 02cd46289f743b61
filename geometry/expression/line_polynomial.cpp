#include "geometry/expression/line_polynomial.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "geometry/expression/operations.h"

namespace lekalo::geometry {
namespace {

constexpr int kMaxDegree = LinePolynomial::kMaxDegree;
constexpr double kUnitRoundoff = 0x1p-53;

using Row = std::array<double, kMaxDegree + 1>;
constexpr std::array<Row, kMaxDegree + 1> kBinomials = [] {
  std::array<Row, kMaxDegree + 1> rows{};
  for (int n = 0; n <= kMaxDegree; ++n) {
    rows[n][0] = 1;
    for (int i = 1; i <= n; ++i) rows[n][i] = rows[n - 1][i - 1] + (i < n ? rows[n - 1][i] : 0);
  }
  return rows;
}();

// The coefficients a_i of a sum.
struct Form {
  int degree;
  double a[kMaxDegree + 1];
};

void multiply(const double* a, int n, const double* b, int m, double* product) {
  for (int j = 0; j <= m; ++j) product[j] = a[0] * b[j];
  for (int i = 1; i <= n; ++i) {
    for (int j = 0; j < m; ++j) product[i + j] += a[i] * b[j];
    product[i + m] = a[i] * b[m];
  }
}

void multiply(const Form& a, const Form& b, Form& product) {
  product.degree = a.degree + b.degree;
  multiply(a.a, a.degree, b.a, b.degree, product.a);
}

void square(const Form& a, Form& product) {
  const int n = a.degree;
  product.degree = 2 * n;
  for (int k = 0; k <= 2 * n; ++k) {
    double sum = 0;
    for (int i = std::max(0, k - n); 2 * i < k; ++i) sum += a.a[i] * a.a[k - i];
    product.a[k] = k % 2 == 0 ? 2 * sum + a.a[k / 2] * a.a[k / 2] : 2 * sum;
  }
}

void raise(const Form& a, int degree, Form& raised) {
  raised.degree = degree;
  multiply(a.a, a.degree, kBinomials[degree - a.degree].data(), degree - a.degree, raised.a);
}

// What bounds a form on all segments of a box: the range of its b_i, their rounding error.
struct Bound {
  int degree = 0;
  Interval range;
  double error = 0;
};
double largest(const Bound& a) { return magnitude(a.range) + a.error; }
// That of a sum of n products, each with a factor that is a binomial coefficient or another sum's.
double of_terms(int n) { return (n + 2) * kUnitRoundoff; }

Bound product(const Bound& a, const Bound& b) {
  return {a.degree + b.degree, a.range * b.range,
          magnitude(a.range) * b.error + magnitude(b.range) * a.error + a.error * b.error +
              of_terms(std::min(a.degree, b.degree) + 1) * largest(a) * largest(b)};
}

Bound sum(const Bound& a, const Bound& b, const Interval& range) {
  const int terms = std::min({a.degree, b.degree, std::abs(a.degree - b.degree)}) + 1;
  const Bound& low = a.degree < b.degree ? a : b;
  const double raising = a.degree == b.degree ? 0 : of_terms(terms) * largest(low);
  Bound result{std::max(a.degree, b.degree), range, a.error + b.error + raising};
  result.error += kUnitRoundoff * largest(result);
  return result;
}

}  // namespace

std::optional<LinePolynomial> LinePolynomial::of(const Expression& formula) {
  // Of each value on the formula's stack: the number that it is, or that it is a form.
  std::vector<std::optional<double>> stack;
  LinePolynomial result;
  auto& program = result.program_;
  const auto emit = [&](Step step, int variable = 0, double value = 0) { program.push_back({step, variable, value}); };
  // A power of the form on top: squares, and a product with the form itself for each further bit.
  const auto power = [&](double exponent) {
    if (!(exponent >= 1 && exponent <= kMaxDegree) || exponent != std::floor(exponent)) return false;
    const auto bits = static_cast<unsigned>(exponent);
    for (int i = 1; i < std::popcount(bits); ++i) emit(Step::copy);
    for (unsigned bit = std::bit_floor(bits) / 2; bit > 0; bit /= 2) {
      emit(Step::square);
      if (bits & bit) emit(Step::multiply);
    }
    return true;
  };

  for (const Expression::Instruction& in : formula.program_) {
    const auto operation = static_cast<Operation>(in.operation);
    if (operation == Operation::variable) {
      emit(Step::variable, in.index);
      stack.push_back({});
      continue;
    }
    const size_t operands = static_cast<size_t>(operand_count(operation));
    bool known = true;
    for (size_t i = 0; i < operands; ++i) known = known && stack[stack.size() - 1 - i].has_value();
    if (known) {
      // A number: computed by the formula's own rules.
      Expression part = formula;
      part.program_.clear();
      for (size_t i = operands; i > 0; --i) {
        Expression::Instruction literal = in;
        literal.operation = static_cast<std::uint8_t>(Operation::literal);
        literal.value = *stack[stack.size() - i];
        part.program_.push_back(literal);
      }
      part.program_.push_back(in);
      part.compile();
      stack.resize(stack.size() - operands);
      stack.push_back(part.evaluate<double>({}));
      continue;
    }
    if (operation == Operation::negate) {
      emit(Step::negate);
      continue;
    }
    if (operation == Operation::integer_power) {
      if (!power(in.index)) return {};
      continue;
    }
    if (operands != 2) return {};
    const std::optional<double> a = stack[stack.size() - 2], b = stack.back();
    stack.resize(stack.size() - 2);
    stack.push_back({});
    switch (operation) {
      case Operation::add:
        a || b ? emit(Step::shift, 0, a ? *a : *b) : emit(Step::add);
        break;
      case Operation::subtract:
        if (a) emit(Step::negate);
        a || b ? emit(Step::shift, 0, a ? *a : -*b) : emit(Step::subtract);
        break;
      case Operation::multiply:
        a || b ? emit(Step::scale, 0, a ? *a : *b) : emit(Step::multiply);
        break;
      case Operation::divide:
        if (!b) return {};
        emit(Step::scale, 0, 1 / *b);
        break;
      case Operation::power:
        if (!b || !power(*b)) return {};
        break;
      default:
        return {};
    }
  }
  if (stack.back()) emit(Step::constant, 0, *stack.back());
  if (!result.finish()) return {};
  return result;
}

// Finds the degree; false where there is no room.
bool LinePolynomial::finish() {
  std::vector<int> degrees;
  for (const Instruction& in : program_) {
    switch (in.step) {
      case Step::variable:
        degrees.push_back(1);
        break;
      case Step::constant:
        degrees.push_back(0);
        break;
      case Step::copy:
        degrees.push_back(degrees.back());
        break;
      case Step::square:
        degrees.back() *= 2;
        break;
      case Step::add:
      case Step::subtract:
      case Step::multiply: {
        const int b = degrees.back();
        degrees.pop_back();
        degrees.back() = in.step == Step::multiply ? degrees.back() + b : std::max(degrees.back(), b);
        break;
      }
      default:
        break;
    }
    if (degrees.back() > kMaxDegree || degrees.size() > kMaxForms || !std::isfinite(in.value)) return false;
  }
  degree_ = degrees.back();
  return true;
}

Vec4 LinePolynomial::at(const Vec3& p) const {
  Vec4 values[kMaxForms];
  Vec4* top = values - 1;
  for (const Instruction& in : program_) {
    switch (in.step) {
      case Step::variable:
        *++top = Vec4(0, 0, 0, p[in.variable]);
        (*top)[in.variable] = 1;
        break;
      case Step::constant:
        *++top = Vec4(0, 0, 0, in.value);
        break;
      case Step::copy:
        top[1] = top[0];
        ++top;
        break;
      case Step::negate:
        *top = -*top;
        break;
      case Step::scale:
        *top *= in.value;
        break;
      case Step::shift:
        top->w += in.value;
        break;
      case Step::square: {
        const double value = top->w;
        *top *= 2 * value;
        top->w = value * value;
        break;
      }
      case Step::multiply: {
        const double a = top[-1].w, b = top->w;
        top[-1] = b * top[-1] + a * *top;
        top[-1].w = a * b;
        --top;
        break;
      }
      case Step::add:
        top[-1] += *top;
        --top;
        break;
      case Step::subtract:
        top[-1] -= *top;
        --top;
        break;
    }
  }
  return *top;
}

void LinePolynomial::along(const Vec3& p, const Vec3& q, double* b) const {
  // Results are written beside the stack and take their operand's place in it.
  Form room[kMaxForms + 1];
  Form* stack[kMaxForms];
  for (int i = 0; i < kMaxForms; ++i) stack[i] = &room[i];
  Form* spare = &room[kMaxForms];
  Form** top = stack - 1;
  for (const Instruction& in : program_) {
    switch (in.step) {
      case Step::variable:
        ++top;
        (*top)->degree = 1;
        (*top)->a[0] = p[in.variable];
        (*top)->a[1] = q[in.variable];
        break;
      case Step::constant:
        ++top;
        (*top)->degree = 0;
        (*top)->a[0] = in.value;
        break;
      case Step::copy:
        *top[1] = *top[0];
        ++top;
        break;
      case Step::negate: {
        Form& a = **top;
        for (int i = 0; i <= a.degree; ++i) a.a[i] = -a.a[i];
        break;
      }
      case Step::scale: {
        Form& a = **top;
        for (int i = 0; i <= a.degree; ++i) a.a[i] *= in.value;
        break;
      }
      case Step::shift: {
        Form& a = **top;
        for (int i = 0; i <= a.degree; ++i) a.a[i] += in.value * kBinomials[a.degree][i];
        break;
      }
      case Step::square:
        square(**top, *spare);
        std::swap(*top, spare);
        break;
      case Step::multiply:
        multiply(*top[-1], **top, *spare);
        --top;
        std::swap(*top, spare);
        break;
      case Step::add:
      case Step::subtract: {
        const int degree = std::max(top[-1]->degree, top[0]->degree);
        for (Form** form : {top - 1, top})
          if ((*form)->degree < degree) {
            raise(**form, degree, *spare);
            std::swap(*form, spare);
          }
        Form &a = *top[-1], &c = **top;
        if (in.step == Step::add)
          for (int i = 0; i <= degree; ++i) a.a[i] += c.a[i];
        else
          for (int i = 0; i <= degree; ++i) a.a[i] -= c.a[i];
        --top;
        break;
      }
    }
  }
  for (int i = 0; i <= degree_; ++i) b[i] = (*top)->a[i] / kBinomials[degree_][i];
}

double LinePolynomial::rounding(const Box3& box) const {
  Bound stack[kMaxForms];
  Bound* top = stack - 1;
  for (const Instruction& in : program_) {
    switch (in.step) {
      case Step::variable:
        *++top = {1, {box.lo[in.variable], box.hi[in.variable]}, 0};
        break;
      case Step::constant:
        *++top = {0, in.value, 0};
        break;
      case Step::copy:
        top[1] = top[0];
        ++top;
        break;
      case Step::negate:
        top->range = -top->range;
        break;
      case Step::scale:
        *top = product(*top, {0, in.value, kUnitRoundoff * std::abs(in.value)});
        break;
      case Step::shift:
        *top = sum(*top, {0, in.value, 0}, top->range + in.value);
        break;
      case Step::square:
        *top = product(*top, *top);
        break;
      default: {
        const Bound b = *top--;
        Bound& a = *top;
        a = in.step == Step::multiply ? product(a, b)
            : in.step == Step::add    ? sum(a, b, a.range + b.range)
                                      : sum(a, b, a.range - b.range);
      }
    }
  }
  return top->error + kUnitRoundoff * magnitude(top->range);
}

}  // namespace lekalo::geometry
