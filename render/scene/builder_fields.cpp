// Maps of declared fields: unknown, missing and default ones, conditions between them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/scene/builder.h"
#include "render/scene/scalars.h"
#include "render/scene/words.h"

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

const Place& Builder::place_of_field(const Value& map, std::string_view path) {
  const Value* place = &map;
  while (!path.empty()) {
    const size_t dot = std::min(path.find('.'), path.size());
    const Value* next = place->find(path.substr(0, dot));
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
    // An inline style changes the one that the field has by default.
    if (std::any_cast<StyleChanges>(&*result) && value.is_map() && !value.find("like") && !field.default_text.empty()) {
      const auto base = read(field.type, default_value(field.default_text), {});
      if (const auto* style = base ? std::any_cast<StyleChanges>(&*base) : nullptr) {
        StyleChanges changed{{}, style->fields};
        changed.fields.override_by(std::any_cast<const StyleChanges&>(*result).fields);
        result = changed;
      }
    }
    fields.set(field.name, *std::move(result));
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
  bool good = true;
  const auto is_declared = [&](const std::string& name) {
    return std::any_of(declared.begin(), declared.end(), [&](const Field& f) { return f.name == name; });
  };
  const bool has_frame =
      std::any_of(declared.begin(), declared.end(), [](const Field& f) { return f.type.kind == Kind::frame; });
  for (const Entry& entry : map.entries) {
    const std::string& name = entry.key.name;
    if (is_declared(name) || std::find(also_allowed.begin(), also_allowed.end(), name) != also_allowed.end()) continue;
    if (has_frame && (name == "center" || name == "normal" || name == "axis")) continue;
    std::vector<std::string> known;
    for (const Field& field : declared) known.push_back(field.name);
    if (has_frame) known.insert(known.end(), {"center", "normal", "axis"});
    known.insert(known.end(), also_allowed.begin(), also_allowed.end());
    const std::string meant = suggestion(name, known);
    diagnostics_.error(entry.key.place, fmt::format("unknown field '{}' of {}{}", name, what, meant),
                       meant.empty() ? "it has " + listed(known, 30) : "");
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
      fields.set_written(field.name, value->is_scalar() ? value->text : std::string());
      good = read_field(field, *value, counters, fields) && good;
    } else if (!field.default_text.empty()) {
      good = read_field(field, default_value(field.default_text), {}, fields) && good;
    } else if (field.required) {
      diagnostics_.error(map.place, fmt::format("missing field '{}' of {}", field.name, what), field.description);
      good = false;
    }
  }
  return good ? std::optional(std::move(fields)) : std::nullopt;
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
