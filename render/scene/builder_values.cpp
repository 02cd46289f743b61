// Values of fields: numbers, words, lists, knots, formulas, colours.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/expression/nearest_name.h"
#include "render/scene/builder.h"
#include "render/scene/color_names.h"
#include "render/scene/scalars.h"
#include "render/scene/table.h"

namespace lekalo::render {

using geometry::Dimension;
using geometry::Grid;
using geometry::Interval;
using geometry::Kind;
using geometry::Knots;
using geometry::Measure;

namespace {

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  const auto nearest = geometry::nearest_name(word, known);
  return nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : std::string();
}

std::string range_text(const FieldType& type, double scale) {
  const bool lower = std::isfinite(type.minimum), upper = std::isfinite(type.maximum);
  if (lower && upper && !type.minimum_excluded && !type.maximum_excluded)
    return fmt::format("between {:.9g} and {:.9g}", type.minimum * scale, type.maximum * scale);
  if (lower && upper)
    return fmt::format("{} {:.9g} and {} {:.9g}", type.minimum_excluded ? "greater than" : "at least",
                       type.minimum * scale, type.maximum_excluded ? "less than" : "at most", type.maximum * scale);
  if (lower) return fmt::format("{} {:.9g}", type.minimum_excluded ? "greater than" : "at least", type.minimum * scale);
  return fmt::format("{} {:.9g}", type.maximum_excluded ? "less than" : "at most", type.maximum * scale);
}

bool outside(const FieldType& type, double x) {
  return x < type.minimum || x > type.maximum || (type.minimum_excluded && x == type.minimum) ||
         (type.maximum_excluded && x == type.maximum);
}

bool is_word(const FieldType& type, const Value& value) {
  return value.is_scalar() && std::find(type.choices.begin(), type.choices.end(), value.text) != type.choices.end();
}

}  // namespace

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
  const bool is_angle = type.dimension == Dimension::angle;
  const std::optional<double> x = is_angle ? parameters_.angle(value, counters) : parameters_.number(value, counters);
  if (!x) return std::nullopt;
  // Ranges of angles are declared in radians and shown in degrees.
  const double scale = is_angle ? 180 / geometry::kPi : 1;
  if (outside(type, *x)) {
    diagnostics_.error(value.place, fmt::format("expected a value {}{}, found {:.12g}", range_text(type, scale),
                                                is_angle ? " degrees" : "", *x * scale));
    return std::nullopt;
  }
  return x;
}

std::optional<Interval> Builder::read_range_by(const FieldType& type, const Value& value, const Counters& counters) {
  if (!value.is_sequence() || value.items.size() != 2) {
    diagnostics_.error(value.place, fmt::format("expected a range [from, to], found {}", kind_name(value)));
    return std::nullopt;
  }
  const auto a = read_number_by(type, value.items[0], counters);
  const auto b = read_number_by(type, value.items[1], counters);
  if (!a || !b) return std::nullopt;
  if (!(*a < *b)) {
    diagnostics_.error(value.place, "a range must begin below its end",
                       *a > *b ? "write the smaller number first" : "");
    return std::nullopt;
  }
  return Interval{*a, *b};
}

bool Builder::check_count(const FieldType& type, const Value& value, size_t count) {
  if (count >= static_cast<size_t>(type.minimum_count) && count <= static_cast<size_t>(type.maximum_count)) return true;
  std::string wanted = type.minimum_count == type.maximum_count ? fmt::format("{}", type.minimum_count)
                       : count < static_cast<size_t>(type.minimum_count)
                           ? fmt::format("at least {}", type.minimum_count)
                           : fmt::format("at most {}", type.maximum_count);
  diagnostics_.error(value.place, fmt::format("expected {} value{}, found {}", wanted,
                                              wanted.ends_with(" 1") || wanted == "1" ? "" : "s", count));
  return false;
}

