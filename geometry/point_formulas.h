// Points whose coordinates are formulas of scene files, for curves and surfaces.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geometry/describe.h"
#include "geometry/expression/expression.h"
#include "geometry/numerics/triple.h"

namespace lekalo::geometry {

// What three formulas a, b, c of a point mean; angles are radians.
enum class Coordinates {
  cartesian,    // (a, b, c)
  cylindrical,  // (a cos b, a sin b, c)
  spherical     // (a cos c cos b, a cos c sin b, a sin c): radius, longitude, latitude
};

template <class T>
Triple<T> point_of(Coordinates coordinates, const T& a, const T& b, const T& c) {
  using std::cos;
  using std::sin;
  switch (coordinates) {
    case Coordinates::cylindrical:
      return {a * cos(b), a * sin(b), c};
    case Coordinates::spherical: {
      const T across = a * cos(c);
      return {across * cos(b), across * sin(b), a * sin(c)};
    }
    case Coordinates::cartesian:
      break;
  }
  return {a, b, c};
}

// Three formulas, bound to the variables, and what they mean.
class PointFormulas {
 public:
  // `variables`: as whoever wrote the formulas calls the one or two.
  PointFormulas(const std::array<Expression, 3>& formulas, Coordinates coordinates, std::vector<std::string> variables)
      : formulas_(std::make_shared<const std::array<Expression, 3>>(formulas)),
        program_(formulas),
        coordinates_(coordinates),
        variables_(std::move(variables)) {}

  const std::array<Expression, 3>& formulas() const { return *formulas_; }
  Coordinates coordinates() const { return coordinates_; }
  const std::vector<std::string>& variables() const { return variables_; }
  // What to say of a place where the point is not finite: "the formulas have no value at x = 0.5, y = 1".
  std::string no_value(std::span<const double> at) const;

  // The point at t, or at (u, v), over the number types of FormulaProgram.
  template <class T, class... More>
  Triple<T> operator()(const T& t, const More&... more) const {
    const std::array<T, 1 + sizeof...(More)> at{t, more...};
    std::array<T, 3> r;
    program_.evaluate(std::span<const T>(at), std::span<T>(r));
    return point_of(coordinates_, r[0], r[1], r[2]);
  }

 private:
  std::shared_ptr<const std::array<Expression, 3>> formulas_;
  FormulaProgram program_;
  Coordinates coordinates_;
  std::vector<std::string> variables_;
};

// From texts. Throws std::invalid_argument for one that is no formula of the variables.
PointFormulas point_formulas(const std::array<std::string, 3>& texts, const std::vector<std::string>& variables,
                             Coordinates coordinates = Coordinates::cartesian);

// A formula of the variables and named constants, from its text. Throws std::invalid_argument for one that is none.
Expression formula_of(const std::string& text, const std::vector<std::string>& variables,
                      std::span<const Expression::Constant> constants = {});

inline bool is_finite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// The parameter of a closed curve or surface moved into the domain by whole turns.
inline double wrapped(double x, const Interval& domain) {
  return domain.contains(x) ? x : x - domain.width() * std::floor((x - domain.lo) / domain.width());
}

// Declares the fields `point` and `coordinates`, formulas of `variables` (t, or u and v), and the short form that gives
// the last Cartesian coordinate as a formula of those before it: `y` of x, `z` of x and y.
void declare_formulas(TypeDeclaration& type, const std::vector<std::string>& variables);
// Reads them. Throws FieldError where both forms are given or neither, or too few formulas.
PointFormulas read_formulas(const Fields& fields, const std::vector<std::string>& variables);

}  // namespace lekalo::geometry
