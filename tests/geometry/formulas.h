// Formulas of scene files for tests.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/expression/expression.h"

namespace lekalo::geometry::checks {

inline std::array<Expression, 3> formulas(const std::array<std::string, 3>& texts,
                                          const std::vector<std::string>& variables) {
  std::vector<Expression::Variable> bound;
  for (const std::string& name : variables) bound.push_back({name, Measure::plain});
  std::array<Expression, 3> result;
  for (size_t k = 0; k < 3; ++k) {
    auto parsed = Expression::parse(texts[k]);
    if (!std::holds_alternative<Expression>(parsed)) throw std::invalid_argument(texts[k]);
    result[k] = std::get<Expression>(std::move(parsed));
    if (result[k].bind(bound)) throw std::invalid_argument(texts[k]);
  }
  return result;
}

}  // namespace lekalo::geometry::checks