std::vector<Scoped> Builder::items(const Value& value, const Counters& counters) {
  std::vector<Scoped> all;
  if (!value.is_sequence()) {
    if (value.is_map() && value.find("repeat"))
      repeat(value, counters, [&](const Counters& inner, const std::string&) { all.push_back({&value, inner}); });
    else
      all.push_back({&value, counters});
    return all;
  }
  for (const Value& item : value.items) {
    if (item.is_map() && item.find("repeat"))
      repeat(item, counters, [&](const Counters& inner, const std::string&) { all.push_back({&item, inner}); });
    else
      all.push_back({&item, counters});
  }
  return all;
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
      const auto x = read_number_by(type, *item.value, item.counters);
      if (!x) return std::nullopt;
      numbers.push_back(*x);
    }
  }
  if (!check_count(type, value, numbers.size())) return std::nullopt;
  return numbers;
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
                         fmt::format("one of {}, or the full list of knots", join(allowed)));
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
std::optional<std::any> Builder::read_color(const FieldType& type, const Value& value, const Counters& counters) {
  const bool textured =
      std::find(type.categories.begin(), type.categories.end(), Category::texture) != type.categories.end();
  std::optional<Vec3> color;
  if (value.is_scalar()) {
    if (value.text.starts_with('#')) {
      color = hex_color(value.text);
      if (!color)
        diagnostics_.error(value.place, fmt::format("'{}' is no colour", value.text),
                           "six or three hexadecimal digits: '#dfe6ee', '#abc'");
    } else if (!value.text.empty() && std::isalpha(static_cast<unsigned char>(value.text[0])) &&
               value.text.find_first_of(" +-*/^().") == std::string::npos) {
      color = named_color(value.text);
      if (!color) {
        // A number given by a parameter is a grey.
        const Value* all = section("parameters");
        if (all && find_named(*all, value.text, value.place.file ? value.place.file->scope : "").entry) {
          const auto grey = read_number_by(geometry::number().non_negative(), value, counters);
          if (grey) color = Vec3(*grey);
        } else {
          diagnostics_.error(value.place,
                             fmt::format("unknown colour '{}'{}", value.text, suggestion(value.text, color_names())),
                             "a CSS colour name, '#rrggbb' in quotes, or three linear values [r, g, b]");
        }
      }
    } else {
      const auto grey = read_number_by(geometry::number().non_negative(), value, counters);
      if (grey) color = Vec3(*grey);
    }
  } else if (value.is_sequence()) {
    const auto numbers = read_numbers(geometry::numbers().non_negative().count(3, 3), value, counters);
    if (numbers) color = Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
  } else if (const Value* display = value.find("srgb")) {
    const auto numbers = read_numbers(geometry::numbers().between(0, 1).count(3, 3), *display, counters);
    if (numbers)
      color = Vec3(linear_of_srgb((*numbers)[0]), linear_of_srgb((*numbers)[1]), linear_of_srgb((*numbers)[2]));
  } else if (textured) {
    const Category wanted[] = {Category::texture};
    const auto built = build_typed(value, counters, wanted);
    if (!built) return std::nullopt;
    return built->value;
  } else {
    diagnostics_.error(value.place, "expected a colour, found a map",
                       "a CSS colour name, '#rrggbb' in quotes, [r, g, b], or { srgb: [r, g, b] }");
  }
  if (!color) return std::nullopt;
  for (int k = 0; k < 3; ++k)
    if (outside(type, (*color)[k])) {
      diagnostics_.error(value.place, fmt::format("the values of this colour must be {}", range_text(type, 1)));
      return std::nullopt;
    }
  return std::any(*color);
}

