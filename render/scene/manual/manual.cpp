#include "render/scene/manual/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/expression/function_list.h"
#include "render/model/styles.h"
#include "render/scene/types/sections.h"
#include "render/scene/values/value_text.h"
#include "render/scene/values/words.h"
#include "render/suite/suite.h"

namespace lekalo::render {

using geometry::Dimension;
using geometry::Field;
using geometry::FieldType;
using geometry::Kind;

namespace {

// A value that the field accepts, as short as possible. Points differ from those before them, which `places` counts.
std::string sample(const FieldType& type, int& places) {
  const auto list = [&](int least, const auto& item) {
    std::string text;
    for (int k = 0; k < std::max(least, type.minimum_count); ++k) text += (k ? ", " : "") + item(k);
    return fmt::format("[{}]", text);
  };
  const auto point = [](int k) { return fmt::format("[{}, {}]", k, k * k); };
  switch (type.kind) {
    case Kind::number:
      if (type.dimension == Dimension::angle) return "30";
      return type.minimum <= 1 && type.maximum >= 1 ? "1" : fmt::format("{:.9g}", std::max(type.minimum, -1e9));
    case Kind::integer:
      return fmt::format("{}", static_cast<int>(std::clamp(3.0, type.minimum, type.maximum)));
    case Kind::boolean:
      return "true";
    case Kind::choice:
    case Kind::words:
      return type.choices.front();
    case Kind::text:
    case Kind::texts:
      return "'text'";
    case Kind::command:
      return "[program]";
    case Kind::file:
      return "file.txt";
    case Kind::name:
      return "name";
    case Kind::point:
    case Kind::anchor: {
      constexpr const char* kCorners[] = {"[0, 0, 0]", "[1, 0, 0]", "[0, 1, 0]"};
      return kCorners[places++ % 3];
    }
    case Kind::vector:
      return "[0, 0, 1]";
    case Kind::direction:
    case Kind::axis:
      return "z";
    case Kind::frame:
      return "{ origin: [0, 0, 0], z: z }";
    case Kind::range:
      return "[0, 1]";
    case Kind::rectangle:
      return "{ u: [0, 1], v: [0, 1] }";
    case Kind::points:
    case Kind::points2:
      return list(3, point);
    case Kind::net:
      return "[[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 1]]]";
    case Kind::numbers:
      return list(1, [](int) { return std::string("1"); });
    case Kind::number_grid:
      return "[[1, 1], [1, 1]]";
    case Kind::indices:
      return "[[0, 1, 2]]";
    case Kind::knots:
      return "clamped";
    case Kind::color:
      return "steelblue";
    case Kind::formula:
      return type.variables.front();
    case Kind::formulas:
      return list(1, [&](int) { return type.variables.front(); });
    case Kind::reference:
    case Kind::references:
      // Objects have no names to refer to: they are written out.
      return type.categories.front() == geometry::Category::object
                 ? "[{ shape: my_body }]"
                 : fmt::format("my_{}", geometry::name(type.categories.front()));
    case Kind::group:
    case Kind::groups: {
      std::string text;
      for (const Field& field : *type.fields)
        if (field.required)
          text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", field.name, sample(field.type, places));
      return fmt::format("{{ {} }}", text);
    }
    case Kind::transform:
      return "{ rotate: 30, axis: z }";
    case Kind::page_length:
      return "5 mm";
    case Kind::picture_size:
      return "[960, 720]";
    case Kind::page_lengths:
      return "[2 mm, 1 mm]";
    case Kind::counts:
      return "9";
    case Kind::label:
      return "'$p$'";
    case Kind::labels:
      return "['$x$', '$y$']";
    case Kind::name_rows:
      return "[[front, top]]";
    case Kind::helpers:
      return "{ control_polygon: {} }";
  }
  return "";
}

const char* need(const Field& field) { return field.required && field.default_text.empty() ? "needed" : "optional"; }

// In a table of Markdown a bar ends the cell.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string table(const std::vector<Field>& fields, const std::string& prefix = "") {
  std::string text;
  if (prefix.empty()) text = "| field | value | default | meaning |\n| --- | --- | --- | --- |\n";
  for (const Field& field : fields) {
    const std::string value = !field.default_text.empty() ? fmt::format("`{}`", field.default_text)
                              : field.required            ? "needed"
                                                          : "";
    text += fmt::format("| `{}{}` | {} | {} | {} |\n", prefix, field.name, cell(value_text(field.type)), cell(value),
                        cell(field.description));
    if (field.type.fields) text += table(*field.type.fields, prefix + field.name + ".");
  }
  return text;
}

std::string lines_of(const std::vector<Field>& fields, const std::string& indent) {
  std::string text;
  for (const Field& field : fields) {
    text += fmt::format("{}{:<16} {}; {}\n", indent, field.name, value_text(field.type),
                        field.default_text.empty() ? need(field) : "default " + field.default_text);
    text += fmt::format("{}{:<16}   {}\n", indent, "", field.description);
    if (field.type.fields) text += lines_of(*field.type.fields, indent + "    ");
  }
  return text;
}

// The file of the picture that tools/figures makes of its example, drawn or rendered; empty of what comes from outside,
// and of what has no end.
std::string picture_of(const TypeDeclaration& type) {
  using enum Category;
  static constexpr std::array kDrawn = {curve, surface, body, shape, mesh};
  static constexpr std::array kRendered = {material, texture, light, camera, integrator};
  if (std::ranges::count(kRendered, type.category) != 0)
    return type.name == "graph" ? "" : fmt::format("{}_{}.png", geometry::name(type.category), type.name);
  const bool is_drawn = std::ranges::count(kDrawn, type.category) != 0 && type.name != "half_space" &&
                        !type.name.starts_with("external_") &&
                        std::ranges::none_of(type.fields, [](const Field& field) {
                          return field.type.kind == geometry::Kind::file && field.required;
                        });
  return is_drawn ? type.name + ".svg" : std::string();
}

std::string page_of(Category category) {
  const std::string title = plural(category);
  std::string text =
      fmt::format("# {}{}\n\nMade by `lekalo types --markdown`; the same text for one type: `lekalo types NAME`.\n",
                  static_cast<char>(std::toupper(title[0])), title.substr(1));
  if (const auto common = common_fields(category); !common.empty())
    text += "\nEvery type here also takes:\n\n" + table(common);
  for (const TypeDeclaration& type : all_types()) {
    if (type.category != category) continue;
    text += fmt::format("\n## {}\n\n{}\n\n    {}\n\n", type.name, type.description, example_of(type));
    if (const std::string picture = picture_of(type); !picture.empty())
      text += fmt::format("![{}](images/{})\n\n", type.name, picture);
    text += table(type.fields);
    if (takes_abbreviations(type.fields)) text += fmt::format("| `let` | map of formulas |  | {} |\n", kLetDescription);
    if (!type.checks.empty()) text += "\n";
    for (const auto& check : type.checks) text += fmt::format("Must hold: `{}`.\n", check.condition);
    if (const auto helpers = helpers_of(type); !helpers.empty())
      text += fmt::format("\nHelpers for `show`: {}.\n", listed(helpers));
  }
  return text;
}

std::string page_of_sections() {
  std::string text =
      "# Sections of a scene file\n\nMade by `lekalo types --markdown`. A scene file is a map of these sections; "
      "only `lekalo` is needed.\n";
  for (const SectionDeclaration& section : sections()) {
    text += fmt::format("\n## {}\n\n{}{}.\n", section.name, static_cast<char>(std::toupper(section.description[0])),
                        section.description.substr(1));
    using Shape = SectionDeclaration::Shape;
    if (!section.categories.empty()) {
      std::string pages;
      for (const Category category : section.categories) {
        if (type_names({&category, 1}).empty()) continue;
        pages += fmt::format("{}[{}]({}.md)", pages.empty() ? "" : ", ", plural(category), plural(category));
      }
      text += fmt::format("\n{}: {}.\n",
                          section.shape == Shape::named     ? "A map of names to things"
                          : section.shape == Shape::numbers ? "A map of names to numbers, formulas or quantities"
                          : section.shape == Shape::things  ? "A list of"
                                                            : "One of",
                          pages);
    }
    if (section.shape == Shape::list) text += "\nA list of maps, or one:\n";
    if (!section.fields.empty()) text += fmt::format("\n{}", table(section.fields));
  }
  return text;
}

std::string page_of_formulas() {
  std::string text =
      "# Formulas\n\nMade by `lekalo types --markdown`; the same text: `lekalo types formulas`. Every number of a "
      "scene "
      "may be a formula of parameters and counters; curves and surfaces by formulas have variables besides.\n\n"
      "`a + b`, `a - b`, `a * b` (never left out), `a / b`, `a ^ b`; `a if c else b`; `== != < <= > >=`, `and`, `or`, "
      "`not`; `pi`; the units `deg`, `rad`, `turn` behind a number or parentheses. In an angle field a plain number is "
      "degrees.\n\n| function | meaning |\n| --- | --- |\n";
  for (const std::string_view function : geometry::function_descriptions()) {
    const std::string line(function);
    const size_t colon = line.find(": ");
    text += fmt::format("| `{}` | {} |\n", line.substr(0, colon), cell(line.substr(colon + 2)));
  }
  return text;
}

std::string page_of_suites() {
  std::string text =
      "# Regression suites\n\nMade by `lekalo types --markdown`. A suite is a map of these sections, run by `lekalo "
      "test`; "
      "its first key is `lekalo_suite: 1`. [Regression](../regression.md) tells how to work with it.\n";
  for (const SuiteSection& section : suite_sections()) {
    text += fmt::format("\n## {}\n\n{}{}.\n", section.name, static_cast<char>(std::toupper(section.description[0])),
                        section.description.substr(1));
    if (section.name == "tests")
      text +=
          "\nA list of maps. `repeat` makes many of one; `%k`, `%02k`, `%(k+1)` in texts stand for its counters. "
          "`set` is a map of parameters of the scene, formulas may use the counters.\n";
    if (!section.fields.empty()) text += fmt::format("\n{}", table(section.fields));
  }
  return text;
}

}  // namespace

