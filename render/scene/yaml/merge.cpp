// Merging sections.
#include "render/scene/yaml/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <unordered_map>

#include "render/model/styles.h"
#include "render/scene/values/types.h"

namespace lekalo::render {

namespace {

constexpr std::array<std::string_view, 6> kNamedSections{"geometry", "materials", "lights",
                                                         "styles",   "panels",    "parameters"};
constexpr std::array<std::string_view, 3> kListSections{"attributes", "objects", "outputs"};
template <std::size_t n>
bool is_one_of(const std::array<std::string_view, n>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// Who meets whom.
struct Rule {
  bool siblings;                       // both from included files: neither is nearer to the scene
  const Value* overriding_parameters;  // parameters that make a conflict of siblings harmless; may be null
};

void given_twice(const Entry& first, const Entry& second, const std::string& section, Diagnostics& diagnostics) {
  diagnostics.error(
      second.key.place,
      fmt::format("'{}' is given twice in '{}': here and in {}", second.key.name, section, where(first.key.place)),
      fmt::format("rename one, or include the other file with 'as: PREFIX', which makes it PREFIX.{}", second.key.name),
      {Diagnostics::note(first.key.place, "the other is here")});
}

// Both as lists, one behind the other.
void append(Value& base, Value&& over) {
  const auto listed = [](Value&& value) {
    if (value.is_sequence()) return std::move(value);
    Value list;
    list.kind = Value::Kind::sequence;
    list.place = value.place;
    if (!value.invalid) list.items.push_back(std::move(value));
    return list;
  };
  Value list = listed(std::move(base));
  Value more = listed(std::move(over));
  list.place = more.place;  // of the including file: errors about the list as a whole belong there
  std::move(more.items.begin(), more.items.end(), std::back_inserter(list.items));
  base = std::move(list);
}

// Key by key, the entries of `over` win; `annotations` lists append.
void merge_keys(Value& base, Value&& over) {
  base.place = over.place;
  for (Entry& entry : over.entries) {
    const auto old = std::find_if(base.entries.begin(), base.entries.end(),
                                  [&](const Entry& e) { return e.key.name == entry.key.name; });
    if (old == base.entries.end())
      base.entries.push_back(std::move(entry));
    else if (entry.key.name == "annotations")
      append(old->value, std::move(entry.value));
    else
      *old = std::move(entry);
  }
}

// What an included camera says about its kind and place gives way to what the nearer one says in other words.
void give_way(Value& camera, const Value& nearer) {
  const auto type_of = [](const Value& c) {
    const Value* type = c.find("type");
    return type ? type->text : default_camera_type(c);
  };
  if (nearer.find("type") && type_of(camera) != type_of(nearer)) camera.entries.clear();
  constexpr std::array<std::string_view, 2> kPlace{"from", "at"};
  constexpr std::array<std::string_view, 3> kFraming{"view", "frame", "margin"};
  std::erase_if(camera.entries, [&](const Entry& e) {
    return (nearer.find("view") && is_one_of(kPlace, e.key.name)) ||
           (nearer.find("from") && is_one_of(kFraming, e.key.name));
  });
}

void merge_named(Value& base, Value&& over, const std::string& section, const Rule& rule, Diagnostics& diagnostics) {
  std::unordered_map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < base.entries.size(); ++i) index.emplace(base.entries[i].key.name, i);
  base.place = over.place;
  for (Entry& entry : over.entries) {
    const auto found = index.find(entry.key.name);
    if (found == index.end()) {
      base.entries.push_back(std::move(entry));
      continue;
    }
    Entry& old = base.entries[found->second];
    const bool style = section == "styles" && is_built_in_style(entry.key.name);
    const bool decided = rule.overriding_parameters && rule.overriding_parameters->find(entry.key.name);
    if (style && old.value.is_map() && entry.value.is_map())
      merge_keys(old.value, std::move(entry.value));
    else if (style || (section == "parameters" && (!rule.siblings || decided)))
      old = std::move(entry);
    else
      given_twice(old, entry, section, diagnostics);
  }
}

// Whether both values of a section are maps; if not, says so once and marks it.
bool both_are_maps(Value& base, Value& over, const std::string& section, Diagnostics& diagnostics) {
  for (Value* value : {&base, &over}) {
    if (value->is_map()) continue;
    if (!value->invalid)
      diagnostics.error(value->place, fmt::format("'{}' is a map, not {}", section, kind_name(*value)),
                        fmt::format("write '{}:' and indent its entries below", section));
    value->invalid = true;
  }
  return base.is_map() && over.is_map();
}

void merge_section(Entry& base, Entry&& over, const Rule& rule, Diagnostics& diagnostics) {
  const std::string section = over.key.name;
  const Key key = over.key;
  if (is_one_of(kListSections, section)) {
    append(base.value, std::move(over.value));
  } else if (is_one_of(kNamedSections, section)) {
    if (both_are_maps(base.value, over.value, section, diagnostics))
      merge_named(base.value, std::move(over.value), section, rule, diagnostics);
    else if (!base.value.is_map())
      base.value = std::move(over.value);
  } else if (base.value.is_map() && over.value.is_map()) {
    if (section == "camera") give_way(base.value, over.value);
    merge_keys(base.value, std::move(over.value));
  } else {
    base.value = std::move(over.value);
  }
  base.key = key;
}

void merge_sections(Value& base, Value&& over, const Rule& rule, Diagnostics& diagnostics) {
  for (Entry& section : over.entries) {
    const auto old = std::find_if(base.entries.begin(), base.entries.end(),
                                  [&](const Entry& e) { return e.key.name == section.key.name; });
    if (old == base.entries.end())
      base.entries.push_back(std::move(section));
    else
      merge_section(*old, std::move(section), rule, diagnostics);
  }
}

}  // namespace

void prefix_names(Value& root, const std::string& prefix) {
  for (Entry& section : root.entries) {
    if (!is_one_of(kNamedSections, section.key.name)) continue;
    for (Entry& entry : section.value.entries) entry.key.name.insert(0, prefix + ".");
  }
}

void merge_sibling(Value& roots, Value&& further, const Value& including, Diagnostics& diagnostics) {
  const Value* parameters = including.find("parameters");
  merge_sections(roots, std::move(further), {true, parameters}, diagnostics);
}

Value merge_over(Value&& included, Value&& including, Diagnostics& diagnostics) {
  Value root = std::move(included);
  root.kind = Value::Kind::map;
  root.place = including.place;
  root.invalid = including.invalid;
  merge_sections(root, std::move(including), {false, nullptr}, diagnostics);
  return root;
}

}  // namespace lekalo::render
