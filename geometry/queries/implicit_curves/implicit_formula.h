// A formula F of x, y, z less a level, as a function: values, gradients and enclosures.
#pragma once

#include "geometry/expression/expression.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

class ImplicitFormula {
 public:
  // `formula` is bound to x, y, z.
  ImplicitFormula(Expression formula, double level)
      : formula_(std::move(formula)), level_(level), smoothness_(formula_.smoothness()) {}

  const Expression& expression() const { return formula_; }
  double level() const { return level_; }
  Expression::Smoothness smoothness() const { return smoothness_; }

  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return formula_(x, y, z) - level_;
  }
  double operator()(const Vec3& p) const { return (*this)(p.x, p.y, p.z); }
  // Value and gradient.
  template <class S>
  Gradient<S> with_gradient(const S& x, const S& y, const S& z) const {
    using G = Gradient<S>;
    return (*this)(G::variable(x, 0), G::variable(y, 1), G::variable(z, 2));
  }
  // Value, gradient and second derivatives.
  template <class S>
  Jet3<S, 2> with_second(const S& x, const S& y, const S& z) const {
    using J = Jet3<S, 2>;
    return (*this)(J::variable(x, 0), J::variable(y, 1), J::variable(z, 2));
  }
  Vec3 gradient(const Vec3& p) const {
    const auto at = with_gradient(p.x, p.y, p.z);
    return {at.c[1], at.c[2], at.c[3]};
  }

  // Along a line: x = o + t d over the number types of Expression::evaluate.
  template <class T>
  T along(const Line& line, const T& t) const {
    return (*this)(t * line.direction.x + line.origin.x, t * line.direction.y + line.origin.y,
                   t * line.direction.z + line.origin.z);
  }

  Interval enclose(const Box3& box) const;
  // Where a line touches F = 0 and F has that sign beside: whether the surface is more than the point there. It is not
  // if the gradient is zero and the second derivatives make a form of the sign: an isolated point or line, such as the
  // handle of Whitney's umbrella.
  bool has_sheets(const Vec3& p, bool positive) const;

 private:
  Expression formula_;
  double level_;
  Expression::Smoothness smoothness_;
};

}  // namespace lekalo::geometry