std::string example_of(const TypeDeclaration& type) {
  std::string text;
  int places = 0;
  const auto add = [&](const std::string& name, const std::string& value) {
    text += fmt::format("{} {}: {}", text.empty() ? "{" : ",", name, value);
  };
  if (!is_implicit(type.category) && type.category != Category::helper) add("type", type.name);
  if (!type.example_fields.empty())
    text += (text.empty() ? "{ " : ", ") + type.example_fields;
  else
    for (const Field& field : type.fields)
      if (field.required && field.default_text.empty() && field.type.kind != Kind::frame)
        add(field.name, sample(field.type, places));
  text += text.empty() ? "{}" : " }";
  return type.category == Category::helper ? type.name + ": " + text : text;
}

const std::vector<Category>& categories_of_manual() {
  static const std::vector<Category> categories = [] {
    std::vector<Category> some;
    for (int k = 0; k <= static_cast<int>(Category::panel); ++k) {
      const auto category = static_cast<Category>(k);
      if (!type_names({&category, 1}).empty()) some.push_back(category);
    }
    return some;
  }();
  return categories;
}

std::string plural(Category category) {
  const std::string name(geometry::name(category));
  if (category == Category::body) return "bodies";
  if (category == Category::mesh) return "meshes";
  if (category == Category::quantity) return "quantities";
  return name + "s";
}

