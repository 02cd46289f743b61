// Maps with a `type`, and what they make.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "geometry/expression/nearest_name.h"
#include "geometry/external/external_curve.h"
#include "geometry/external/external_surface.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/transformed.h"
#include "render/scene/build/builder.h"

#include "geometry/bodies/booleans/solid_boundary.h"
#include "render/scene/values/scalars.h"
#include "render/scene/values/words.h"

namespace lekalo::render {

using geometry::BodyPtr;
using geometry::CurvePtr;
using geometry::MeshPtr;
using geometry::ShapePtr;
using geometry::SurfacePtr;

namespace {

// Inline maps and references. Each takes kilobytes of the stack, and of solids made of solids each has all leaves below
// it.
constexpr int kDeepestNesting = 256;

bool contains(std::span<const Category> categories, Category category) {
  return std::find(categories.begin(), categories.end(), category) != categories.end();
}

// The builder's own surface is not shared yet: it may still be turned.
void reverse(std::any& value) {
  const auto turn = [](const SurfacePtr& surface) {
    const_cast<geometry::Surface&>(*surface).set_reversed(!surface->reversed());
  };
  if (auto* surface = std::any_cast<SurfacePtr>(&value)) turn(*surface);
  if (auto* set = std::any_cast<SurfaceSet>(&value))
    for (const SurfacePtr& surface : *set) turn(surface);
}

// Whether something in the map other than its transform may depend on a counter: whether its name stands there.
bool speaks_of(const Value& value, const Counters& counters, bool outermost = true) {
  const auto is_part = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (const auto& counter : counters.values)
    for (size_t at = value.text.find(counter.name); at != std::string::npos;
         at = value.text.find(counter.name, at + 1)) {
      const size_t end = at + counter.name.size();
      if ((at == 0 || !is_part(value.text[at - 1])) && (end == value.text.size() || !is_part(value.text[end])))
        return true;
    }
  for (const Value& item : value.items)
    if (speaks_of(item, counters, false)) return true;
  for (const Entry& entry : value.entries)
    if (!(outermost && (entry.key.name == "transform" || entry.key.name == "repeat")) &&
        speaks_of(entry.value, counters, false))
      return true;
  return false;
}

// Hints name few: the nearest, of types that would do.
std::string some_of(const std::string& name, const std::vector<std::string>& known) {
  constexpr size_t kMaxNames = 5;
  if (known.size() <= kMaxNames) return "one of " + listed(known);
  return fmt::format("for example {}; 'lekalo types' lists all",
                     listed(geometry::nearest_names(name, known, kMaxNames)));
}

// "'circle'", "an object".
std::string name_in_messages(const TypeDeclaration& type) {
  return is_implicit(type.category) ? describe({&type.category, 1}) : "'" + type.name + "'";
}

}  // namespace

const std::vector<Field>& Builder::declared_fields(const TypeDeclaration& type) {
  auto [found, fresh] = declared_.try_emplace(&type);
  if (fresh) {
    found->second = type.fields;
    for (Field& field : common_fields(type.category))
      if (std::none_of(type.fields.begin(), type.fields.end(), [&](const Field& f) { return f.name == field.name; }))
        found->second.push_back(std::move(field));
  }
  return found->second;
}

// The type that a map names, if things of the wanted categories can be of it.
const TypeDeclaration* Builder::type_of(const Value& map, std::span<const Category> wanted) {
  const bool implicit = is_implicit(wanted.front());
  const Value* given = implicit ? nullptr : map.find("type");
  std::string name = default_type(wanted.front(), map);
  if (given) {
    const auto word = read_text(*given);
    if (!word) {
      report(diagnostics_, *given, word.slip());
      return nullptr;
    }
    name = *word;
  }
  const std::vector<std::string> known = type_names(wanted);
  if (name.empty()) {
    const std::vector<std::string> fitting =
        map.entries.empty() ? std::vector<std::string>() : types_with_fields_of(map, wanted);
    diagnostics_.error(map.place, fmt::format("missing 'type' of {}", describe(wanted)),
                       some_of("", fitting.empty() ? known : fitting));
    return nullptr;
  }
  const TypeDeclaration* type = find_type(name, wanted);
  const Place& place = given ? given->place : map.place;
  if (name == "point" && contains(wanted, Category::point)) {
    diagnostics_.error(place, "unknown type 'point'",
                       map.find("repeat") ? "a point of a family is a place: { repeat: { k: 0..5 }, of: a_curve, t: k }"
                                          : "a point is written as its coordinates: P: [1, 2, 0]");
    return nullptr;
  }
  if (!type) {
    if (const auto meant = types_meant_by(name, wanted); !meant.empty()) {
      if (meant.size() == 1)
        diagnostics_.error(place, fmt::format("unknown type '{}' (did you mean '{}'?)", name, meant.front()));
      else
        diagnostics_.error(place, fmt::format("'{}' exists for several kinds", name),
                           "say which: " + listed(meant, 12));
      return nullptr;
    }
    const std::string nearest = suggestion(name, known);
    diagnostics_.error(place, fmt::format("unknown type '{}'{}", name, nearest),
                       nearest.empty() ? some_of(name, known) : "");
    return nullptr;
  }
  if (!contains(wanted, type->category) &&
      !(contains(wanted, Category::body) && geometry::makes_boundary(type->name))) {
    diagnostics_.error(
        place,
        fmt::format("'{}' makes {}, but {} is wanted here", name, describe({&type->category, 1}), describe(wanted)),
        some_of(name, known));
    return nullptr;
  }
  return type;
}

std::optional<std::any> Builder::build_as(const TypeDeclaration& type, const Value& map, const Counters& counters) {
  // The groups of a family that differ in nothing but where they stand are one, placed several times.
  const bool alike = type.category == Category::group && !counters.values.empty() && !speaks_of(map, counters);
  if (const auto found = alike ? alike_groups_.find(&map) : alike_groups_.end(); found != alike_groups_.end()) {
    const Value* given = map.find("transform");
    const auto place = given ? read_transform(*given, counters) : Affine();
    if (!place) return std::nullopt;
    const auto built = placed({type.category, found->second}, *place, map);
    return built ? std::optional(built->value) : std::nullopt;
  }
  const std::string what = name_in_messages(type);
  if (type.runs_foreign_code && !options_.allow_external) {
    diagnostics_.error(map.place, fmt::format("{} runs code from outside the program, which is not allowed", what),
                       "if you trust this scene and what it names, add --allow-external");
    return std::nullopt;
  }
  std::vector<std::string> also = {"repeat"};
  if (!is_implicit(type.category) && type.category != Category::helper) also.insert(also.begin(), "type");
  Fields fields;
  const bool outer = std::exchange(in_geometry_, is_geometry(type.category));
  bool good = read_fields_into(fields, declared_fields(type), map, counters, what, also);
  in_geometry_ = outer;
  good = (type.category != Category::object || check_helpers(map, fields)) && good;
  good = (type.category != Category::object || !good || check_lines(map, fields)) && good;
  if (!good || !check(type, fields, map)) return std::nullopt;
  if (type.category == Category::annotation && !check_size(type, fields, map)) return std::nullopt;
  auto value = attempt(map, what, [&] { return type.build(fields); });
  if (value && type.category == Category::annotation) {
    auto& annotation = std::any_cast<Annotation&>(*value);
    annotation.place = map.place;
    note_shapes_spoken_of(map, counters, annotation.values);
  }
  if (!value || !is_geometry(type.category)) return value;
  if (const auto* surface = std::any_cast<SurfacePtr>(&*value); surface && !geometry::spans_area(**surface)) {
    diagnostics_.error(map.place, what + " has no area: its points lie on one curve",
                       "its derivatives by u and v are parallel everywhere");
    return std::nullopt;
  }
  if (type.runs_foreign_code) note_external(*value, map);
  if (type.category == Category::surface && fields.has("reversed") && fields.boolean("reversed")) reverse(*value);
  if (alike) alike_groups_[&map] = std::any_cast<GroupPtr>(*value);
  const Affine transform = fields.has("transform") ? fields.transform("transform") : Affine();
  const auto built = placed({type.category, *std::move(value)}, transform, map);
  if (!built) return std::nullopt;
  note_operands(built->value, declared_fields(type), fields, transform);
  if (const void* shape = identity(entity_of(built->value))) types_[shape] = &type;
  return built->value;
}

void Builder::note_external(const std::any& value, const Value& map) {
  const geometry::FitReport* report = nullptr;
  if (const auto* curve = std::any_cast<CurvePtr>(&value))
    report = &dynamic_cast<const geometry::ExternalCurve&>(**curve).report();
  else
    report = &dynamic_cast<const geometry::ExternalSurface&>(*std::any_cast<const SurfacePtr&>(value)).report();
  external_notes_.push_back({map.place, report->text(), report->doubts});
}

std::optional<Built> Builder::placed(Built built, const Affine& transform, const Value& place) {
  return transform.is_identity() ? std::optional(std::move(built)) : transformed(std::move(built), transform, place);
}

std::optional<Built> Builder::build_typed(const Value& given, const Counters& counters,
                                          std::span<const Category> wanted) {
  if (given.invalid) return std::nullopt;
  if (!given.is_map()) {
    const bool implicit = is_implicit(wanted.front()) || !default_type(wanted.front(), given).empty();
    const std::string meant = !given.is_scalar()                   ? ""
                              : wanted.front() == Category::object ? fmt::format("{{ shape: {} }}", given.text)
                                                                   : maps_with_word(given.text, wanted);
    diagnostics_.error(given.place,
                       fmt::format("expected {} as a map{}, found {}", describe(wanted),
                                   implicit ? " of fields" : " with a type", kind_name(given)),
                       !meant.empty() ? "write " + meant
                       : implicit     ? "write { field: value, ... }"
                                      : fmt::format("write {{ type: {}, ... }}", type_names(wanted).front()));
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

  const char* names = section_of(wanted.front());
  const Value* map = names ? with_like(given, section(names)) : &given;
  if (!map) return std::nullopt;
  const TypeDeclaration* type = type_of(*map, wanted);
  if (!type) return std::nullopt;
  auto value = build_as(*type, *map, counters);
  if (!value) return std::nullopt;
  return as_wanted({type->category, *std::move(value)}, *map, wanted);
}

// A solid that is put together, by its boundary where a body is wanted.
std::optional<Built> Builder::as_wanted(Built built, const Value& value, std::span<const Category> wanted) {
  const auto* shape = std::any_cast<geometry::ShapePtr>(&built.value);
  if (!shape || contains(wanted, Category::shape) || !contains(wanted, Category::body) ||
      !geometry::has_boundary(**shape))
    return built;
  try {
    return Built{Category::body, geometry::boundary_of(*shape)};
  } catch (const std::runtime_error& error) {
    diagnostics_.error(value.place, fmt::format("the boundary of this solid: {}", error.what()),
                       "a body is wanted here; as a shape it can be rendered all the same");
  } catch (const std::invalid_argument& error) {
    diagnostics_.error(value.place, fmt::format("the boundary of this solid: {}", error.what()));
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
    } else if (std::any_cast<GroupPtr>(&built.value)) {
      auto placed = std::make_shared<Group>();
      Object& object = placed->objects.emplace_back();
      object.shape = std::any_cast<GroupPtr>(built.value);
      object.transform = map;
      built.value = GroupPtr(std::move(placed));
    } else if (auto* shape = std::any_cast<ShapePtr>(&built.value)) {
      built.value = geometry::transformed(*shape, map);
    } else if (auto* mesh = std::any_cast<MeshPtr>(&built.value)) {
      built.value = MeshPtr(std::make_shared<geometry::Mesh>(geometry::transformed(**mesh, map)));
    }
    return built;
  } catch (const std::invalid_argument& error) {
    diagnostics_.error(value.place, error.what());
    return std::nullopt;
  }
}

// A map from names of helpers to their fields, or names alone.
std::optional<std::vector<std::any>> Builder::read_helpers(const Value& value, const Counters& counters) {
  static const Category wanted[] = {Category::helper};
  static const Value no_fields = [] {
    Value map;
    map.kind = Value::Kind::map;
    return map;
  }();
  std::vector<std::any> helpers;
  bool good = true;
  const auto add = [&](const std::string& name, const Value& fields) {
    const TypeDeclaration* type = find_type(name, wanted);
    if (!type || type->category != Category::helper) return;  // check_helpers() speaks of it
    if (!fields.is_map()) {
      diagnostics_.error(fields.place,
                         fmt::format("expected a map of fields for '{}', found {}", name, kind_name(fields)),
                         fmt::format("write {}: {{ style: thin }}, or {}: {{}}", name, name));
      good = false;
      return;
    }
    auto helper = build_as(*type, fields, counters);
    if (helper)
      helpers.push_back(*std::move(helper));
    else
      good = false;
  };
  if (value.is_map())
    for (const Entry& entry : value.entries) add(entry.key.name, entry.value);
  else
    for (const Scoped& item : items(value, counters)) {
      const auto name = read_name(*item.value);
      if (name) {
        add(*name, no_fields);
      } else {
        report(diagnostics_, *item.value, name.slip());
        good = false;
      }
    }
  return good ? std::optional(std::move(helpers)) : std::nullopt;
}

// Whether the object's shapes offer the helpers that it shows. The fields may be incomplete: then what can be said is.
bool Builder::check_helpers(const Value& object, const Fields& fields) {
  const Value* show = object.find("show");
  if (!show) return true;
  bool good = true;
  std::vector<std::pair<std::string, Place>> shown;
  if (show->is_map())
    for (const Entry& entry : show->entries) shown.emplace_back(entry.key.name, entry.key.place);
  else if (show->is_sequence())
    for (const Value& item : show->items) shown.emplace_back(item.text, item.place);
  else
    shown.emplace_back(show->text, show->place);
  const auto check_all = [&](const std::vector<std::string>& offered, const std::string& what,
                             const char* there_are = "it has ") {
    for (const auto& [helper, place] : shown) {
      if (std::find(offered.begin(), offered.end(), helper) != offered.end()) continue;
      diagnostics_.error(place, fmt::format("{} '{}'{}", what, helper, suggestion(helper, offered)),
                         offered.empty() ? "it has none" : there_are + listed(offered));
      good = false;
    }
  };
  if (!fields.has("shape")) {  // wrong itself: a helper may still be one that nothing has
    static const Category wanted[] = {Category::helper};
    check_all(type_names(wanted), "there is no helper", "there are ");
    return good;
  }
  std::set<const TypeDeclaration*> seen;
  for (const std::any& one : fields.references("shape")) {
    const Entity entity = entity_of(one);
    const auto found = types_.find(identity(entity));
    const TypeDeclaration* type = found == types_.end() ? nullptr : found->second;
    if (!seen.insert(type).second) continue;
    const bool is_curve = std::holds_alternative<CurvePtr>(entity),
               is_surface = std::holds_alternative<SurfacePtr>(entity);
    std::vector<std::string> offered;
    if (type)
      offered = helpers_of(*type);
    else if (is_curve || is_surface)
      offered = helpers_of(is_curve ? Category::curve : Category::surface);
    check_all(offered, type ? "'" + type->name + "' has no helper" : "this shape has no helper");
    if (!fields.has("show")) continue;
    for (const std::any& any : fields.references("show")) {
      const auto& helper = std::any_cast<const Helper&>(any);
      if (helper.type != "de_casteljau" || std::find(offered.begin(), offered.end(), helper.type) == offered.end())
        continue;
      const Place& place = place_of_field(*show, helper.type);
      for (const char* parameter : {"t", "u", "v"})
        if (helper.values.has(parameter) != ((parameter[0] == 't') == is_curve)) {
          diagnostics_.error(place, is_curve ? "de Casteljau's construction on a curve needs 't' alone"
                                             : "de Casteljau's construction on a surface needs 'u' and 'v' alone");
          good = false;
          break;
        }
    }
  }
  if (good && show->is_map() && fields.has("show"))
    for (const std::any& any : fields.references("show")) {
      const auto& helper = std::any_cast<const Helper&>(any);
      if (const Value* map = show->find(helper.type); map && map->is_map())
        good = check_helper_values(helper, *map, fields.references("shape")) && good;
    }
  return good;
}

// Whether one of the object's shapes can have each kind of lines that it asks for.
bool Builder::check_lines(const Value& object, const Fields& fields) {
  const Value* lines = object.find("lines");
  if (!lines || !lines->is_map() || !fields.has("shape")) return true;
  const std::vector<std::any>& shapes = fields.references("shape");
  std::vector<std::string> had;
  for (const std::any& one : shapes)
    for (const std::string& kind : line_kinds_of(entity_of(one)))
      if (std::find(had.begin(), had.end(), kind) == had.end()) had.push_back(kind);
  if (shapes.empty()) return true;
  const auto found = types_.find(identity(entity_of(shapes.front())));
  const std::string what = shapes.size() > 1       ? "none of these shapes has"
                           : found == types_.end() ? "this shape has no"
                                                   : "'" + found->second->name + "' has no";
  bool good = true;
  for (const Entry& entry : lines->entries) {
    static const std::set<std::string, std::less<>> kKinds = {
        "boundary",          "sharp", "smooth", "silhouette", "parameter", "section", "intersection",
        "self_intersection", "curve"};
    const std::string& kind = entry.key.name;
    if (kKinds.count(kind) == 0 || std::find(had.begin(), had.end(), kind) != had.end()) continue;
    diagnostics_.error(entry.key.place, fmt::format("{} lines '{}'", what, kind), "it has " + listed(had));
    good = false;
  }
  const Value* parameter = lines->find("parameter");
  if (!good || !parameter || !fields.has("lines") || !fields.group("lines").has("parameter")) return good;
  const Fields& values = fields.group("lines").group("parameter");
  for (const char* name : {"at_u", "at_v"})
    if (const Value* given = parameter->find(name); given && values.has(name))
      good = check_line_values(*given, name, values.get<geometry::ParameterValues>(name), shapes) && good;
  return good;
}

}  // namespace lekalo::render