// Bare numbers are pixels, page lengths paper; `auto` for at most one side.
std::optional<geometry::PictureSize> Builder::read_picture_size(const Value& value, const Counters& counters) {
  if (!value.is_sequence() || value.items.size() != 2) {
    diagnostics_.error(value.place, fmt::format("expected [width, height], found {}", kind_name(value)),
                       "pixels: [960, 540]; paper: [84 mm, 60 mm]; one side may be auto");
    return std::nullopt;
  }
  geometry::PictureSize size;
  bool pixels = false;
  double* sides[2] = {&size.width, &size.height};
  for (int k = 0; k < 2; ++k) {
    const Value& item = value.items[static_cast<size_t>(k)];
    if (item.is_scalar() && item.text == "auto") continue;
    const bool paper = item.is_scalar() && (item.text.ends_with("mm") || item.text.ends_with("pt"));
    if (paper) {
      const auto length = read_page_length(item);
      if (!length) {
        report(diagnostics_, item, length.slip());
        return std::nullopt;
      }
      *sides[k] = length->millimetres(96);
      size.on_paper = true;
    } else {
      const auto n = parameters_.integer(item, counters);
      if (!n) return std::nullopt;
      *sides[k] = *n;
      pixels = true;
    }
    const double most = paper ? 5000 : 65536;
    if (!(*sides[k] >= 1 && *sides[k] <= most)) {
      diagnostics_.error(item.place,
                         fmt::format("a side of a picture is between 1 and {:.9g} {}", most, paper ? "mm" : "pixels"));
      return std::nullopt;
    }
  }
  if (size.width == 0 && size.height == 0) {
    diagnostics_.error(value.place, "only one side of a picture can be auto");
    return std::nullopt;
  }
  if (pixels && size.on_paper) {
    diagnostics_.error(value.place, "width and height are both in pixels or both on paper");
    return std::nullopt;
  }
  return size;
}

