// Maps of declared fields: unknown, missing and default ones, conditions between them.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "geometry/expression/nearest_name.h"
#include "render/scene/build/builder.h"
#include "render/scene/values/scalars.h"
#include "render/scene/values/synonyms.h"
#include "render/scene/values/value_text.h"
#include "render/scene/values/words.h"

namespace lekalo::render {

using geometry::Kind;

const Value& Builder::default_value(const std::string& text) {
  auto [found, fresh] = default_values_.try_emplace(text);
  if (fresh) {
    Diagnostics own;
    Value document = read_document(make_source("(default)", "x: " + text + "\n"), own);
    if (const Value* value = document.find("x"); value && !own.has_errors()) found->second = *value;
  }
  return found->second;
}

namespace {

// What a map has under a name, a list under a number. A single value stands for a list of one.
const Value* item_of(const Value& value, std::string_view name) {
  size_t index = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
  if (error != std::errc() || end != name.data() + name.size()) return value.find(name);
  if (!value.is_sequence()) return index == 0 ? &value : nullptr;
  const bool repeats = std::any_of(value.items.begin(), value.items.end(),
                                   [](const Value& item) { return item.is_map() && item.find("repeat"); });
  return repeats || index >= value.items.size() ? nullptr : &value.items[index];
}

}  // namespace

const Place& Builder::place_of_field(const Value& map, std::string_view path) {
  const Value* place = &map;
  while (!path.empty()) {
    const size_t dot = std::min(path.find('.'), path.size());
    const Value* next = item_of(*place, path.substr(0, dot));
    if (!next) break;
    place = next;
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return place->place;
}

std::optional<std::any> Builder::read_group(const FieldType& type, const Value& map, const Counters& counters,
                                            const std::string& what) {
  auto fields = read_fields(*type.fields, map, counters, what);
  return fields ? std::optional<std::any>(*std::move(fields)) : std::nullopt;
}

bool Builder::read_field(const Field& field, const Value& value, const Counters& counters, Fields& fields) {
  if (!field.type.per_direction) {
    auto result = field.type.kind == Kind::group && value.is_map()
                      ? read_group(field.type, value, counters, "'" + field.name + "'")
                      : read(field.type, value, counters);
    if (!result) return false;
    if (auto* style = std::any_cast<StyleChanges>(&*result); style && !field.default_text.empty())
      if (const auto base = read(field.type, default_value(field.default_text), {}))
        if (const auto* usual = std::any_cast<StyleChanges>(&*base)) {
          // An inline style changes the one that the field has by default; with a named one heads stay.
          if (value.is_map() && !value.find("like")) {
            StyleChanges changed{{}, usual->fields};
            changed.fields.override_by(style->fields);
            *style = changed;
          } else if (usual->fields.has("arrows") && !style->fields.has("arrows")) {
            style->fields.set("arrows", usual->fields.text("arrows"));
          }
        }
    fields.set(field.name, *std::move(result));
    // What is asked for by its name; whoever is built of the fields finds what is said.
    if (field.name == "attribute") {
      attributes();
      fields.set("attribute.table", std::shared_ptr<const AttributeTable>(attributes_));
    }
    if (field.type.kind == Kind::anchor && is_selector(value))
      fields.set(field.name + ".spots", spots_of(value, counters));
    return true;
  }
  // One value for both directions, or { u:, v: }.
  const Value* u = value.is_map() ? value.find("u") : nullptr;
  const Value* v = value.is_map() ? value.find("v") : nullptr;
  if (u || v) {
    if (!u || !v || value.entries.size() != 2) {
      diagnostics_.error(value.place,
                         fmt::format("'{}' takes one value for both directions, or {{ u: ..., v: ... }}", field.name));
      return false;
    }
  } else if (value.is_sequence() && (field.type.kind == Kind::number || field.type.kind == Kind::integer)) {
    const bool is_pair = value.items.size() == 2 && value.items[0].is_scalar() && value.items[1].is_scalar();
    diagnostics_.error(
        value.place, fmt::format("'{}' takes one value for both directions, or one for each", field.name),
        is_pair ? fmt::format("write {}: {{ u: {}, v: {} }}", field.name, value.items[0].text, value.items[1].text)
                : fmt::format("write {}: {{ u: ..., v: ... }}", field.name));
    return false;
  } else {
    u = v = &value;
  }
  auto a = read(field.type, *u, counters);
  auto b = u == v ? a : read(field.type, *v, counters);
  if (!a || !b) return false;
  fields.set(field.name + ".u", *std::move(a));
  fields.set(field.name + ".v", *std::move(b));
  return true;
}

std::optional<Fields> Builder::read_fields(const std::vector<Field>& declared, const Value& map,
                                           const Counters& counters, const std::string& what,
                                           const std::vector<std::string>& also_allowed) {
  Fields fields;
  return read_fields_into(fields, declared, map, counters, what, also_allowed) ? std::optional(std::move(fields))
                                                                               : std::nullopt;
}

bool Builder::read_fields_into(Fields& fields, const std::vector<Field>& declared, const Value& map,
                               const Counters& outer, const std::string& what,
                               const std::vector<std::string>& also_allowed) {
  bool good = true;
  Counters counters = outer;
  const bool has_formulas = takes_abbreviations(declared);
  if (const Value* let = has_formulas ? map.find("let") : nullptr) {
    if (let->is_map())
      counters.abbreviations = let;
    else
      diagnostics_.error(let->place, fmt::format("expected a map of names to formulas, found {}", kind_name(*let)),
                         "write for instance: let: { w: sqrt(1 + t^2) }");
  }
  std::set<std::string> misspelt;  // fields that unknown ones were probably meant to be: not missing as well
  const auto is_declared = [&](const std::string& name) {
    return std::any_of(declared.begin(), declared.end(), [&](const Field& f) { return f.name == name; });
  };
  const bool has_frame =
      std::any_of(declared.begin(), declared.end(), [](const Field& f) { return f.type.kind == Kind::frame; });
  for (const Entry& entry : map.entries) {
    const std::string& name = entry.key.name;
    if (is_declared(name) || std::find(also_allowed.begin(), also_allowed.end(), name) != also_allowed.end()) continue;
    if (has_formulas && name == "let") continue;
    if (has_frame && (name == "center" || name == "normal" || name == "axis")) continue;
    std::vector<std::string> known;
    for (const Field& field : declared) known.push_back(field.name);
    if (has_frame) known.insert(known.end(), {"center", "normal", "axis"});
    if (has_formulas) known.emplace_back("let");
    known.insert(known.end(), also_allowed.begin(), also_allowed.end());
    auto meant = geometry::nearest_name(name, known);
    // Elsewhere the same may have another name altogether.
    if (const std::string_view called = field_called(name, known); !called.empty()) meant = std::string(called);
    diagnostics_.error(entry.key.place,
                       fmt::format("unknown field '{}' of {}{}", name, what,
                                   meant ? fmt::format(" (did you mean '{}'?)", *meant) : ""),
                       meant ? "" : "it has " + listed(known, 30));
    if (meant) misspelt.insert(*meant);
    good = false;
  }
  for (const Field& field : declared) {
    const Value* value = map.find(field.name);
    if (field.type.kind == Kind::frame) {
      const auto frame = read_short_frame(map, value, counters);
      if (frame)
        fields.set(field.name, *frame);
      else
        good = false;
      continue;
    }
    if (value) {
      fields.set_given(field.name);
      const bool read = read_field(field, *value, counters, fields);
      if (read && field.type.kind == Kind::references && fields.holds<std::vector<std::any>>(field.name))  // no word
        fields.set(field.name + ".names", names_of_references(*value, counters, field.type.categories));
      // Operands give their names to the faces of what is made of them.
      if (read && field.type.kind == Kind::reference && value->is_scalar() && !field.type.categories.empty() &&
          field.type.categories.front() == Category::body && !fields.holds<std::string>(field.name))
        fields.set(field.name + ".names", names_of_references(*value, counters, field.type.categories));
      good = read && good;
    } else if (!field.default_text.empty()) {
      good = read_field(field, default_value(field.default_text), {}, fields) && good;
    } else if (field.required) {
      if (!misspelt.contains(field.name))
        diagnostics_.error(map.place, fmt::format("missing field '{}' of {}", field.name, what),
                           field.description == field.name
                               ? fmt::format("{}: {}", field.name, value_text(field.type))
                               : fmt::format("{}: {} ({})", field.name, field.description, value_text(field.type)));
      good = false;
    }
  }
  return good;
}

bool Builder::check(const TypeDeclaration& type, const Fields& fields, const Value& map) {
  bool good = true;
  for (const TypeDeclaration::Check& check : type.checks) {
    auto parsed = Expression::parse(check.condition);
    auto* expression = std::get_if<Expression>(&parsed);
    if (!expression) throw std::logic_error("check '" + check.condition + "' of " + type.name + " is no formula");
    std::vector<Expression::Constant> values;
    bool complete = true;
    for (const std::string& name : expression->names()) {
      if (fields.holds<double>(name))
        values.push_back({name, fields.number(name), geometry::Measure::plain, false});
      else if (fields.holds<int>(name))
        values.push_back({name, static_cast<double>(fields.integer(name)), geometry::Measure::plain, false});
      else
        complete = false;
    }
    if (!complete) continue;
    if (expression->bind({}, values)) throw std::logic_error("check '" + check.condition + "' cannot be bound");
    if ((*expression)() != 0) continue;
    const std::string& first = expression->names().front();
    const Value* given = map.find(first);
    diagnostics_.error(given ? given->place : map.place, check.message, "must hold: " + check.condition);
    good = false;
  }
  return good;
}

}  // namespace lekalo::render
