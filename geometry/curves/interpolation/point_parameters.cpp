#include "geometry/curves/interpolation/point_parameters.h"

#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

namespace {

void check_points(std::span<const Vec3> points, bool closed) {
  const size_t needed = closed ? 3 : 2;
  if (points.size() < needed)
    throw FieldError("points", fmt::format("a {}curve through points needs at least {} points, not {}",
                                           closed ? "closed " : "", needed, points.size()));
  if (closed && points.front() == points.back())
    throw FieldError("points", "the last point repeats the first", "closed: true takes unrepeated points");
}

std::vector<double> by_rule(const std::string& rule, std::span<const Vec3> points, bool closed) {
  std::vector<double> parameters{0.0};
  const double power = rule == "uniform" ? 0 : rule == "centripetal" ? 0.5 : 1;
  for (const double length : polygon_steps(points, closed))
    parameters.push_back(parameters.back() + std::pow(length, power));
  for (size_t i = 1; i < parameters.size(); ++i)
    if (!(parameters[i] - parameters[i - 1] > kSameKnot * parameters.back()))
      throw FieldError("points", fmt::format("points {} and {} coincide", i - 1, i % points.size()),
                       "leave one of them out, or say knots: uniform");
  return parameters;
}

void check_given(const std::vector<double>& parameters, size_t points, bool closed) {
  const size_t needed = points + (closed ? 1 : 0);
  if (parameters.size() != needed)
    throw FieldError("knots",
                     fmt::format("{} points{} need {} parameters, not {}", points, closed ? ", closed," : "", needed,
                                 parameters.size()),
                     closed ? "the last one is where the curve comes back to the first point" : "one for each point");
  for (size_t i = 1; i < parameters.size(); ++i)
    if (!(parameters[i] - parameters[i - 1] > kSameKnot * (parameters.back() - parameters.front())))
      throw FieldError("knots", fmt::format("parameters of points must increase, but that of point {} is {} and that "
                                            "of point {} is {}",
                                            i - 1, parameters[i - 1], i, parameters[i]));
}

}  // namespace

std::vector<double> point_parameters(const Knots& knots, std::span<const Vec3> points, bool closed) {
  check_points(points, closed);
  if (knots.rule == "clamped")
    throw FieldError("knots", "'clamped' is a rule for control points, not for points on a curve",
                     "uniform, chord_length or centripetal");
  if (!knots.rule.empty()) return by_rule(knots.rule, points, closed);
  check_given(knots.values, points.size(), closed);
  return knots.values;
}

}  // namespace lekalo::geometry
