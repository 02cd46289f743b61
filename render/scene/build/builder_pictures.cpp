// Colours, sizes of pictures, lengths and texts on the page.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "render/scene/build/builder.h"
#include "render/scene/values/color_names.h"
#include "render/scene/values/scalars.h"
#include "render/scene/values/words.h"

namespace lekalo::render {

namespace {

constexpr double kPixelsPerInch = 96;  // of page lengths in px, as in CSS

}  // namespace

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
          std::vector<std::string> known = color_names();
          known.insert(known.end(), type.choices.begin(), type.choices.end());
          diagnostics_.error(value.place,
                             fmt::format("unknown colour '{}'{}", value.text, suggestion(value.text, known)),
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
    if (is_outside(type, (*color)[k])) {
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
      *sides[k] = length->millimetres(kPixelsPerInch);
      size.on_paper = true;
    } else {
      const auto n = parameters_.integer(item, counters);
      if (!n) return std::nullopt;
      *sides[k] = *n;
      pixels = true;
    }
    const double most = paper ? 5000 : Film::kMaxSide;
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

std::optional<double> Builder::read_page_length_by(const FieldType& type, const Value& value) {
  const auto length = read_page_length(value);
  if (!length) {
    report(diagnostics_, value, length.slip());
    return std::nullopt;
  }
  const double x = length->millimetres(kPixelsPerInch);
  if (is_outside(type, x)) {
    diagnostics_.error(value.place, fmt::format("expected a length {} mm, found {}", range_text(type, 1), value.text));
    return std::nullopt;
  }
  return x;
}

// TeX with templates; counters of repeats around it are put in, those that the field brings stay free.
std::optional<TextTemplate> Builder::read_label(const FieldType& type, const Value& value, const Counters& counters) {
  const auto text = read_text(value);
  if (!text) {
    report(diagnostics_, value, text.slip());
    return std::nullopt;
  }
  const auto fail = [&](const TextSlip& slip) {
    diagnostics_.error(value.place_of(slip.offset, 1), slip.message, slip.hint);
    return std::nullopt;
  };
  std::vector<std::string> names = type.variables;
  for (const Expression::Constant& counter : counters.values) names.push_back(counter.name);
  if (const Value* all = section("parameters"))
    for (const Entry& entry : all->entries) names.push_back(entry.key.name);
  std::vector<TemplatePart> parts;
  if (const auto slip = split_template(*text, names, parts)) return fail(*slip);
  TextTemplate result;
  result.counters = type.variables;
  std::vector<Expression::Variable> variables;
  for (const std::string& name : type.variables) variables.push_back({name, geometry::Measure::plain});
  for (const TemplatePart& part : parts) {
    TextTemplate::Part& made = result.parts.emplace_back();
    if (!part.is_value) {
      made.text = part.text;
      continue;
    }
    if (part.is_name && std::find(names.begin(), names.end(), part.text) == names.end()) {
      const std::string known = type.variables.empty()
                                    ? "there is no counter here"
                                    : "counters here are %" + fmt::format("{}", fmt::join(type.variables, ", %"));
      return fail({part.offset,
                   fmt::format("unknown counter '%{}' of a text{}", part.text, suggestion(part.text, names)),
                   known + "; a percent sign is written %%"});
    }
    auto expression = parameters_.bind(value, part.text, part.offset, counters, variables);
    if (!expression) return std::nullopt;
    if (expression->measure() == geometry::Measure::truth)
      return fail({part.offset, "expected a number, found a condition", "write for example 1 if n > 2 else 0"});
    const bool is_free = std::any_of(type.variables.begin(), type.variables.end(), [&](const std::string& name) {
      return std::find(expression->names().begin(), expression->names().end(), name) != expression->names().end();
    });
    const std::vector<double> none(type.variables.size(), 0.0);
    if (!is_free && !std::isfinite(expression->evaluate<double>(none)))
      return fail({part.offset, "the formula has no finite value", ""});
    made.value = *std::move(expression);
    made.width = part.width;
    made.zeros = part.zeros;
    made.decimals = part.decimals;
  }
  if (const auto slip = check_tex(*text)) return fail(*slip);
  return result;
}

std::optional<std::vector<std::vector<std::string>>> Builder::read_name_rows(const Value& value) {
  std::vector<std::vector<std::string>> rows;
  if (value.is_sequence()) {
    for (const Value& row : value.items) {
      if (!row.is_sequence()) {
        diagnostics_.error(row.place, fmt::format("expected a row of names, found {}", kind_name(row)),
                           "rows are lists in a list: [[front, side], [top, empty]]");
        return std::nullopt;
      }
      std::vector<std::string>& names = rows.emplace_back();
      for (const Value& item : row.items) {
        const auto name = read_reference(item);
        if (!name) {
          report(diagnostics_, item, name.slip());
          return std::nullopt;
        }
        names.push_back(*name);
      }
    }
  }
  if (rows.empty()) {
    diagnostics_.error(value.place, "expected rows of names", "for example [[front, side], [top, empty]]");
    return std::nullopt;
  }
  return rows;
}

}  // namespace lekalo::render
