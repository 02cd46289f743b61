// One value by the kind of its field.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/scene/build/builder.h"
#include "render/scene/values/scalars.h"
#include "render/scene/values/words.h"

namespace lekalo::render {

using geometry::Kind;

namespace {

std::string hint_of_fields(const std::vector<Field>& fields) {
  constexpr size_t kMaxFields = 12;
  std::vector<std::string> names;
  for (const Field& field : fields) names.push_back(field.name);
  return "its fields are " + listed(names, kMaxFields);
}

}  // namespace

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

bool is_outside(const FieldType& type, double x) {
  return x < type.minimum || x > type.maximum || (type.minimum_excluded && x == type.minimum) ||
         (type.maximum_excluded && x == type.maximum);
}

bool is_word(const FieldType& type, const Value& value) {
  return value.is_scalar() && std::find(type.choices.begin(), type.choices.end(), value.text) != type.choices.end();
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

void Builder::each_item(const Value& value, const Counters& counters,
                        const std::function<void(const Value& item, const Counters& inner)>& visit) {
  const auto add = [&](const Value& item) {
    if (item.is_map() && item.find("repeat"))
      repeat(item, counters, [&](const Counters& inner, const std::string&) { visit(item, inner); });
    else
      visit(item, counters);
  };
  if (!value.is_sequence()) return add(value);
  for (const Value& item : value.items) add(item);
}

const Value& Builder::row_of(const Value& value) {
  const Value* row = value.is_map() && value.entries.size() == 2 && value.find("repeat") ? value.find("row") : nullptr;
  return row ? *row : value;
}

std::vector<Scoped> Builder::items(const Value& value, const Counters& counters) {
  std::vector<Scoped> all;
  each_item(value, counters, [&](const Value& item, const Counters& inner) { all.push_back({&item, inner}); });
  return all;
}

template <class T>
std::optional<std::vector<T>> Builder::read_list(const FieldType& type, const Value& value, const Counters& counters) {
  std::vector<T> all;
  bool good = true;
  for (const Scoped& item : items(value, counters)) {
    auto one = read(type, *item.value, item.counters);
    if (one)
      all.push_back(std::any_cast<T>(*std::move(one)));
    else
      good = false;
  }
  return good ? std::optional(std::move(all)) : std::nullopt;
}

std::optional<std::vector<std::string>> Builder::read_command(const Value& value, const Counters& counters) {
  std::vector<std::string> words;
  for (const Scoped& item : items(value, counters)) {
    const auto word = read_text(*item.value);
    if (!word) {
      report(diagnostics_, *item.value, word.slip());
      return std::nullopt;
    }
    const auto& file = item.value->place.file;
    // A program without a slash is looked for in PATH.
    const bool may_be_file = !words.empty() || word->find('/') != std::string::npos;
    const auto path = file && may_be_file ? find_input(*file, *word, {}) : std::nullopt;
    std::error_code ignored;
    const bool is_file = path && std::filesystem::is_regular_file(*path, ignored);
    if (words.empty() && may_be_file && !is_file) {
      diagnostics_.error(item.value->place, fmt::format("there is no program '{}'", *word),
                         "looked for beside the scene file; names without a slash are looked for in PATH");
      return std::nullopt;
    }
    if (is_file) files_named_.push_back(*path);
    words.push_back(is_file ? std::filesystem::absolute(*path).string() : *word);
  }
  if (!words.empty() && !words.front().empty()) return words;
  diagnostics_.error(value.place, "a command begins with a program", "write [program, argument, ...]");
  return std::nullopt;
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
  const auto unknown_word = [&]() -> std::optional<std::any> {
    diagnostics_.error(
        value.place,
        value.is_scalar() ? fmt::format("unknown word '{}'{}", value.text, suggestion(value.text, type.choices))
                          : fmt::format("expected a word, found {}", kind_name(value)),
        fmt::format("one of {}{}", listed(type.choices),
                    type.kind == Kind::reference ? fmt::format(", or the name of {}", describe(type.categories)) : ""));
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
      if (is_outside(type, *n)) {
        diagnostics_.error(value.place, fmt::format("expected a value {}, found {}", range_text(type, 1), *n));
        return std::nullopt;
      }
      return std::any(*n);
    }
    case Kind::boolean:
      return wrap_reading(read_boolean(value));
    case Kind::choice:
      if (is_word(type, value)) return std::any(value.text);
      return unknown_word();
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
      std::error_code ignored;
      if (!std::filesystem::is_regular_file(*path, ignored)) {
        diagnostics_.error(value.place, fmt::format("'{}' is no regular file", *name),
                           "a pipe or a folder cannot be read");
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
      return wrap(read_interval(type, value, counters));
    case Kind::rectangle: {
      const Value* u = value.find("u");
      const Value* v = value.find("v");
      if (!value.is_map() || !u || !v || value.entries.size() != 2) {
        diagnostics_.error(value.place, "expected the two ranges of a part of the parameter plane",
                           "write { u: [from, to], v: [from, to] }");
        return std::nullopt;
      }
      const auto a = read_interval(type, *u, counters);
      const auto b = read_interval(type, *v, counters);
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
        auto list = read_list<int>(geometry::integer(), row_of(*row.value), row.counters);
        if (!list) return std::nullopt;
        lists.push_back(*std::move(list));
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
      // A style with what goes with it: { style: thick, hidden: dashed }.
      if (type.fields && value.is_map() &&
          std::ranges::any_of(*type.fields, [&](const Field& field) { return value.find(field.name) != nullptr; }))
        return read_group(type, value, counters, "this map");
      // A slip in one of the words, where nothing has that name, nor one like it.
      if (value.is_scalar() && !type.choices.empty() && !read_number(value)) {
        const Value* names = section(section_of(type.categories.front()));
        std::vector<std::string> known;
        if (names)
          for (const Entry& entry : names->entries) known.push_back(entry.key.name);
        if (!suggestion(value.text, type.choices).empty() || suggestion(value.text, known).empty())
          if (!names || !find_named(*names, value.text, value.place.file ? value.place.file->scope : "").entry)
            return unknown_word();
      }
      auto built = refer(value, counters, type.categories);
      if (!built) return std::nullopt;
      return built->value;
    }
    case Kind::references: {
      auto all = refer_all(value, counters, type.categories);
      if (!all || !check_count(type, value, all->size())) return std::nullopt;
      return std::any(*std::move(all));
    }
    case Kind::group:
      if (value.is_map()) return read_group(type, value, counters, "this map");
      if (value.is_scalar() && !type.choices.empty()) return unknown_word();
      diagnostics_.error(value.place, fmt::format("expected a map of fields, found {}", kind_name(value)),
                         hint_of_fields(*type.fields));
      return std::nullopt;
    case Kind::groups: {
      std::vector<Fields> all;
      for (const Scoped& item : items(value, counters)) {
        if (!item.value->is_map()) {
          diagnostics_.error(item.value->place,
                             fmt::format("expected a map of fields, found {}", kind_name(*item.value)),
                             hint_of_fields(*type.fields));
          return std::nullopt;
        }
        auto one = read_fields(*type.fields, *item.value, item.counters, "this map", {"repeat"});
        if (!one) return std::nullopt;
        all.push_back(*std::move(one));
      }
      if (!check_count(type, value, all.size())) return std::nullopt;
      return std::any(all);
    }
    case Kind::transform:
      return wrap(read_transform(value, counters));
    case Kind::page_length:
      return wrap(read_page_length_by(type, value));
    case Kind::page_lengths: {
      FieldType one = type;
      one.kind = Kind::page_length;
      auto all = read_list<double>(one, value, counters);
      if (!all || !check_count(type, value, all->size())) return std::nullopt;
      return std::any(*std::move(all));
    }
    case Kind::picture_size:
      return wrap(read_picture_size(value, counters));
    case Kind::texts: {
      std::vector<std::string> all;
      for (const Scoped& item : items(value, counters)) {
        const Value& text = with_counters(*item.value, item.counters);
        if (text.invalid) return std::nullopt;
        const auto one = read_quoted_text(text);
        if (!one) {
          report(diagnostics_, text, one.slip());
          return std::nullopt;
        }
        all.push_back(*one);
      }
      if (!check_count(type, value, all.size())) return std::nullopt;
      return std::any(all);
    }
    case Kind::command:
      return wrap(read_command(value, counters));
    case Kind::words: {
      FieldType one = type;
      one.kind = Kind::choice;
      return wrap(read_list<std::string>(one, value, counters));
    }
    case Kind::anchor:
      return wrap(read_anchor(value, counters));
    case Kind::counts:
      return wrap(read_counts(type, value, counters));
    case Kind::label:
      return wrap(read_label(type, value, counters));
    case Kind::labels: {
      FieldType one = type;
      one.kind = Kind::label;
      auto all = read_list<TextTemplate>(one, value, counters);
      if (!all || !check_count(type, value, all->size())) return std::nullopt;
      return std::any(*std::move(all));
    }
    case Kind::name_rows:
      return wrap(read_name_rows(value));
    case Kind::helpers:
      return wrap(read_helpers(value, counters));
  }
  return std::nullopt;
}

}  // namespace lekalo::render
