// Maps with a `type`, references to named things, families, `like`, `repeat`.
#include <fmt/format.h>

#include <algorithm>

#include "geometry/expression/nearest_name.h"
#include "geometry/transformed.h"
#include "render/scene/builder.h"
#include "render/scene/scalars.h"

namespace lekalo::render {

using geometry::BodyPtr;
using geometry::CurvePtr;
using geometry::FieldError;
using geometry::Kind;
using geometry::MeshPtr;
using geometry::SurfacePtr;

namespace {

constexpr int kDeepestNesting = 64;       // inline maps and references
constexpr size_t kMostRepeats = 1000000;  // of one repeat

std::string quoted_list(const std::vector<std::string>& names, size_t most = 12) {
  std::string text;
  for (size_t i = 0; i < names.size() && i < most; ++i) text += (i ? ", " : "") + names[i];
  if (names.size() > most) text += ", ...";
  return text;
}

bool is_geometry(Category category) {
  return category == Category::point || category == Category::curve || category == Category::surface ||
         category == Category::body || category == Category::mesh;
}

const char* section_name(Category category) {
  if (is_geometry(category)) return "geometry";
  if (category == Category::material) return "materials";
  if (category == Category::light) return "lights";
  if (category == Category::texture) return "textures";
  return nullptr;
}

bool contains(std::span<const Category> categories, Category category) {
  return std::find(categories.begin(), categories.end(), category) != categories.end();
}

}  // namespace

const Value* Builder::section(const char* name) const { return scene_.root.find(name); }

std::map<std::string, NamedThing, std::less<>>* Builder::section_of(Category category) {
  const char* name = section_name(category);
  const auto found = name ? sections_.find(name) : sections_.end();
  return found == sections_.end() ? nullptr : &found->second;
}

bool Builder::repeat(const Value& map, const Counters& counters,
                     const std::function<void(const Counters&, const std::string&)>& visit) {
  const Value* loops = map.find("repeat");
  if (!loops->is_map() || loops->entries.empty()) {
    diagnostics_.error(loops->place, "'repeat' names a counter and its values",
                       "write { repeat: { i: 0..5 }, ... } or { repeat: { q: [0, 0.5, 1] }, ... }");
    return false;
  }
  size_t total = 0;
  const auto run = [&](auto&& self, size_t level, const Counters& outer, const std::string& name) -> bool {
    if (level == loops->entries.size()) {
      if (++total > kMostRepeats) {
        diagnostics_.error(loops->place, fmt::format("more than {} repetitions", kMostRepeats));
        return false;
      }
      visit(outer, name);
      return true;
    }
    const Entry& counter = loops->entries[level];
    if (!Parameters::may_be_called(counter.key.name)) {
      diagnostics_.error(counter.key.place, fmt::format("a counter may not be called '{}'", counter.key.name),
                         "it is a variable, function or unit of formulas");
      return false;
    }
    const std::string scope = counter.key.place.file ? counter.key.place.file->scope : "";
    if (const Value* parameters = section("parameters");
        parameters && find_named(*parameters, counter.key.name, scope).entry) {
      diagnostics_.error(counter.key.place, fmt::format("the counter '{}' is also a parameter", counter.key.name),
                         "give one of them another name");
      return false;
    }
    struct Step {
      double value;
      geometry::Measure measure;
    };
    std::vector<Step> steps;
    if (is_range(counter.value)) {
      const auto range = read_range(counter.value);
      if (!range) {
        report(diagnostics_, counter.value, range.slip());
        return false;
      }
      const auto first = parameters_.bind(counter.value, range->first, 0, outer);
      const auto last = parameters_.bind(counter.value, range->last, counter.value.text.find("..") + 2, outer);
      if (!first || !last) return false;
      const double a = (*first)(), b = (*last)();
      if (!(a == std::nearbyint(a) && b == std::nearbyint(b) && std::abs(a) < 1e9 && std::abs(b) < 1e9)) {
        diagnostics_.error(counter.value.place, fmt::format("a range of whole numbers, found {:.9g}..{:.9g}", a, b));
        return false;
      }
      if (b - a >= static_cast<double>(kMostRepeats)) {
        diagnostics_.error(counter.value.place, fmt::format("more than {} repetitions", kMostRepeats));
        return false;
      }
      for (double x = a; x <= b; ++x) steps.push_back({x, geometry::Measure::plain});
    } else if (counter.value.is_sequence()) {
      for (const Value& item : counter.value.items) {
        const auto expression = parameters_.bind(item, outer);
        if (!expression) return false;
        steps.push_back({(*expression)(), expression->measure()});
      }
    } else {
      diagnostics_.error(counter.value.place, "a counter runs over a range a..b or a list of values");
      return false;
    }
    for (size_t k = 0; k < steps.size(); ++k) {
      const std::string member = name.empty() ? std::to_string(k) : name + "." + std::to_string(k);
      if (!self(self, level + 1, outer.with(counter.key.name, steps[k].value, steps[k].measure), member)) return false;
    }
    return true;
  };
  return run(run, 0, counters, "");
}

void Builder::declare_section(const char* name) {
  auto& things = sections_[name];
  const Value* values = section(name);
  if (!values) return;
  if (!values->is_map()) {
    if (!values->invalid)
      diagnostics_.error(values->place, fmt::format("'{}' is a map of named things", name),
                         "write name: { type: ..., ... }");
    return;
  }
  for (const Entry& entry : values->entries) {
    NamedThing& thing = things[entry.key.name];
    thing.entry = &entry;
    if (entry.value.is_map() && entry.value.find("repeat")) {
      thing.is_family = true;
      repeat(entry.value, {}, [&](const Counters& counters, const std::string& member) {
        thing.members.push_back({member, {&entry.value, counters}, NamedThing::Member::State::unknown, {}});
      });
    } else {
      thing.members.push_back({"", {&entry.value, {}}, NamedThing::Member::State::unknown, {}});
    }
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
    const auto nearest = geometry::nearest_name(like->text, names);
    return fail(fmt::format("there is nothing called '{}' to be like{}", like->text,
                            nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : ""));
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

const Value& Builder::default_value(const std::string& text) {
  auto [found, fresh] = default_values_.try_emplace(text);
  if (fresh) {
    Diagnostics own;
    Value document = read_document(make_source("(default)", "x: " + text + "\n"), own);
    if (const Value* value = document.find("x"); value && !own.has_errors()) found->second = *value;
  }
  return found->second;
}

bool Builder::read_field(const Field& field, const Value& value, const Counters& counters, Fields& fields) {
  if (!field.type.per_direction) {
    auto result = read(field.type, value, counters);
    if (!result) return false;
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
    const auto nearest = geometry::nearest_name(name, known);
    diagnostics_.error(entry.key.place,
                       fmt::format("unknown field '{}' of {}{}", name, what,
                                   nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : ""),
                       nearest ? "" : "it has " + quoted_list(known, 30));
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

std::optional<Built> Builder::build_typed(const Value& given, const Counters& counters,
                                          std::span<const Category> wanted, const char* default_type) {
  if (given.invalid) return std::nullopt;
  if (!given.is_map()) {
    diagnostics_.error(given.place,
                       fmt::format("expected {} as a map with a type, found {}", describe(wanted), kind_name(given)),
                       fmt::format("write {{ type: {}, ... }}", type_names(wanted).front()));
    return std::nullopt;
  }
  if (depth_ >= kDeepestNesting) {
    diagnostics_.error(given.place, fmt::format("things inside things more than {} deep", kDeepestNesting));
    return std::nullopt;
  }
  struct Depth {
    int& depth;
    explicit Depth(int& d) : depth(d) { ++depth; }
    ~Depth() { --depth; }
  } nested(depth_);

  const char* section_text = section_name(wanted.front());
  const Value* completed = with_like(given, section_text ? section(section_text) : nullptr);
  if (!completed) return std::nullopt;
  const Value& map = *completed;
  const Value* type_value = map.find("type");
  std::string name = default_type ? default_type : "";
  if (type_value) {
    const auto word = read_text(*type_value);
    if (!word) {
      report(diagnostics_, *type_value, word.slip());
      return std::nullopt;
    }
    name = *word;
  }
  if (name.empty()) {
    diagnostics_.error(map.place, fmt::format("missing 'type' of {}", describe(wanted)),
                       "one of " + quoted_list(type_names(wanted), 40));
    return std::nullopt;
  }
  const TypeDeclaration* type = find_type(name, wanted);
  const Place& type_place = type_value ? type_value->place : map.place;
  if (!type) {
    const std::vector<std::string> meant = types_meant_by(name, wanted);
    const std::vector<std::string> known = type_names(wanted);
    const auto nearest = geometry::nearest_name(name, known);
    if (!meant.empty())
      diagnostics_.error(type_place, fmt::format("'{}' exists for several kinds", name),
                         "say which: " + quoted_list(meant));
    else
      diagnostics_.error(
          type_place,
          fmt::format("unknown type '{}'{}", name, nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : ""),
          nearest ? "" : "one of " + quoted_list(known, 40));
    return std::nullopt;
  }
  if (!contains(wanted, type->category)) {
    diagnostics_.error(
        type_place,
        fmt::format("'{}' makes a {}, but {} is wanted here", name, geometry::name(type->category), describe(wanted)),
        "one of " + quoted_list(type_names(wanted), 40));
    return std::nullopt;
  }
  std::vector<std::string> common = {"type", "like", "repeat"};
  if (is_geometry(type->category)) common.push_back("transform");
  if (type->category == Category::surface) common.push_back("reversed");
  const auto fields = read_fields(type->fields, map, counters, "'" + name + "'", common);
  std::optional<Affine> transform = Affine();
  if (const Value* value = map.find("transform"); value && is_geometry(type->category))
    transform = read_transform(*value, counters);
  bool reversed = false;
  if (const Value* value = map.find("reversed"); value && type->category == Category::surface) {
    const auto flag = read_boolean(*value);
    if (!flag) {
      report(diagnostics_, *value, flag.slip());
      return std::nullopt;
    }
    reversed = *flag;
  }
  if (!fields || !transform || !check(*type, *fields, map)) return std::nullopt;
  try {
    Built built{type->category, type->build(*fields)};
    if (reversed) {
      // The builder's own surface is not shared yet: it may still be turned.
      if (auto* surface = std::any_cast<SurfacePtr>(&built.value))
        const_cast<geometry::Surface&>(**surface).set_reversed(true);
      if (auto* set = std::any_cast<SurfaceSet>(&built.value))
        for (SurfacePtr& surface : *set) const_cast<geometry::Surface&>(*surface).set_reversed(true);
    }
    if (transform->is_identity()) return built;
    return transformed(std::move(built), *transform, map);
  } catch (const FieldError& error) {
    const Value* field = map.find(error.field);
    diagnostics_.error(field ? field->place : map.place, error.what(), error.hint);
  } catch (const std::invalid_argument& error) {
    diagnostics_.error(map.place, fmt::format("'{}': {}", name, error.what()));
  }
  return std::nullopt;
}

std::optional<Built> Builder::transformed(Built built, const Affine& map, const Value& value) {
  try {
    if (auto* point = std::any_cast<Vec3>(&built.value)) {
      built.value = map.point(*point);
    } else if (auto* curve = std::any_cast<CurvePtr>(&built.value)) {
      built.value = geometry::transformed(*curve, map);
    } else if (auto* surface = std::any_cast<SurfacePtr>(&built.value)) {
      built.value = geometry::transformed(*surface, map);
    } else if (auto* set = std::any_cast<SurfaceSet>(&built.value)) {
      for (SurfacePtr& member : *set) member = geometry::transformed(member, map);
    } else if (auto* body = std::any_cast<BodyPtr>(&built.value)) {
      built.value = BodyPtr(std::make_shared<geometry::Body>(geometry::transformed(**body, map)));
    } else if (auto* mesh = std::any_cast<MeshPtr>(&built.value)) {
      built.value = MeshPtr(std::make_shared<geometry::Mesh>(geometry::transformed(**mesh, map)));
    }
    return built;
  } catch (const std::invalid_argument& error) {
    diagnostics_.error(value.place, error.what());
    return std::nullopt;
  }
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
    std::optional<Built> built;
    if (is_geometry(wanted.front()) && value.is_sequence()) {
      if (const auto point = read_coordinates(value, member.scoped.counters)) built = Built{Category::point, *point};
    } else if (is_geometry(wanted.front())) {
      static const Category all[] = {Category::curve, Category::surface, Category::body, Category::mesh,
                                     Category::point};
      built = build_typed(value, member.scoped.counters, all);
    } else {
      built = build_typed(value, member.scoped.counters, wanted.first(1));
    }
    if (built) {
      member.built = *std::move(built);
      if (member.state == State::in_work) member.state = State::known;
    } else {
      member.state = State::wrong;
    }
  }
  return member.state == State::known ? &member.built : nullptr;
}

std::optional<Built> Builder::part_of(const Built& whole, std::string_view part, const Value& asked) {
  if (const auto* set = std::any_cast<SurfaceSet>(&whole.value)) {
    const auto index = render::read_number(part);
    if (index && *index >= 0 && *index < static_cast<double>(set->size()) && *index == std::floor(*index))
      return Built{Category::surface, (*set)[static_cast<size_t>(*index)]};
    diagnostics_.error(asked.place, fmt::format("'{}' has no member '{}'", asked.text, part),
                       fmt::format("its members are numbered 0 to {}", set->size() - 1));
    return std::nullopt;
  }
  if (const auto* body = std::any_cast<BodyPtr>(&whole.value)) {
    std::vector<std::string> names;
    for (const geometry::Face& face : (*body)->faces) {
      names.push_back(face.origin.text());
      if (face.origin.text() == part) return Built{Category::surface, face.surface};
    }
    const auto nearest = geometry::nearest_name(part, names);
    diagnostics_.error(asked.place,
                       fmt::format("'{}' has no face '{}'{}", asked.text.substr(0, asked.text.size() - part.size() - 1),
                                   part, nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : ""),
                       "its faces are " + quoted_list(names, 30));
    return std::nullopt;
  }
  diagnostics_.error(asked.place, fmt::format("'{}' has no member '{}'", asked.text, part));
  return std::nullopt;
}

// The things that a name stands for: one, or all members of a family.
std::optional<std::vector<Built>> Builder::named(const Value& value, std::span<const Category> wanted) {
  const auto text = read_reference(value);
  if (!text) {
    report(diagnostics_, value, text.slip());
    return std::nullopt;
  }
  auto* things = section_of(wanted.front());
  const char* section_text = section_name(wanted.front());
  const Value* values = section_text ? section(section_text) : nullptr;
  const std::string scope = value.place.file ? value.place.file->scope : "";
  const Named found = values && values->is_map() ? find_named(*values, *text, scope) : Named{};
  if (!found.entry || !things) {
    std::vector<std::string> names;
    if (values)
      for (const Entry& entry : values->entries) names.push_back(entry.key.name);
    const auto nearest = geometry::nearest_name(*text, names);
    diagnostics_.error(
        value.place,
        fmt::format("there is {} called '{}'{}",
                    is_geometry(wanted.front()) ? "no geometry" : fmt::format("no {}", geometry::name(wanted.front())),
                    *text, nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : ""),
        nearest || names.empty() ? "" : "there are " + quoted_list(names, 20));
    return std::nullopt;
  }
  NamedThing& thing = things->find(found.entry->key.name)->second;
  thing.used = true;
  std::vector<Built> result;
  std::string_view rest = found.member;
  bool matched = thing.is_family && rest.empty();  // a family may be empty
  for (NamedThing::Member& one : thing.members) {
    if (thing.is_family && !rest.empty()) {
      const bool exact = rest == one.name;
      const bool below = one.name.starts_with(std::string(rest) + ".");
      const bool part = rest.starts_with(one.name + ".");
      if (!exact && !below && !part) continue;
      matched = true;
      const Built* built = member(thing, one, wanted);
      if (!built) return std::nullopt;
      if (part) {
        const auto inner = part_of(*built, rest.substr(one.name.size() + 1), value);
        if (!inner) return std::nullopt;
        result.push_back(*inner);
      } else {
        result.push_back(*built);
      }
      continue;
    }
    matched = true;
    const Built* built = member(thing, one, wanted);
    if (!built) return std::nullopt;
    if (rest.empty()) {
      result.push_back(*built);
    } else {
      const auto inner = part_of(*built, rest, value);
      if (!inner) return std::nullopt;
      result.push_back(*inner);
    }
  }
  if (!matched) {
    diagnostics_.error(value.place, fmt::format("'{}' has no member '{}'", found.entry->key.name, rest),
                       thing.members.empty() ? "the family is empty"
                                             : fmt::format("its members are {} to {}", thing.members.front().name,
                                                           thing.members.back().name));
    return std::nullopt;
  }
  for (const Built& built : result)
    if (!contains(wanted, built.category)) {
      diagnostics_.error(value.place, fmt::format("'{}' is a {}, but {} is wanted here", *text,
                                                  geometry::name(built.category), describe(wanted)));
      return std::nullopt;
    }
  return result;
}

std::optional<Built> Builder::refer(const Value& value, const Counters& counters, std::span<const Category> wanted) {
  if (value.invalid) return std::nullopt;
  if (value.is_map()) return build_typed(value, counters, wanted);
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
  return std::move(all->front());
}

std::optional<std::vector<std::any>> Builder::refer_all(const Value& value, const Counters& counters,
                                                        std::span<const Category> wanted) {
  std::vector<std::any> all;
  bool good = true;
  for (const Scoped& item : items(value, counters)) {
    if (item.value->is_scalar()) {
      auto some = named(*item.value, wanted);
      if (!some) {
        good = false;
        continue;
      }
      for (Built& built : *some) all.push_back(std::move(built.value));
    } else {
      auto one = refer(*item.value, item.counters, wanted);
      if (one)
        all.push_back(std::move(one->value));
      else
        good = false;
    }
  }
  return good ? std::optional(std::move(all)) : std::nullopt;
}

Entity entity_of(const Built& built) {
  if (const auto* point = std::any_cast<Vec3>(&built.value)) return *point;
  if (const auto* curve = std::any_cast<CurvePtr>(&built.value)) return *curve;
  if (const auto* surface = std::any_cast<SurfacePtr>(&built.value)) return *surface;
  if (const auto* set = std::any_cast<SurfaceSet>(&built.value)) return *set;
  if (const auto* body = std::any_cast<BodyPtr>(&built.value)) return *body;
  if (const auto* mesh = std::any_cast<MeshPtr>(&built.value)) return *mesh;
  throw std::logic_error("a builder returned something that is no geometry");
}

}  // namespace lekalo::render
