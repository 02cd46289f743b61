// Points whose coordinates are three numbers of any type, for formulas of curves and surfaces.
#pragma once

#include <array>
#include <string>

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
struct PointFormulas {
  std::array<Expression, 3> formulas;
  Coordinates coordinates = Coordinates::cartesian;
};

// Declares the fields `point` and `coordinates`, formulas of `variables` (t, or u and v), and the short form that gives
// the last Cartesian coordinate as a formula of those before it: `y` of x, `z` of x and y.
void declare_formulas(TypeDeclaration& type, const std::vector<std::string>& variables);
// Reads them. Throws FieldError where both forms are given or neither, or too few formulas.
PointFormulas read_formulas(const Fields& fields, const std::vector<std::string>& variables);

}  // namespace lekalo::geometry