std::optional<std::any> Builder::read(const FieldType& type, const Value& value, const Counters& counters) {
  if (value.invalid) return std::nullopt;
  const auto wrap = [](auto&& result) -> std::optional<std::any> {
    if (!result) return std::nullopt;
    return std::any(*std::move(result));
  };
  const auto wrap_reading = [&](auto&& reading) -> std::optional<std::any> {
    if (reading) return std::any(*reading);
    report(diagnostics_, value, reading.slip());
    return std::nullopt;
  };
  if (!type.choices.empty() && type.kind != Kind::choice && type.kind != Kind::words && type.kind != Kind::knots &&
      is_word(type, value))
    return std::any(value.text);
  switch (type.kind) {
    case Kind::number:
      return wrap(read_number_by(type, value, counters));
    case Kind::integer: {
      const auto n = parameters_.integer(value, counters);
      if (!n) return std::nullopt;
      if (outside(type, *n)) {
        diagnostics_.error(value.place, fmt::format("expected a value {}, found {}", range_text(type, 1), *n));
        return std::nullopt;
      }
      return std::any(*n);
    }
    case Kind::boolean:
      return wrap_reading(read_boolean(value));
    case Kind::choice:
      if (is_word(type, value)) return std::any(value.text);
      diagnostics_.error(value.place,
                         value.is_scalar()
                             ? fmt::format("unknown word '{}'{}", value.text, suggestion(value.text, type.choices))
                             : fmt::format("expected a word, found {}", kind_name(value)),
                         fmt::format("one of {}", join(type.choices)));
      return std::nullopt;
    case Kind::text:
      return wrap_reading(read_text(value));
    case Kind::name:
      return wrap_reading(read_name(value));
    case Kind::file: {
      const auto name = read_text(value);
      if (!name) return wrap_reading(name);
      const auto path = value.place.file ? find_input(*value.place.file, *name, options_.search_path) : std::nullopt;
      if (!path) {
        diagnostics_.error(value.place, fmt::format("there is no file '{}'", *name),
                           "looked for beside the scene file and in the shipped scenes");
        return std::nullopt;
      }
      files_named_.push_back(*path);
      return std::any(path->string());
    }
    case Kind::point:
      return wrap(read_point(value, counters));
    case Kind::direction:
      return wrap(read_vector(value, counters, true));
    case Kind::vector:
      return wrap(read_vector(value, counters, false));
    case Kind::axis:
      return wrap(read_axis(value, counters));
    case Kind::frame:
      return wrap(read_frame(value, counters));
    case Kind::range:
      return wrap(read_range_by(type, value, counters));
    case Kind::rectangle: {
      const Value* u = value.find("u");
      const Value* v = value.find("v");
      if (!value.is_map() || !u || !v || value.entries.size() != 2) {
        diagnostics_.error(value.place, "expected the two ranges of a part of the parameter plane",
                           "write { u: [from, to], v: [from, to] }");
        return std::nullopt;
      }
      const auto a = read_range_by(type, *u, counters);
      const auto b = read_range_by(type, *v, counters);
      if (!a || !b) return std::nullopt;
      return std::any(geometry::Rectangle{*a, *b});
    }
    case Kind::points:
    case Kind::points2:
      return wrap(read_points(type, value, counters));
    case Kind::net:
      return wrap(read_net(type, value, counters));
    case Kind::numbers:
      return wrap(read_numbers(type, value, counters));
    case Kind::number_grid:
      return wrap(read_number_grid(type, value, counters));
    case Kind::indices: {
      std::vector<std::vector<int>> lists;
      for (const Scoped& row : items(value, counters)) {
        std::vector<int> list;
        for (const Scoped& item : items(*row.value, row.counters)) {
          const auto n = parameters_.integer(*item.value, item.counters);
          if (!n) return std::nullopt;
          list.push_back(*n);
        }
        lists.push_back(std::move(list));
      }
      return std::any(lists);
    }
    case Kind::knots:
      return wrap(read_knots(type, value, counters));
    case Kind::color:
      return read_color(type, value, counters);
    case Kind::formula:
      return wrap(read_formula(type, value, counters));
    case Kind::formulas: {
      std::vector<Expression> all;
      for (const Scoped& item : items(value, counters)) {
        auto one = read_formula(type, *item.value, item.counters);
        if (!one) return std::nullopt;
        all.push_back(*std::move(one));
      }
      if (!check_count(type, value, all.size())) return std::nullopt;
      return std::any(all);
    }
    case Kind::reference: {
      auto built = refer(value, counters, type.categories);
      if (!built) return std::nullopt;
      return built->value;
    }
    case Kind::references: {
      auto all = refer_all(value, counters, type.categories);
      if (!all || !check_count(type, value, all->size())) return std::nullopt;
      return std::any(*std::move(all));
    }
    case Kind::group: {
      if (!value.is_map()) {
        diagnostics_.error(value.place, fmt::format("expected a map of fields, found {}", kind_name(value)));
        return std::nullopt;
      }
      return wrap(read_fields(*type.fields, value, counters, "this map"));
    }
    case Kind::groups: {
      std::vector<Fields> all;
      for (const Scoped& item : items(value, counters)) {
        if (!item.value->is_map()) {
          diagnostics_.error(item.value->place,
                             fmt::format("expected a map of fields, found {}", kind_name(*item.value)));
          return std::nullopt;
        }
        auto one = read_fields(*type.fields, *item.value, item.counters, "this map", {"repeat"});
        if (!one) return std::nullopt;
        all.push_back(*std::move(one));
      }
      return std::any(all);
    }
    case Kind::transform:
      return wrap(read_transform(value, counters));
    case Kind::page_length: {
      const auto length = read_page_length(value);
      if (!length) return wrap_reading(length);
      return std::any(length->millimetres(96));
    }
    case Kind::picture_size:
      return wrap(read_picture_size(value, counters));
    case Kind::texts: {
      std::vector<std::string> all;
      for (const Scoped& item : items(value, counters)) {
        const auto one = read_quoted_text(*item.value);
        if (!one) {
          report(diagnostics_, *item.value, one.slip());
          return std::nullopt;
        }
        all.push_back(*one);
      }
      return std::any(all);
    }
    case Kind::words: {
      std::vector<std::string> all;
      FieldType one = type;
      one.kind = Kind::choice;
      for (const Scoped& item : items(value, counters)) {
        const auto word = read(one, *item.value, item.counters);
        if (!word) return std::nullopt;
        all.push_back(std::any_cast<std::string>(*word));
      }
      return std::any(all);
    }
  }
  return std::nullopt;
}

}  // namespace lekalo::render
