// Faces, edges and vertices of bodies where a surface, a curve or a point may stand, and the places that they make.
//
//   { of: part, face: end }              by name or number; in a repeat also by a formula: edge: 2*i
//   { of: part, edge: 3 }
//   { of: part, vertex: start.2 }
//   { of: part, between: [end, side] }   edges in which two faces meet
//   { of: part, of_face: end }           what belongs to a face
//   { of: part, parallel: z }
//   { of: part, new_in: part }           what none of the bodies had of which it is made
//   { of: part, extreme: z }             the farthest of its edges, faces or vertices; as a point: that of the whole
//   all: [..], not: {..}                 further conditions
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "geometry/bodies/booleans/solid_boundary.h"
#include "geometry/bodies/topology/landmarks.h"
#include "geometry/expression/nearest_name.h"
#include "geometry/transformed.h"
#include "render/scene/build/builder.h"
#include "render/scene/values/scalars.h"
#include "render/scene/values/words.h"

namespace lekalo::render {

using geometry::Body;
using geometry::BodyPtr;
using geometry::CurvePtr;
using geometry::Element;
using geometry::Selector;
using geometry::SurfacePtr;

namespace {

constexpr size_t kMaxCandidates = 5;

// Conditions of a selector, beside `of`.
const std::set<std::string> kConditions = {"face",     "edge",   "vertex",  "between", "of_face",
                                           "parallel", "new_in", "extreme", "all",     "not"};

bool is_wanted(std::span<const Category> wanted, Category category) {
  return std::find(wanted.begin(), wanted.end(), category) != wanted.end();
}

Category category_of(Element element) {
  return element == Element::face ? Category::surface : element == Element::edge ? Category::curve : Category::point;
}

// What a selector is for: what its conditions speak of, or what is wanted, curves or surfaces as they come first.
Element element_of(const Value& map, std::span<const Category> wanted) {
  if (map.find("face")) return Element::face;
  if (map.find("vertex")) return Element::vertex;
  if (map.find("edge") || map.find("between")) return Element::edge;
  for (const Category category : wanted) {
    if (category == Category::curve) return Element::edge;
    if (category == Category::surface) return Element::face;
  }
  return Element::vertex;
}

// A formula in which a counter of the repeats around it stands: i, 2*i + 1.
bool speaks_of_counters(const Value& value, const Counters& counters) {
  if (value.quoted || counters.values.empty()) return false;
  const auto parsed = geometry::Expression::parse(value.text);
  const auto* formula = std::get_if<geometry::Expression>(&parsed);
  return formula && std::any_of(counters.values.begin(), counters.values.end(), [&](const auto& counter) {
           return std::find(formula->names().begin(), formula->names().end(), counter.name) != formula->names().end();
         });
}

Built built(const Body& body, Element element, int index) {
  if (element == Element::face) return {Category::surface, body.faces[index].surface};
  if (element == Element::edge) return {Category::curve, body.edges[index].curve};
  return {Category::point, body.vertices[index].point};
}

}  // namespace

bool is_selector(const Value& map) {
  if (!map.is_map() || !map.find("of") || map.find("type") || map.find("like")) return false;
  const auto is_meant = [](const Entry& entry) {
    return kConditions.contains(entry.key.name) ||
           (entry.key.name.size() > 2 && geometry::nearest_name(entry.key.name, kConditions));
  };
  return std::any_of(map.entries.begin(), map.entries.end(), is_meant);
}

// A name, a number of the list of 'lekalo measure --topology' or a formula of counters for it, or several of them.
std::optional<std::vector<std::string>> Builder::read_element_names(const Value& value, const Counters& counters,
                                                                    const char* number_of) {
  std::vector<std::string> names;
  for (const Scoped& item : items(value, counters)) {
    const Value& name = with_counters(*item.value, item.counters);
    if (name.invalid) return std::nullopt;
    if (!name.is_scalar() || name.text.empty()) {
      diagnostics_.error(name.place, fmt::format("expected a name, found {}", kind_name(name)),
                         "'lekalo measure --topology' lists the names");
      return std::nullopt;
    }
    if (speaks_of_counters(name, item.counters)) {
      const auto number = parameters_.integer(name, item.counters);
      if (!number) return std::nullopt;
      names.push_back(fmt::format("{}.{}", number_of, *number));
      continue;
    }
    const bool is_number = std::all_of(name.text.begin(), name.text.end(), [](char c) { return c >= '0' && c <= '9'; });
    names.push_back(is_number ? fmt::format("{}.{}", number_of, name.text) : name.text);
  }
  return names;
}

std::optional<Selector> Builder::read_selector(const Value& map, const Counters& counters) {
  Selector selector;
  if (!map.is_map()) {
    diagnostics_.error(map.place, fmt::format("expected conditions, found {}", kind_name(map)),
                       "for example { between: [end, side] }");
    return std::nullopt;
  }
  bool good = true;
  const auto take = [&](auto& into, auto&& value) {
    if (value)
      into = *std::move(value);
    else
      good = false;
  };
  for (const Entry& entry : map.entries) {
    const std::string& key = entry.key.name;
    const Value& value = entry.value;
    if (key == "of" || key == "repeat") continue;
    if (key == "face" || key == "edge" || key == "vertex") {
      take(selector.names, read_element_names(value, counters, key.c_str()));
    } else if (key == "between") {
      take(selector.between, read_element_names(value, counters, "face"));
    } else if (key == "of_face") {
      take(selector.of_face, read_element_names(value, counters, "face"));
    } else if (key == "parallel") {
      take(selector.parallel, read_vector(value, counters, true));
    } else if (key == "extreme") {
      take(selector.extreme, read_vector(value, counters, true));
    } else if (key == "new_in") {
      take(selector.new_to, read_operands(value, counters));
    } else if (key == "all" || key == "not") {
      for (const Scoped& item : items(value, counters)) {
        auto one = read_selector(*item.value, item.counters);
        if (one)
          (key == "all" ? selector.all : selector.none).push_back(*std::move(one));
        else
          good = false;
      }
    } else {
      const std::vector<std::string> known(kConditions.begin(), kConditions.end());
      diagnostics_.error(entry.key.place, fmt::format("unknown condition '{}'{}", key, suggestion(key, known)),
                         "there are " + listed(known));
      good = false;
    }
  }
  return good ? std::optional(std::move(selector)) : std::nullopt;
}

// The bodies from which a body was made, or a solid put together.
std::optional<std::vector<BodyPtr>> Builder::read_operands(const Value& value, const Counters& counters) {
  static const Category wanted[] = {Category::body, Category::shape};
  const auto made = refer(value, counters, wanted);
  if (!made) return std::nullopt;
  std::vector<BodyPtr> operands;
  if (const auto* solid = std::any_cast<geometry::ShapePtr>(&made->value)) {
    try {
      operands = geometry::operands_of(*solid);
    } catch (const std::exception& error) {
      diagnostics_.error(value.place, fmt::format("the boundary of this solid: {}", error.what()));
      return std::nullopt;
    }
  } else if (const auto found = operands_.find(std::any_cast<const BodyPtr&>(made->value).get());
             found != operands_.end()) {
    operands = found->second;
  }
  if (!operands.empty()) return operands;
  diagnostics_.error(value.place, fmt::format("'{}' is made of no other body: all of its edges are new", value.text),
                     "name the result of an operation on bodies");
  return std::nullopt;
}

// What a body's construction was given.
void Builder::note_operands(const std::any& made, const std::vector<Field>& declared, const Fields& fields,
                            const Affine& placed) {
  const auto* body = std::any_cast<BodyPtr>(&made);
  if (!body) return;
  kept_bodies_.push_back(*body);
  std::vector<BodyPtr>& operands = operands_[body->get()];
  operands.clear();
  const std::function<void(const std::any&)> look = [&](const std::any& value) {
    if (const auto* one = std::any_cast<BodyPtr>(&value))
      operands.push_back(placed.is_identity() ? *one
                                              : std::make_shared<const Body>(geometry::transformed(**one, placed)));
    if (const auto* several = std::any_cast<std::vector<std::any>>(&value))
      for (const std::any& one : *several) look(one);
  };
  for (const Field& field : declared)
    if (fields.has(field.name)) look(fields.any(field.name));
}

// What of a body a selector means: at least one thing, of a kind that is wanted.
std::optional<Builder::Choice> Builder::choose(const Value& map, const Counters& counters,
                                               std::span<const Category> wanted) {
  static const Category bodies[] = {Category::body};
  const auto of = refer(*map.find("of"), counters, bodies);
  const auto selector = read_selector(map, counters);
  if (!of || !selector) return std::nullopt;
  const BodyPtr& body = std::any_cast<const BodyPtr&>(of->value);
  const Element element = element_of(map, wanted);
  auto chosen = attempt(map, "selector", [&] { return geometry::select(*body, element, *selector); });
  if (!chosen) return std::nullopt;
  if (!is_wanted(wanted, category_of(element))) {
    const Category category = category_of(element);
    diagnostics_.error(map.place,
                       fmt::format("this is {}, but {} is wanted here", describe({&category, 1}), describe(wanted)));
    return std::nullopt;
  }
  if (chosen->empty()) {
    diagnostics_.error(map.place, "nothing of the body is like that",
                       "'lekalo measure --topology' lists its faces, edges and vertices");
    return std::nullopt;
  }
  return Choice{body, element, *std::move(chosen)};
}

// Where one thing is wanted.
std::optional<Builder::Choice> Builder::choose_one(const Value& map, const Counters& counters,
                                                   std::span<const Category> wanted) {
  auto choice = choose(map, counters, wanted);
  if (!choice || choice->indices.size() == 1) return choice;
  std::vector<std::string> names;
  for (const int k : choice->indices) names.push_back(geometry::described(*choice->body, choice->element, k));
  diagnostics_.error(map.place, fmt::format("{} things are meant by this; one is wanted here", names.size()),
                     "they are " + listed(names, kMaxCandidates));
  return std::nullopt;
}

std::optional<std::vector<Built>> Builder::selected(const Value& map, const Counters& counters,
                                                    std::span<const Category> wanted) {
  const auto choice = choose(map, counters, wanted);
  if (!choice) return std::nullopt;
  std::vector<Built> all;
  for (const int k : choice->indices) all.push_back(built(*choice->body, choice->element, k));
  return all;
}

std::optional<Built> Builder::select_one(const Value& map, const Counters& counters, std::span<const Category> wanted) {
  const auto choice = choose_one(map, counters, wanted);
  if (!choice) return std::nullopt;
  return built(*choice->body, choice->element, choice->indices.front());
}

// The faces, edges or vertices that a name stands for: the first kind of which there are any, of those that are wanted.
std::optional<std::vector<Built>> Builder::elements_called(const Body& body, std::string_view name, const Value& asked,
                                                           std::span<const Category> wanted) {
  const Element kinds[] = {Element::face, Element::edge, Element::vertex};
  for (const bool any : {false, true})
    for (const Element element : kinds) {
      if (!any && !is_wanted(wanted, category_of(element))) continue;
      std::vector<Built> all;
      for (const int k : geometry::called(body, element, name)) all.push_back(built(body, element, k));
      if (!all.empty()) return all;
    }
  Element likely = Element::face;
  for (const Element element : {Element::vertex, Element::edge, Element::face})
    if (is_wanted(wanted, category_of(element))) likely = element;
  if (name.starts_with("edge.")) likely = Element::edge;
  if (name.starts_with("vertex.")) likely = Element::vertex;
  const std::vector<std::string> names = geometry::names_of(body, likely);
  const char* word = likely == Element::face ? "face" : likely == Element::edge ? "edge" : "vertex";
  const std::string whole = asked.text.substr(0, asked.text.size() - name.size() - 1);
  diagnostics_.error(asked.place, fmt::format("'{}' has no {} '{}'{}", whole, word, name, suggestion(name, names)),
                     "the nearest are " + listed(geometry::nearest_names(name, names, kMaxCandidates)));
  return std::nullopt;
}

std::optional<Vec3> Builder::read_selected_place(const Value& map, const Counters& counters) {
  static const Category wanted[] = {Category::curve, Category::surface, Category::body};
  static const Category vertices[] = {Category::point};
  if (map.find("extreme") && map.entries.size() == 2) {
    const auto of = refer(*map.find("of"), counters, wanted);
    const auto way = read_vector(*map.find("extreme"), counters, true);
    if (!of || !way) return std::nullopt;
    const Entity entity = entity_of(of->value);
    return attempt(map, "extreme", [&]() -> Vec3 {
      const geometry::Box3 box = bounds(entity);
      if (const auto* body = std::get_if<BodyPtr>(&entity)) return geometry::extreme_point(body->get(), box, *way);
      if (const auto* curve = std::get_if<CurvePtr>(&entity)) return geometry::extreme_point(curve->get(), box, *way);
      const auto* surface = std::get_if<SurfacePtr>(&entity);
      if (!surface || !(*surface)->bounded()) throw std::invalid_argument("this has no farthest point");
      return geometry::extreme_point(surface->get(), box, *way);
    });
  }
  if (!map.find("face") && !map.find("edge") && !map.find("between")) {
    const auto vertex = select_one(map, counters, vertices);
    return vertex ? std::optional(std::any_cast<Vec3>(vertex->value)) : std::nullopt;
  }
  if (!map.find("face")) {
    static const Category curves[] = {Category::curve};
    const auto edge = select_one(map, counters, curves);
    return edge ? std::optional(geometry::middle_of(*std::any_cast<const CurvePtr&>(edge->value))) : std::nullopt;
  }
  const auto face = choose_one(map, counters, std::array{Category::surface});
  return face ? std::optional(geometry::inner_point(*face->body, face->indices.front())) : std::nullopt;
}

// Where a dimension of such a place may begin: on the border of a face, anywhere at the end of a body.
std::vector<Vec3> Builder::spots_of(const Value& map, const Counters& counters) {
  static const Category bodies[] = {Category::body};
  static const Category all[] = {Category::curve, Category::surface, Category::body};
  if (!is_selector(map) || !(map.find("face") || map.find("extreme"))) return {};
  const auto of = refer(*map.find("of"), counters, map.find("face") ? bodies : std::span<const Category>(all));
  const auto* body = of ? std::any_cast<BodyPtr>(&of->value) : nullptr;
  if (!body) return {};
  if (!map.find("face")) {
    const auto way = read_vector(*map.find("extreme"), counters, true);
    return way ? geometry::points_at_end(**body, *way) : std::vector<Vec3>{};
  }
  const auto selector = read_selector(map, counters);
  const std::vector<int> chosen = selector ? geometry::select(**body, Element::face, *selector) : std::vector<int>{};
  return chosen.size() == 1 ? geometry::points_of_border(**body, chosen.front()) : std::vector<Vec3>{};
}

}  // namespace lekalo::render
