#include "geometry/point_formulas.h"

#include <fmt/format.h>

#include <stdexcept>

namespace lekalo::geometry {

namespace {

std::vector<std::string> places(const std::vector<std::string>& variables) {
  return variables.size() == 1 ? std::vector<std::string>{"x"} : std::vector<std::string>{"x", "y"};
}
std::string short_form(const std::vector<std::string>& variables) { return variables.size() == 1 ? "y" : "z"; }

}  // namespace

Expression formula_of(const std::string& text, const std::vector<std::string>& variables,
                      std::span<const Expression::Constant> constants) {
  std::vector<Expression::Variable> bound;
  for (const std::string& name : variables) bound.push_back({name, Measure::plain});
  auto parsed = Expression::parse(text);
  auto* expression = std::get_if<Expression>(&parsed);
  if (!expression || expression->bind(bound, constants))
    throw std::invalid_argument("no formula of the variables: " + text);
  return std::move(*expression);
}

PointFormulas point_formulas(const std::array<std::string, 3>& texts, const std::vector<std::string>& variables,
                             Coordinates coordinates) {
  std::array<Expression, 3> result;
  for (size_t k = 0; k < 3; ++k) result[k] = formula_of(texts[k], variables);
  return {result, coordinates, variables};
}

std::string PointFormulas::no_value(std::span<const double> at) const {
  std::string text;
  for (size_t k = 0; k < at.size(); ++k)
    text += fmt::format("{}{} = {:.6g}", text.empty() ? "the formulas have no value at " : ", ", variables_[k], at[k]);
  return text;
}

void declare_formulas(TypeDeclaration& type, const std::vector<std::string>& variables) {
  const bool is_curve = variables.size() == 1;
  const std::string of = is_curve ? "t" : "u and v";
  std::vector<std::string> words{"cartesian", "cylindrical", "spherical"};
  if (is_curve) words.insert(words.begin() + 1, "polar");
  type.optional("point", formulas(variables, is_curve ? 2 : 3, 3), "coordinates of the point, formulas of " + of)
      .field("coordinates", choice(words),
             std::string("of the point: cartesian x, y, z; ") + (is_curve ? "polar distance, angle; " : "") +
                 "cylindrical distance from the axis z, angle, z; spherical distance from the origin, longitude, "
                 "latitude. Angles are in radians where they have no unit",
             "cartesian");
  if (is_curve)
    type.optional("y", formula(places(variables)), "in place of point: the curve (x, y(x)), a formula of x");
  else
    type.optional("z", formula(places(variables)),
                  "in place of point: the surface (x, y, z(x, y)), a formula of x and y");
}

PointFormulas read_formulas(const Fields& fields, const std::vector<std::string>& variables) {
  const std::string other = short_form(variables);
  std::array<Expression, 3> result;
  if (fields.has("point") == fields.has(other)) {
    const std::string hint =
        "write point: [...], or " + other + ": a formula of " + (variables.size() == 1 ? "x" : "x and y");
    throw FieldError(fields.has(other) ? other : "point",
                     fields.has(other) ? "both 'point' and '" + other + "' are given" : "there is no formula", hint);
  }
  const std::string& coordinates = fields.text("coordinates");
  if (fields.has(other)) {
    if (coordinates != "cartesian") throw FieldError("coordinates", "'" + other + "' is a Cartesian coordinate");
    for (size_t k = 0; k < variables.size(); ++k) result[k] = formula_of(variables[k], variables);
    result[variables.size()] = fields.get<Expression>(other);
    if (variables.size() == 1) result[2] = formula_of("0", variables);
    return {result, Coordinates::cartesian, places(variables)};
  }
  const auto& given = fields.get<std::vector<Expression>>("point");
  for (size_t k = 0; k < 3; ++k) result[k] = k < given.size() ? given[k] : formula_of("0", variables);
  const size_t needed = coordinates == "cartesian" ? given.size() : coordinates == "polar" ? 2 : 3;
  if (given.size() != needed)
    throw FieldError("point", coordinates + " coordinates are " + std::to_string(needed) + ", found " +
                                  std::to_string(given.size()));
  if (coordinates == "polar" || coordinates == "cylindrical") return {result, Coordinates::cylindrical, variables};
  return {result, coordinates == "spherical" ? Coordinates::spherical : Coordinates::cartesian, variables};
}

}  // namespace lekalo::geometry
