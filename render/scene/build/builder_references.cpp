// References to named things, families and their members, `like`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "geometry/expression/nearest_name.h"
#include "render/scene/build/builder.h"

#include "geometry/bodies/booleans/solid_boundary.h"
#include "render/scene/values/scalars.h"
#include "render/scene/values/words.h"

namespace lekalo::render {

using geometry::BodyPtr;

namespace {

constexpr size_t kMaxNames = 5;  // in hints

bool contains(std::span<const Category> categories, Category category) {
  return std::find(categories.begin(), categories.end(), category) != categories.end();
}

// A point on something that is none itself.
std::string hint_of_place(const std::string& name, Category category) {
  if (category == Category::curve) return fmt::format("a point on it: {{ of: {}, t: 0.5 }}", name);
  if (category == Category::surface) return fmt::format("a point on it: {{ of: {}, u: 0.5, v: 0.5 }}", name);
  return "write [x, y, z], the name of a point, or a place such as { of: curve, t: 0.5 }";
}

// { of: curve, t: 1 } and the like: a point, no thing of some type.
bool is_place(const Value& map) {
  static const std::set<std::string> known{"of", "t", "s", "u", "v", "point", "repeat"};
  return map.is_map() && map.find("of") && map.entries.size() > (map.find("repeat") ? 2u : 1u) &&
         std::all_of(map.entries.begin(), map.entries.end(),
                     [](const Entry& entry) { return known.contains(entry.key.name); });
}

bool starts_with_number(std::string_view name) { return name.front() >= '0' && name.front() <= '9'; }

// { of: c, member: i }: a member of a family, [i, j] of one in rows.
bool is_member(const Value& map) {
  const Value* of = map.is_map() && map.entries.size() == 2 ? map.find("of") : nullptr;
  return of && of->is_scalar() && map.find("member");
}

}  // namespace

// The place that a name stands for, if it is that of one.
const Scoped* Builder::named_place(const Value& name) {
  const Value* values = section("geometry");
  if (!name.is_scalar() || !values || !values->is_map()) return nullptr;
  const Named found = find_named(*values, name.text, name.place.file ? name.place.file->scope : "");
  if (!found.entry) return nullptr;
  const auto known = sections_["geometry"].find(found.entry->key.name);
  if (known == sections_["geometry"].end()) return nullptr;
  NamedThing& thing = known->second;
  for (NamedThing::Member& one : thing.members)
    if (one.name == found.member && is_place(*one.scoped.value)) {
      thing.used = thing.used || names_use_;
      return &one.scoped;
    }
  return nullptr;
}

const Value* Builder::section(const char* name) const {
  if (std::string_view(name) == "styles" && styles_.is_map()) return &styles_;
  if (std::string_view(name) == "geometry" && geometry_.is_map()) return &geometry_;
  if (const Value* written = scene_.root.find(name)) return written;
  const auto meant = misspelt_sections_.find(name);
  return meant == misspelt_sections_.end() ? nullptr : meant->second;
}

std::map<std::string, NamedThing, std::less<>>* Builder::things_of(Category category) {
  const char* name = section_of(category);
  const auto found = name ? sections_.find(name) : sections_.end();
  return found == sections_.end() ? nullptr : &found->second;
}

void Builder::declare_section(const char* name) {
  auto& things = sections_[name];
  const Value* values = section(name);
  if (!values) return;
  if (!values->is_map()) {
    if (!values->invalid)
      diagnostics_.error(values->place, fmt::format("'{}' is a map of named things", name),
                         std::string_view(name) == "lights" ? "write name: { type: ..., ... }; lights: {} means none"
                                                            : "write name: { type: ..., ... }");
    return;
  }
  const auto is_family = [](const Entry& entry) { return entry.value.is_map() && entry.value.find("repeat"); };
  for (const Entry& entry : values->entries) {
    if (is_family(entry)) continue;
    NamedThing& thing = things[entry.key.name];
    thing.entry = &entry;
    thing.members.push_back({"", {&entry.value, {}}, NamedThing::Member::State::unknown, {}, {}});
  }
  // Their counts may be measured of single things.
  for (const Entry& entry : values->entries) {
    if (!is_family(entry)) continue;
    NamedThing family;
    family.entry = &entry;
    family.is_family = true;
    repeat(entry.value, {}, [&](const Counters& counters, const std::string& member) {
      family.members.push_back({member, {&entry.value, counters}, NamedThing::Member::State::unknown, {}, {}});
    });
    things[entry.key.name] = std::move(family);
  }
}

// `like: NAME` copies all fields of a thing of the same section; the map's own fields override them. Null after an
// error.
const Value* Builder::with_like(const Value& map, const Value* section) {
  const Value* like = map.find("like");
  if (!like) return &map;
  if (const auto found = liked_.find(&map); found != liked_.end()) return found->second;
  const auto fail = [&](const std::string& message, const std::string& hint = {}) {
    diagnostics_.error(like->place, message, hint);
    return liked_[&map] = nullptr;
  };
  if (!like->is_scalar()) return fail("'like' names one thing");
  const std::string scope = like->place.file ? like->place.file->scope : "";
  const Named named = section ? find_named(*section, like->text, scope) : Named{};
  if (!named.entry || !named.member.empty()) {
    std::vector<std::string> names;
    if (section)
      for (const Entry& entry : section->entries) names.push_back(entry.key.name);
    return fail(fmt::format("there is nothing called '{}' to be like{}", like->text, suggestion(like->text, names)));
  }
  if (&named.entry->value == &map || !like_in_work_.insert(named.entry->key.name).second)
    return fail(fmt::format("'{}' is like itself in the end", like->text));
  const Value* parent = with_like(named.entry->value, section);
  like_in_work_.erase(named.entry->key.name);
  if (!parent) return liked_[&map] = nullptr;
  if (!parent->is_map()) return fail(fmt::format("'{}' is no map of fields", like->text));
  if (named.entry->value.find("repeat") && !map.find("repeat"))
    return fail(fmt::format("'{}' is a family: its fields need its counters", like->text), "give 'repeat' here too");
  Value merged = *parent;
  merged.place = map.place;
  std::erase_if(merged.entries, [](const Entry& e) { return e.key.name == "like" || e.key.name == "repeat"; });
  for (const Entry& entry : map.entries) {
    if (entry.key.name == "like") continue;
    std::erase_if(merged.entries, [&](const Entry& e) { return e.key.name == entry.key.name; });
    merged.entries.push_back(entry);
  }
  made_.push_back(std::move(merged));
  liked_[&map] = &made_.back();
  return &made_.back();
}

const Built* Builder::member(NamedThing& thing, NamedThing::Member& member, std::span<const Category> wanted) {
  using State = NamedThing::Member::State;
  const Value& value = *member.scoped.value;
  if (member.state == State::in_work) {
    diagnostics_.error(value.place, fmt::format("'{}' is built from itself", thing.entry->key.name),
                       "entities may refer to each other in any order, but not in a circle");
    member.state = State::wrong;
  }
  if (member.state == State::unknown) {
    member.state = State::in_work;
    const bool outer = std::exchange(names_use_, true);
    std::optional<Built> built;
    if (is_geometry(wanted.front()) && value.is_sequence()) {
      if (const auto point = read_coordinates(value, member.scoped.counters)) built = Built{Category::point, *point};
    } else if (is_geometry(wanted.front()) && is_selector(value)) {
      if (value.find("extreme") && value.entries.size() == 2u + (value.find("repeat") ? 1u : 0u)) {
        if (const auto point = read_selected_place(value, member.scoped.counters))
          built = Built{Category::point, *point};
      } else {
        built = select_one(value, member.scoped.counters, geometry_categories());
      }
    } else if (is_geometry(wanted.front()) && is_place(value)) {
      names_use_ = false;
      if (const auto point = read_place_on(value, member.scoped.counters)) built = Built{Category::point, *point};
    } else if (is_geometry(wanted.front())) {
      built = build_typed(value, member.scoped.counters, geometry_categories());
    } else {
      built = build_typed(value, member.scoped.counters, wanted.first(1));
    }
    names_use_ = outer;
    if (built) {
      member.built = *std::move(built);
      if (member.state == State::in_work) member.state = State::known;
    } else {
      member.state = State::wrong;
    }
  }
  return member.state == State::known ? &member.built : nullptr;
}

std::optional<std::vector<Built>> Builder::part_of(const Built& whole, std::string_view part, const Value& asked,
                                                   std::span<const Category> wanted) {
  if (const auto* set = std::any_cast<SurfaceSet>(&whole.value)) {
    const auto index = render::read_number(part);
    if (index && *index >= 0 && *index < static_cast<double>(set->size()) && *index == std::floor(*index))
      return std::vector{Built{Category::surface, (*set)[static_cast<size_t>(*index)]}};
    diagnostics_.error(asked.place, fmt::format("'{}' has no member '{}'", asked.text, part),
                       fmt::format("its members are numbered 0 to {}", set->size() - 1));
    return std::nullopt;
  }
  if (const auto* body = std::any_cast<BodyPtr>(&whole.value)) return elements_called(**body, part, asked, wanted);
  // The faces of a solid that is put together are those of its boundary.
  if (const auto* shape = std::any_cast<geometry::ShapePtr>(&whole.value); shape && geometry::has_boundary(**shape)) {
    const Category bodies[] = {Category::body};
    const auto body = as_wanted(whole, asked, bodies);
    return body ? part_of(*body, part, asked, wanted) : std::nullopt;
  }
  diagnostics_.error(asked.place, fmt::format("'{}' has no member '{}'", asked.text, part));
  return std::nullopt;
}

// A body as operations take it: what it consists of is called by its name too, blank.end.
const Built& Builder::operand_of(const NamedThing& thing, NamedThing::Member& member) {
  const auto* body = std::any_cast<BodyPtr>(&member.built.value);
  if (!body || !in_geometry_) return member.built;
  if (!member.as_operand) {
    const std::string& name = thing.entry->key.name;
    const std::string full = member.name.empty() ? name : name + "." + member.name;
    member.as_operand = Built{Category::body, BodyPtr(std::make_shared<geometry::Body>(with_feature(**body, full)))};
  }
  return *member.as_operand;
}

// The things that a name stands for: one, or all members of a family.
std::optional<std::vector<Built>> Builder::named(const Value& value, std::span<const Category> wanted) {
  const auto parts = parts_named(value, wanted);
  if (!parts) return std::nullopt;
  std::vector<Built> result;
  for (const NamedPart& one : *parts) {
    if (one.part.empty()) {
      result.push_back(operand_of(*one.thing, *one.member));
      continue;
    }
    const auto inner = part_of(one.member->built, one.part, value, wanted);
    if (!inner) return std::nullopt;
    result.insert(result.end(), inner->begin(), inner->end());
  }
  for (Built& built : result) {
    auto fitting = as_wanted(std::move(built), value, wanted);
    if (!fitting) return std::nullopt;
    built = *std::move(fitting);
  }
  for (const Built& built : result)
    if (!contains(wanted, built.category)) {
      diagnostics_.error(value.place,
                         fmt::format("'{}' is {}, but {} is wanted here", value.text, describe({&built.category, 1}),
                                     describe(wanted)),
                         contains(wanted, Category::point) ? hint_of_place(value.text, built.category) : std::string());
      return std::nullopt;
    }
  return result;
}

std::optional<std::vector<Builder::NamedPart>> Builder::parts_named(const Value& value,
                                                                    std::span<const Category> wanted) {
  if (value.is_scalar() && read_number(value)) {
    diagnostics_.error(value.place, fmt::format("expected {}, found the number {}", describe(wanted), value.text),
                       contains(wanted, Category::point)
                           ? "write [x, y, z], the name of a point, or a place such as { of: curve, t: 0.5 }"
                           : "write the name of one, or a map with its fields");
    return std::nullopt;
  }
  const auto text = read_reference(value);
  if (!text) {
    Slip slip = text.slip();
    if (const std::string meant = maps_with_word(value.text, wanted); !meant.empty()) slip.hint = "write " + meant;
    report(diagnostics_, value, slip);
    return std::nullopt;
  }
  auto* things = things_of(wanted.front());
  const char* section_text = section_of(wanted.front());
  const Value* values = section_text ? section(section_text) : nullptr;
  const std::string scope = value.place.file ? value.place.file->scope : "";
  const Named found = values && values->is_map() ? find_named(*values, *text, scope) : Named{};
  if (!found.entry || !things) {
    std::vector<std::string> names;
    if (values)
      for (const Entry& entry : values->entries) names.push_back(entry.key.name);
    const char* elsewhere = nullptr;
    for (const auto& [other, known] : sections_)
      if (known.contains(*text)) elsewhere = other.c_str();
    const std::string nearest = elsewhere ? "" : suggestion(*text, names), meant = maps_with_word(*text, wanted);
    diagnostics_.error(
        value.place,
        fmt::format("there is no {} called '{}'{}",
                    is_geometry(wanted.front()) ? "geometry" : geometry::name(wanted.front()), *text, nearest),
        elsewhere                           ? fmt::format("'{}' stands under '{}'", *text, elsewhere)
        : !meant.empty()                    ? "write " + meant
        : !nearest.empty() || names.empty() ? ""
                                            : (names.size() > kMaxNames ? "the nearest are " : "there are ") +
                                                  listed(geometry::nearest_names(*text, names, kMaxNames)));
    return std::nullopt;
  }
  const auto known = things->find(found.entry->key.name);
  if (known == things->end()) {
    diagnostics_.error(value.place, fmt::format("'{}' is a family that is not made yet", found.entry->key.name),
                       "what is measured for the range of a 'repeat' is no member of a family");
    return std::nullopt;
  }
  NamedThing& thing = known->second;
  thing.used = thing.used || names_use_;
  std::vector<NamedPart> result;
  std::string_view rest = found.member;
  bool matched = thing.is_family && rest.empty();  // a family may be empty
  const auto is_of_member = [&](const NamedThing::Member& one) {
    return rest == one.name || one.name.starts_with(std::string(rest) + ".") || rest.starts_with(one.name + ".");
  };
  // hole.side: of each member.
  const bool of_each = thing.is_family && !rest.empty() &&
                       std::none_of(thing.members.begin(), thing.members.end(), is_of_member) &&
                       !starts_with_number(rest);
  for (NamedThing::Member& one : thing.members) {
    std::string_view part = rest;
    if (thing.is_family && !rest.empty() && !of_each) {
      if (!is_of_member(one)) continue;
      part = rest.starts_with(one.name + ".") ? rest.substr(one.name.size() + 1) : std::string_view();
    }
    matched = true;
    if (!member(thing, one, wanted)) return std::nullopt;
    result.push_back({&thing, &one, std::string(part)});
  }
  if (!matched) {
    diagnostics_.error(value.place, fmt::format("'{}' has no member '{}'", found.entry->key.name, rest),
                       thing.members.empty() ? "the family is empty"
                                             : fmt::format("its members are {} to {}", thing.members.front().name,
                                                           thing.members.back().name));
    return std::nullopt;
  }
  return result;
}

const Value& Builder::with_counters(const Value& value, const Counters& counters) {
  Value name = value;
  if (value.is_scalar() && value.text.find('%') != std::string::npos) {
    if (const auto filled = fill_templates(value, counters))
      name = *filled;
    else
      name.invalid = true;
  } else if (const Value* member = is_member(value) ? value.find("member") : nullptr) {
    name = *value.find("of");
    for (const Value* one = member->is_sequence() ? member->items.data() : member;
         one != (member->is_sequence() ? member->items.data() + member->items.size() : member + 1); ++one) {
      const auto number = parameters_.integer(*one, counters);
      name.text += fmt::format(".{}", number.value_or(0));
      name.invalid = name.invalid || !number;
    }
  } else {
    return value;
  }
  made_.push_back(std::move(name));
  return made_.back();
}

std::optional<Built> Builder::refer(const Value& written, const Counters& counters, std::span<const Category> wanted) {
  const Value& value = with_counters(written, counters);
  if (value.invalid) return std::nullopt;
  if (is_selector(value) && is_geometry(wanted.front())) return select_one(value, counters, wanted);
  if (value.is_map() || !section_of(wanted.front())) return build_typed(value, counters, wanted);
  if (value.is_sequence()) {
    if (contains(wanted, Category::point)) {
      const auto point = read_coordinates(value, counters);
      return point ? std::optional(Built{Category::point, *point}) : std::nullopt;
    }
    diagnostics_.error(value.place, fmt::format("expected {}, found a list", describe(wanted)));
    return std::nullopt;
  }
  auto all = named(value, wanted);
  if (!all) return std::nullopt;
  if (all->size() != 1) {
    diagnostics_.error(value.place,
                       fmt::format("'{}' is a family of {}; one thing is wanted here", value.text, all->size()),
                       fmt::format("name a member, for example {}.0", value.text));
    return std::nullopt;
  }
  if (auto* style = std::any_cast<StyleChanges>(&all->front().value)) style->name = value.text;
  return std::move(all->front());
}

std::optional<std::vector<std::any>> Builder::refer_all(const Value& value, const Counters& counters,
                                                        std::span<const Category> wanted) {
  std::vector<std::any> all;
  const bool good = refer_each(value, counters, wanted, [&](std::any one) { all.push_back(std::move(one)); });
  return good ? std::optional(std::move(all)) : std::nullopt;
}

bool Builder::refer_each(const Value& value, const Counters& counters, std::span<const Category> wanted,
                         const std::function<void(std::any)>& take) {
  bool good = true;
  each_item(value, counters, [&](const Value& written, const Counters& inner) {
    const Value& item = with_counters(written, inner);
    if (item.invalid) {
      good = false;
    } else if (const bool by_conditions = is_selector(item) && is_geometry(wanted.front());
               by_conditions || (item.is_scalar() && section_of(wanted.front()))) {
      auto some = by_conditions ? selected(item, inner, wanted) : named(item, wanted);
      good = good && some;
      if (some)
        for (Built& built : *some) take(std::move(built.value));
    } else {
      auto one = refer(item, inner, wanted);
      good = good && one;
      if (one) take(std::move(one->value));
    }
  });
  return good;
}

// One for each that refer_all() finds.
std::vector<std::string> Builder::names_of_references(const Value& value, const Counters& counters,
                                                      std::span<const Category> wanted) {
  std::vector<std::string> names;
  for (const Scoped& item : items(value, counters)) {
    const Value& name = with_counters(*item.value, item.counters);
    const bool is_name = name.is_scalar() && section_of(wanted.front());
    const auto some = is_name                                            ? named(name, wanted)
                      : is_selector(name) && is_geometry(wanted.front()) ? selected(name, item.counters, wanted)
                                                                         : std::nullopt;
    names.insert(names.end(), some ? some->size() : 1, is_name ? name.text : std::string());
  }
  return names;
}

}  // namespace lekalo::render
