// A formula that is a polynomial of three variables, on segments: the polynomial of one parameter that it is there.
//
//   F((1 - s) p + s q) = sum b_i C(n, i) s^i (1 - s)^(n - i)
//
// It is found by running the formula on such sums in place of numbers: a variable is the sum of degree 1 with the ends'
// coordinates, a product multiplies the coefficients a_i = b_i C(n, i) like those of powers, and a sum first multiplies
// the operand of the lower degree by (s + (1 - s))^k (Farouki, Rajan 1988). Nothing is multiplied out that the formula
// keeps together, and no basis is changed, so little is lost to rounding.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/expression/expression.h"
#include "geometry/numerics/crossings.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

class LinePolynomial {
 public:
  static constexpr int kMaxDegree = BernsteinSource::kMaxDegree;

  // Of a formula bound to three variables: + - * and powers with whole exponents, division by constants. Anything else
  // of the variables, and a degree above the limit, gives none.
  static std::optional<LinePolynomial> of(const Expression& formula);

  int degree() const { return degree_; }
  // Gradient (x, y, z) and value (w).
  Vec4 at(const Vec3& p) const;
  // b_0 ... b_n on the segment from p to q, n = degree().
  void along(const Vec3& p, const Vec3& q, double* b) const;
  // A bound on the rounding error of each b_i for all segments in the box, whose ends are taken as exact.
  double rounding(const Box3& box) const;

 private:
  enum class Step : std::uint8_t { variable, constant, copy, negate, add, subtract, multiply, square, scale, shift };
  struct Instruction {
    Step step;
    int variable = 0;
    double value = 0;  // of constant, scale (times it) and shift (plus it)
  };
  static constexpr int kMaxForms = 12;  // held at a time

  bool finish();

  std::vector<Instruction> program_;
  int degree_ = 0;
};

}  // namespace lekalo::geometry