std::string list_of_types() {
  std::string text;
  for (const Category category : categories_of_manual()) {
    text += fmt::format("{}{}\n", text.empty() ? "" : "\n", plural(category));
    for (const TypeDeclaration& type : all_types())
      if (type.category == category) {
        // The first sentence.
        const size_t end = type.description.find(". ");
        text += fmt::format("  {:<24} {}\n", type.name, type.description.substr(0, end));
      }
  }
  return text;
}

std::string description_of(const TypeDeclaration& type) {
  std::string text = fmt::format("{} ({})\n  {}\n\n  {}\n", type.name, geometry::name(type.category), type.description,
                                 example_of(type));
  if (!type.fields.empty()) text += "\nfields\n" + lines_of(type.fields, "  ");
  if (takes_abbreviations(type.fields))
    text += fmt::format("  {:<16} map of formulas; optional\n  {:<16}   {}\n", "let", "", kLetDescription);
  if (const auto common = common_fields(type.category); !common.empty())
    text += fmt::format("\nfields of every {}\n{}", geometry::name(type.category), lines_of(common, "  "));
  for (const auto& check : type.checks) text += fmt::format("\nmust hold: {}\n", check.condition);
  if (const auto helpers = helpers_of(type); !helpers.empty())
    text += fmt::format("\nhelpers for show: {}\n", listed(helpers));
  return text;
}

