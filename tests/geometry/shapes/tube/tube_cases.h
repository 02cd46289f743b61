// Curves, laws and lines for the tests of tubes.
#pragma once

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/expression/expression.h"
#include "geometry/surfaces/surface_checks.h"

namespace lekalo::geometry {

inline Expression law(const std::string& text) {
  Expression result = std::get<Expression>(Expression::parse(text));
  const Expression::Variable s{"s"};
  EXPECT_FALSE(result.bind(std::span(&s, 1)));
  return result;
}

inline CurvePtr formula(const std::array<std::string, 3>& point, const Interval& domain, bool closed = false) {
  return std::make_shared<FormulaCurve>(point_formulas(point, {"t"}), domain, closed);
}

inline CurvePtr segment(const Vec3& a, const Vec3& b) {
  return std::make_shared<NurbsCurve>(polyline(std::vector{a, b}));
}

// Lines through the shape's box: from 2 sizes away, from inside, and from 1000 radii.
inline Line random_line(const Box3& box, double radius, int kind, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const Vec3 d = checks::random_direction(random);
  const Vec3 aim = box.lo + Vec3(unit(random), unit(random), unit(random)) * box.size();
  const double away = kind == 0 ? 2 * box.diameter() : kind == 1 ? 0 : 1000 * radius;
  return {aim - away * d, d};
}

}  // namespace lekalo::geometry
