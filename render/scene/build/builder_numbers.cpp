// Numbers, ranges, lists and grids of them, knots, formulas.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/scene/build/builder.h"
#include "render/scene/values/scalars.h"
#include "render/scene/values/words.h"
#include "render/scene/yaml/table.h"

namespace lekalo::render {

using geometry::Dimension;
using geometry::Grid;
using geometry::Interval;
using geometry::Knots;
using geometry::Measure;
using geometry::ParameterValues;

std::optional<double> Builder::read_number_by(const FieldType& type, const Value& value, const Counters& counters) {
  if (value.is_scalar() && type.dimension == Dimension::length) {
    // Model lengths never carry a unit.
    const std::string& t = value.text;
    for (const char* unit : {"mm", "cm", "pt", "px", "in"})
      if (t.size() > 2 && t.ends_with(unit) &&
          (std::isdigit(static_cast<unsigned char>(t[t.size() - 3])) || t[t.size() - 3] == ' ')) {
        diagnostics_.error(value.place, fmt::format("a length of the model has no unit, found '{}'", t),
                           "write the bare number; info.unit says what one scene unit is");
        return std::nullopt;
      }
  }
  const bool is_angle = type.dimension == Dimension::angle, is_wavelength = type.dimension == Dimension::wavelength;
  const std::optional<double> x = is_angle        ? parameters_.angle(value, counters)
                                  : is_wavelength ? read_wavelength(value, counters)
                                                  : parameters_.number(value, counters);
  if (!x) return std::nullopt;
  // Ranges of angles are declared in radians and shown in degrees.
  const double scale = is_angle ? 180 / geometry::kPi : 1;
  if (is_outside(type, *x)) {
    diagnostics_.error(value.place, fmt::format("expected a value {}{}, found {:.12g}", range_text(type, scale),
                                                is_angle        ? " degrees"
                                                : is_wavelength ? " nm"
                                                                : "",
                                                *x * scale));
    return std::nullopt;
  }
  return x;
}

// Nanometres, with their unit or without.
std::optional<double> Builder::read_wavelength(const Value& value, const Counters& counters) {
  if (!value.is_scalar() || !value.text.ends_with("nm")) return parameters_.number(value, counters);
  const auto expression =
      parameters_.bind(value, std::string_view(value.text).substr(0, value.text.size() - 2), 0, counters);
  if (!expression) return std::nullopt;
  const double length = (*expression)();
  if (!std::isfinite(length)) diagnostics_.error(value.place, "the formula has no finite value");
  return std::isfinite(length) ? std::optional(length) : std::nullopt;
}

std::optional<Interval> Builder::read_interval(const FieldType& type, const Value& value, const Counters& counters) {
  if (!value.is_sequence() || value.items.size() != 2) {
    diagnostics_.error(value.place, fmt::format("expected a range [from, to], found {}", kind_name(value)));
    return std::nullopt;
  }
  const auto a = read_number_by(type, value.items[0], counters);
  const auto b = read_number_by(type, value.items[1], counters);
  if (!a || !b) return std::nullopt;
  if (!(*a < *b)) {
    diagnostics_.error(value.place, "a range must begin below its end",
                       *a > *b ? "write the smaller number first" : "write two different numbers");
    return std::nullopt;
  }
  return Interval{*a, *b};
}

std::optional<std::vector<double>> Builder::read_numbers(const FieldType& type, const Value& value,
                                                         const Counters& counters) {
  std::vector<double> numbers;
  if (value.is_map() && value.find("file")) {
    const auto path = read(geometry::file(), *value.find("file"), counters);
    if (!path) return std::nullopt;
    const auto table = read_table(std::any_cast<std::string>(*path), value.place, diagnostics_);
    if (!table) return std::nullopt;
    numbers = table->values;
  } else {
    for (const Scoped& item : items(value, counters)) {
      if (is_range(*item.value)) {
        const auto some = read_whole_numbers(*item.value, item.counters);
        if (!some) return std::nullopt;
        for (const double x : *some) {
          if (is_outside(type, x)) {
            diagnostics_.error(item.value->place,
                               fmt::format("expected values {}, found {:.12g}", range_text(type, 1), x));
            return std::nullopt;
          }
          numbers.push_back(x);
        }
        continue;
      }
      const auto x = read_number_by(type, *item.value, item.counters);
      if (!x) return std::nullopt;
      numbers.push_back(*x);
    }
  }
  if (!check_count(type, value, numbers.size())) return std::nullopt;
  return numbers;
}

// One number is a count; a list or a range are the values themselves.
std::optional<ParameterValues> Builder::read_counts(const FieldType& type, const Value& value,
                                                    const Counters& counters) {
  constexpr int kMaxLines = 10000;
  ParameterValues result;
  if (value.is_scalar() && !is_range(value)) {
    const auto n = parameters_.integer(value, counters);
    if (!n) return std::nullopt;
    if (*n < 1 || *n > kMaxLines) {
      diagnostics_.error(value.place, fmt::format("expected a count between 1 and {}, found {}", kMaxLines, *n),
                         fmt::format("a list says where: [{}]", *n));
      return std::nullopt;
    }
    result.count = *n;
    return result;
  }
  const auto values = read_numbers(type, value, counters);
  if (!values) return std::nullopt;
  result.values = *values;
  return result;
}

std::optional<Grid<double>> Builder::read_number_grid(const FieldType& type, const Value& value,
                                                      const Counters& counters) {
  Grid<double> grid;
  if (value.is_map() && value.find("file")) {
    const auto path = read(geometry::file(), *value.find("file"), counters);
    if (!path) return std::nullopt;
    const auto table = read_table(std::any_cast<std::string>(*path), value.place, diagnostics_);
    if (!table) return std::nullopt;
    grid.rows = static_cast<int>(table->row_count());
    grid.columns = static_cast<int>(table->column_count);
    grid.values = table->values;
    return grid;
  }
  if (!value.is_sequence() || value.items.empty()) {
    diagnostics_.error(value.place, fmt::format("expected rows of numbers, found {}", kind_name(value)));
    return std::nullopt;
  }
  for (const Value& row : value.items) {
    FieldType plain = type;
    plain.minimum_count = 1;
    if (!row.is_sequence()) {
      diagnostics_.error(row.place, fmt::format("expected a row [a, b, ...], found {}", kind_name(row)));
      return std::nullopt;
    }
    const auto numbers = read_numbers(plain, row, counters);
    if (!numbers) return std::nullopt;
    if (grid.rows > 0 && static_cast<int>(numbers->size()) != grid.columns) {
      diagnostics_.error(row.place,
                         fmt::format("this row has {} values, the rows before it {}", numbers->size(), grid.columns));
      return std::nullopt;
    }
    grid.columns = static_cast<int>(numbers->size());
    grid.values.insert(grid.values.end(), numbers->begin(), numbers->end());
    ++grid.rows;
  }
  return grid;
}

std::optional<Knots> Builder::read_knots(const FieldType& type, const Value& value, const Counters& counters) {
  static const std::vector<std::string> rules = {"clamped", "uniform", "chord_length", "centripetal"};
  if (value.is_scalar()) {
    const std::vector<std::string>& allowed = type.choices.empty() ? rules : type.choices;
    if (std::find(allowed.begin(), allowed.end(), value.text) == allowed.end()) {
      diagnostics_.error(value.place,
                         fmt::format("unknown rule for knots '{}'{}", value.text, suggestion(value.text, allowed)),
                         fmt::format("one of {}, or the full list of knots", listed(allowed)));
      return std::nullopt;
    }
    return Knots{value.text, {}};
  }
  FieldType plain = type;
  plain.dimension = Dimension::plain;
  const auto values = read_numbers(plain, value, counters);
  if (!values) return std::nullopt;
  return Knots{{}, *values};
}

std::optional<Expression> Builder::read_formula(const FieldType& type, const Value& value, const Counters& counters) {
  std::vector<Expression::Variable> variables;
  for (const std::string& name : type.variables) variables.push_back({name, Measure::plain});
  auto expression = parameters_.bind(value, counters, variables);
  if (!expression) return std::nullopt;
  if (type.dimension == Dimension::angle) {
    if (const auto error = expression->convert_to_angle()) {
      diagnostics_.error(value.place_of(error->offset, 1), error->message, error->hint);
      return std::nullopt;
    }
  }
  if (expression->measure() == Measure::truth) {
    diagnostics_.error(value.place, "expected a formula for a number, found a condition");
    return std::nullopt;
  }
  return expression;
}

// Names and quoted hexadecimal are display (sRGB) values; three numbers are linear Rec.709, one is a linear grey.

}  // namespace lekalo::render