std::string description_of_section(std::string_view name) {
  for (const SectionDeclaration& section : sections()) {
    if (section.name != name) continue;
    std::string text =
        fmt::format("{} (section)\n  {}{}.\n", section.name, static_cast<char>(std::toupper(section.description[0])),
                    section.description.substr(1));
    std::vector<std::string> types = type_names(section.categories);
    if (!types.empty()) text += fmt::format("\ntypes\n  {}\n", listed(types));
    if (!section.fields.empty()) text += "\nfields\n" + lines_of(section.fields, "  ");
    return text;
  }
  return {};
}

std::string description_of_formulas() {
  std::string text =
      "formulas\n  Numbers are written as formulas: + - * / ^, a if c else b, comparisons, and, or, not; pi; the units "
      "deg, rad, turn.\n  In an angle field a plain number is degrees.\n\nfunctions\n";
  for (const std::string_view line : geometry::function_descriptions()) text += fmt::format("  {}\n", line);
  return text;
}

std::string description_of_repeat() {
  return "repeat\n"
         "  A key that makes many of one: the rest of the map is the template.\n\n"
         "  { repeat: { i: 0..5 }, type: ball, center: [i, 0, 0], radius: 0.2 }\n\n"
         "  { i: 0..n-1 }          whole numbers, both ends among them; the ends are formulas\n"
         "  { i: [1, 2, 5] }       these numbers\n"
         "  { i: 0..2, j: 0..3 }   two counters: rows, j runs within i\n\n"
         "  A named one is a family: `hole` means all members, `hole.3` one, `hole.1.2` one of two counters,\n"
         "  `hole.side` the side of each. Members are numbered from 0, whatever the counters' values.\n"
         "  In texts %i is the counter, %02i with zeros, %(2*i+1) a formula.\n"
         "  It works in lists (objects, annotations, points, outputs), named sections, and rows of nets\n"
         "  ({ repeat: { i: 0..5 }, row: [..] }).\n";
}

std::string description_of_style(std::string_view name) {
  const std::string_view all = built_in_styles();
  for (size_t begin = 0; begin < all.size();) {
    const size_t end = std::min(all.find('\n', begin), all.size());
    const std::string_view line = all.substr(begin, end - begin);
    begin = end + 1;
    if (!line.starts_with(name) || line.substr(name.size(), 1) != ":") continue;
    const size_t value = line.find('{');
    return fmt::format("{} (built-in style)\n  {}\n  Given under `styles` it is changed, field by field, everywhere.\n",
                       name, line.substr(value));
  }
  return {};
}

namespace {

std::string page_of_repeat() {
  const std::string text = description_of_repeat();
  return "# repeat\n\n```\n" + text.substr(text.find('\n') + 1) + "```\n";
}

std::string page_of_built_in_styles() {
  return "# Built-in styles\n\nGiven under `styles` they are changed, field by field, everywhere; `like: thin` copies "
         "one.\n\n```yaml" +
         std::string(built_in_styles()) + "```\n";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> reference_pages() {
  std::vector<std::pair<std::string, std::string>> pages{{"sections.md", page_of_sections()},
                                                         {"formulas.md", page_of_formulas()},
                                                         {"suites.md", page_of_suites()},
                                                         {"repeat.md", page_of_repeat()},
                                                         {"built_in_styles.md", page_of_built_in_styles()}};
  for (const Category category : categories_of_manual()) pages.push_back({plural(category) + ".md", page_of(category)});
  return pages;
}

}  // namespace lekalo::render
