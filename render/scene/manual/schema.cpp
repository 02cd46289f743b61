#include "render/scene/manual/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "render/scene/manual/manual.h"
#include "render/scene/types/sections.h"
#include "render/scene/values/value_text.h"
#include "render/suite/suite.h"

namespace lekalo::render {

using geometry::Dimension;
using geometry::Field;
using geometry::FieldType;
using geometry::Kind;
using Json = nlohmann::ordered_json;

namespace {

Json ref(const std::string& name) { return {{"$ref", "#/$defs/" + name}}; }

Json any_of(std::vector<Json> choices) {
  if (choices.size() == 1) return choices.front();
  return {{"anyOf", std::move(choices)}};
}

Json array_of(Json items, int least = 0, int most = 1 << 30) {
  Json list = {{"type", "array"}, {"items", std::move(items)}};
  if (least > 0) list["minItems"] = least;
  if (most < (1 << 30)) list["maxItems"] = most;
  return list;
}

Json words_of(const std::vector<std::string>& words) { return {{"enum", words}}; }

// Lists also accept a single item, and maps with `repeat` in place of items: counts are left to the reader.
Json one_or_list(const Json& item) { return any_of({item, array_of(item)}); }

// Formulas are texts; limits speak of the numbers only.
Json number_of(const FieldType& type) {
  const double scale = type.dimension == Dimension::angle ? 180 / geometry::kPi : 1;
  Json number = {{"type", {"number", "string"}}};
  if (std::isfinite(type.minimum))
    number[type.minimum_excluded ? "exclusiveMinimum" : "minimum"] = type.minimum * scale;
  if (std::isfinite(type.maximum))
    number[type.maximum_excluded ? "exclusiveMaximum" : "maximum"] = type.maximum * scale;
  return number;
}

// Numbers, words and lists as an editor writes them into a scene.
Json default_of(const std::string& text) {
  const Json value = Json::parse(text, nullptr, false);
  return value.is_number() || value.is_boolean() || value.is_array() ? value : Json(text);
}

// The page of the reference, beside the other documents, and the command that says the same.
std::string link_to(const TypeDeclaration& type) {
  return fmt::format("[{0}](docs/reference/{1}.md#{0}), `lekalo types {0}`", type.name, plural(type.category));
}

std::string category_key(std::span<const Category> categories) {
  std::string key = "any";
  for (const Category category : categories) key.append("_").append(geometry::name(category));
  return key;
}

class SchemaWriter {
 public:
  Json write();
  Json write_suite();

 private:
  Json value(const FieldType& type);
  Json single(const FieldType& type);
  Json properties(const std::vector<Field>& fields, std::vector<std::string>& required);
  Json map_of(const std::vector<Field>& fields, const std::vector<std::string>& also = {});
  Json type_definition(const TypeDeclaration& type);
  Json definition(const TypeDeclaration& type);
  Json thing(const std::vector<Category>& categories);
  Json section(const SectionDeclaration& declared);
  void add_common_definitions();

  Json definitions_ = Json::object();
};

void SchemaWriter::add_common_definitions() {
  definitions_["formula"] = {{"type", {"number", "string"}}, {"description", "number or formula"}};
  const Json formula = ref("formula");
  definitions_["coordinates"] = array_of(formula, 2, 3);
  definitions_["reference"] =
      any_of({{{"type", "string"}},
              {{"type", "object"},
               {"properties",
                {{"of", {{"type", "string"}}}, {"member", any_of({ref("formula"), array_of(ref("formula"), 1)})}}},
               {"required", {"of", "member"}},
               {"additionalProperties", false}}});
  definitions_["reference"]["description"] = "name of a thing of this scene, or a member of a family { of:, member: }";
  definitions_["repeat"] = {{"type", "object"},
                            {"description", "counters and their values: { i: 0..5 }, { q: [0, 0.5, 1] }"},
                            {"additionalProperties", {{"type", {"string", "array"}}}}};
  const Json place = {{"type", "object"},
                      {"properties",
                       {{"of", any_of({ref("reference"), {{"type", "object"}}})},
                        {"t", formula},
                        {"s", formula},
                        {"u", formula},
                        {"v", formula},
                        {"point", {{"type", {"array", "string", "object", "number"}}}},
                        {"repeat", ref("repeat")}}},
                      {"additionalProperties", false}};
  definitions_["place_on"] = place;
  const Json names = one_or_list({{"type", {"string", "integer", "object"}}});
  definitions_["selector"] = {
      {"type", "object"},
      {"description",
       "faces, edges or vertices of a body by what holds for all of them: { of: part, between: [end, side] }"},
      {"properties",
       {{"of", any_of({ref("reference"), {{"type", "object"}}})},
        {"face", names},
        {"edge", names},
        {"vertex", names},
        {"between", array_of({{"type", {"string", "integer"}}}, 2, 2)},
        {"of_face", names},
        {"parallel", ref("direction")},
        {"new_in", ref("reference")},
        {"extreme", ref("direction")},
        {"all", one_or_list(ref("selector"))},
        {"not", one_or_list(ref("selector"))},
        {"repeat", ref("repeat")}}},
      {"additionalProperties", false}};
  definitions_["place"] = any_of({ref("coordinates"), ref("reference"), ref("place_on"), ref("selector")});
  definitions_["place"]["description"] =
      "coordinates, the name of a point, a place { of: curve, t: ... }, or one of a body { of: part, extreme: x }";
  const Json vector_on = {{"type", "object"},
                          {"properties",
                           {{"of", any_of({ref("reference"), {{"type", "object"}}})},
                            {"t", formula},
                            {"s", formula},
                            {"u", formula},
                            {"v", formula},
                            {"vector", words_of({"tangent", "normal", "binormal", "du", "dv"})}}},
                          {"required", {"of", "vector"}},
                          {"additionalProperties", false}};
  definitions_["direction"] = any_of({words_of({"x", "y", "z", "-x", "-y", "-z"}), ref("coordinates"), vector_on});
  const Json axis = {{"type", "object"},
                     {"properties", {{"through", ref("place")}, {"along", ref("direction")}}},
                     {"additionalProperties", false}};
  definitions_["axis"] = any_of({ref("direction"), axis});
  definitions_["frame"] = {{"type", "object"},
                           {"properties", {{"origin", ref("place")}, {"z", ref("direction")}, {"x", ref("direction")}}},
                           {"additionalProperties", false}};
  definitions_["range"] = array_of(formula, 2, 2);
  const Json table = {{"type", "object"}, {"properties", {{"file", {{"type", "string"}}}}}, {"required", {"file"}}};
  definitions_["numbers"] = any_of({formula, array_of(any_of({formula, {{"type", "object"}}})), table});
  definitions_["points"] = any_of({array_of(ref("place")), table});
  const auto rows_of = [&](const char* row) {
    const Json repeated = {{"type", "object"},
                           {"properties", {{"repeat", ref("repeat")}, {"row", ref(row)}}},
                           {"required", {"repeat", "row"}},
                           {"additionalProperties", false}};
    return array_of(any_of({ref(row), repeated}));
  };
  definitions_["net"] = any_of({rows_of("points"), table});
  definitions_["indices"] = rows_of("numbers");
  definitions_["number_grid"] = any_of({array_of(ref("numbers")), table});
  const Json step = {{"type", "object"},
                     {"properties",
                      {{"translate", ref("direction")},
                       {"rotate", formula},
                       {"axis", ref("axis")},
                       {"scale", any_of({formula, array_of(formula, 3, 3)})},
                       {"mirror", ref("direction")},
                       {"matrix", ref("number_grid")},
                       {"pose", {{"type", "string"}}},
                       {"about", ref("place")},
                       {"repeat", ref("repeat")}}},
                     {"additionalProperties", false}};
  definitions_["transform"] = one_or_list(step);
  const Json display = {
      {"type", "object"}, {"properties", {{"srgb", array_of(formula, 3, 3)}}}, {"required", {"srgb"}}};
  definitions_["color"] = any_of({formula, array_of(formula, 3, 3), display});
  definitions_["color"]["description"] =
      "CSS name, '#rrggbb' in quotes, [r, g, b] linear, a grey, or { srgb: [r, g, b] }";
  const Json on_page = {{"type", "object"},
                        {"properties", {{"page", array_of({{"type", "string"}}, 2, 2)}}},
                        {"required", {"page"}},
                        {"additionalProperties", false}};
  definitions_["anchor"] = any_of({ref("place"), on_page});
  definitions_["label"] = {
      {"type", {"string", "number"}},
      {"description", "TeX in single quotes; %i a counter, %(n + 1) a formula, %% a percent sign"}};
  definitions_["page_length"] = {{"type", {"string", "number"}}, {"description", "with unit: 5 mm, 2 pt, 10 px"}};
}

Json SchemaWriter::single(const FieldType& type) {
  switch (type.kind) {
    case Kind::number:
    case Kind::integer:
      return number_of(type);
    case Kind::boolean:
      return {{"type", "boolean"}};
    case Kind::choice:
      return words_of(type.choices);
    case Kind::words:
      return one_or_list(words_of(type.choices));
    case Kind::text:
      return {{"type", {"string", "number", "boolean"}}};
    case Kind::file:
    case Kind::name:
      return {{"type", "string"}};
    case Kind::point:
      return ref("place");
    case Kind::direction:
    case Kind::vector:
      return ref("direction");
    case Kind::axis:
      return ref("axis");
    case Kind::frame:
      return ref("frame");
    case Kind::range:
      return ref("range");
    case Kind::rectangle:
      return {{"type", "object"},
              {"properties", {{"u", ref("range")}, {"v", ref("range")}}},
              {"required", {"u", "v"}},
              {"additionalProperties", false}};
    case Kind::points:
    case Kind::points2:
      return ref("points");
    case Kind::net:
      return ref("net");
    case Kind::numbers:
    case Kind::formulas:
      return ref("numbers");
    case Kind::number_grid:
      return ref("number_grid");
    case Kind::indices:
      return ref("indices");
    case Kind::knots:
      return any_of(
          {words_of(type.choices.empty() ? std::vector<std::string>{"clamped", "uniform", "chord_length", "centripetal"}
                                         : type.choices),
           ref("numbers")});
    case Kind::color: {
      if (std::find(type.categories.begin(), type.categories.end(), Category::texture) == type.categories.end())
        return ref("color");
      return any_of({ref("color"), thing({Category::texture})});
    }
    case Kind::formula:
      return ref("formula");
    case Kind::reference:
    case Kind::references: {
      std::vector<Json> choices{ref("reference"), thing(type.categories)};
      // Solids that are put together give their boundary where a body is asked for.
      if (std::find(type.categories.begin(), type.categories.end(), Category::body) != type.categories.end())
        choices.push_back(thing({Category::shape}));
      if (std::find(type.categories.begin(), type.categories.end(), Category::point) != type.categories.end())
        choices.push_back(ref("coordinates"));
      if (!section_of(type.categories.front())) choices.erase(choices.begin());
      if (is_geometry(type.categories.front())) choices.push_back(ref("selector"));
      if (type.fields) choices.push_back(map_of(*type.fields));
      const Json one = any_of(std::move(choices));
      return type.kind == Kind::references ? one_or_list(one) : one;
    }
    case Kind::group:
      return map_of(*type.fields);
    case Kind::groups:
      return one_or_list(map_of(*type.fields, {"repeat"}));
    case Kind::transform:
      return ref("transform");
    case Kind::page_length:
      return ref("page_length");
    case Kind::picture_size:
      return array_of({{"type", {"number", "string"}}}, 2, 2);
    case Kind::texts:
      return one_or_list({{"type", "string"}});
    case Kind::command:
      return one_or_list({{"type", {"string", "number"}}});
    case Kind::page_lengths:
      return one_or_list(ref("page_length"));
    case Kind::anchor:
      return ref("anchor");
    case Kind::counts:
      return ref("numbers");
    case Kind::label:
      return ref("label");
    case Kind::labels:
      return one_or_list(ref("label"));
    case Kind::name_rows:
      return array_of(array_of(ref("reference"), 1), 1);
    case Kind::helpers: {
      Json all = Json::object(), names = Json::array();
      for (const TypeDeclaration& type : all_types()) {
        if (type.category != Category::helper) continue;
        all[type.name] = definition(type);
        names.push_back({{"const", type.name}, {"description", type.description}});
      }
      const Json map = {{"type", "object"}, {"properties", all}, {"additionalProperties", false}};
      return any_of({map, one_or_list({{"anyOf", names}})});
    }
  }
  return Json::object();
}

Json SchemaWriter::value(const FieldType& type) {
  Json one = single(type);
  if (!type.choices.empty() && type.kind != Kind::choice && type.kind != Kind::words && type.kind != Kind::knots)
    one = any_of({words_of(type.choices), one});
  if (!type.per_direction) return one;
  return any_of({one,
                 {{"type", "object"},
                  {"properties", {{"u", one}, {"v", one}}},
                  {"required", {"u", "v"}},
                  {"additionalProperties", false}}});
}

Json SchemaWriter::properties(const std::vector<Field>& fields, std::vector<std::string>& required) {
  Json all = Json::object();
  for (const Field& field : fields) {
    Json one = value(field.type);
    one["description"] = fmt::format("{} ({})", field.description, value_text(field.type));
    one["markdownDescription"] = fmt::format("{}  \n*{}*", field.description, value_text(field.type));
    if (!field.default_text.empty()) {
      one["description"] = one["description"].get<std::string>() + "; default " + field.default_text;
      one["markdownDescription"] =
          fmt::format("{}, default `{}`", one["markdownDescription"].get<std::string>(), field.default_text);
      one["default"] = default_of(field.default_text);
    }
    if (field.type.kind == Kind::frame) {
      all["center"] = ref("place");
      all["normal"] = ref("direction");
      all["axis"] = ref("axis");
    } else if (field.required && field.default_text.empty()) {
      required.push_back(field.name);
    }
    all[field.name] = std::move(one);
  }
  return all;
}

Json SchemaWriter::map_of(const std::vector<Field>& fields, const std::vector<std::string>& also) {
  std::vector<std::string> required;
  Json map = {{"type", "object"}, {"properties", properties(fields, required)}, {"additionalProperties", false}};
  for (const std::string& name : also) map["properties"][name] = name == "repeat" ? ref("repeat") : Json::object();
  if (!required.empty()) map["required"] = required;
  return map;
}

Json SchemaWriter::type_definition(const TypeDeclaration& type) {
  std::vector<std::string> required;
  Json all = properties(type.fields, required);
  const Json common = properties(common_fields(type.category), required);
  for (const auto& [name, one] : common.items())
    if (!all.contains(name)) all[name] = one;
  std::erase_if(required, [&](const std::string& name) { return name == "like" || name == "transform"; });
  const bool named = section_of(type.category);
  if (named) all["like"] = {{"type", "string"}};
  all["repeat"] = ref("repeat");
  if (takes_abbreviations(type.fields))
    all["let"] = {{"type", "object"}, {"additionalProperties", ref("formula")}, {"description", kLetDescription}};
  if (!is_implicit(type.category) && type.category != Category::helper) all["type"] = {{"const", type.name}};
  Json map = {{"description", type.description},
              {"markdownDescription", fmt::format("{}\n\n{}", type.description, link_to(type))},
              {"type", "object"},
              {"properties", all},
              {"additionalProperties", false}};
  // What a thing is like may bring the fields that it needs.
  if (!required.empty() && named)
    map["anyOf"] = Json::array({{{"required", required}}, {{"required", {"like"}}}});
  else if (!required.empty())
    map["required"] = required;
  return map;
}

Json SchemaWriter::definition(const TypeDeclaration& type) {
  const std::string name = std::string(geometry::name(type.category)) + "." + type.name;
  if (!definitions_.contains(name)) {
    definitions_[name] = Json::object();  // types refer to each other
    definitions_[name] = type_definition(type);
  }
  return ref(name);
}

// A map with a `type` of these categories; its other fields are those of the type.
Json SchemaWriter::thing(const std::vector<Category>& categories) {
  if (is_implicit(categories.front())) return definition(*find_type(geometry::name(categories.front()), categories));
  const bool type_needed = categories.front() != Category::camera && categories.front() != Category::integrator;
  const std::string key = category_key(categories);
  if (definitions_.contains(key)) return ref(key);
  definitions_[key] = Json::object();  // types refer to each other
  Json names = Json::array(), cases = Json::array();
  for (const TypeDeclaration& type : all_types()) {
    if (std::find(categories.begin(), categories.end(), type.category) == categories.end()) continue;
    const Json defined = definition(type);
    names.push_back({{"const", type.name},
                     {"description", type.description},
                     {"markdownDescription", fmt::format("{}\n\n{}", type.description, link_to(type))}});
    cases.push_back(
        {{"if", {{"properties", {{"type", {{"const", type.name}}}}}, {"required", {"type"}}}}, {"then", defined}});
  }
  Json map = {{"type", "object"}, {"properties", {{"type", {{"anyOf", names}}}}}};
  if (type_needed) map["anyOf"] = Json::array({{{"required", {"type"}}}, {{"required", {"like"}}}});
  map["allOf"] = std::move(cases);
  definitions_[key] = std::move(map);
  return ref(key);
}

Json SchemaWriter::section(const SectionDeclaration& declared) {
  using Shape = SectionDeclaration::Shape;
  switch (declared.shape) {
    case Shape::fields:
      return map_of(declared.fields);
    case Shape::named: {
      std::vector<Json> choices{thing(declared.categories)};
      if (declared.name == "geometry")
        choices.insert(choices.end(), {ref("coordinates"), ref("place_on"), ref("selector")});
      return {{"type", "object"}, {"additionalProperties", any_of(std::move(choices))}};
    }
    case Shape::list:
      if (declared.name == "attributes") {
        Json map = map_of(declared.fields, {"repeat"});
        map["additionalProperties"] = ref("formula");  // quantities of one's own
        return one_or_list(map);
      }
      return one_or_list(any_of({{{"type", "string"}}, map_of(declared.fields, {"repeat"})}));
    case Shape::things:
      return one_or_list(thing(declared.categories));
    case Shape::one_of:
      return thing(declared.categories);
    case Shape::numbers:
      return {{"type", "object"}, {"additionalProperties", any_of({ref("formula"), thing(declared.categories)})}};
    case Shape::free:
      break;
  }
  if (declared.name == "lekalo") return {{"const", 1}};
  if (declared.name == "include") {
    const Json map = {{"type", "object"},
                      {"properties",
                       {{"file", {{"type", "string"}}},
                        {"as", {{"type", "string"}}},
                        {"set", {{"type", "object"}, {"additionalProperties", ref("formula")}}}}},
                      {"required", {"file"}},
                      {"additionalProperties", false}};
    return one_or_list(any_of({{{"type", "string"}}, map}));
  }
  return {{"type", "object"}};
}

Json SchemaWriter::write() {
  add_common_definitions();
  Json all = Json::object();
  for (const SectionDeclaration& declared : sections()) {
    Json one = section(declared);
    one["description"] = declared.description;
    all[declared.name] = std::move(one);
  }
  return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
          {"title", "Lekalo scene"},
          {"type", "object"},
          {"properties", all},
          {"required", {"lekalo"}},
          {"additionalProperties", false},
          {"$defs", definitions_}};
}

// Fields of `defaults` and of each test; what a test needs may come from the defaults.
Json SchemaWriter::write_suite() {
  add_common_definitions();
  Json all = {{"lekalo_suite", {{"const", 1}, {"description", "version of the language of suites: 1; the first key"}}}};
  for (const SuiteSection& section : suite_sections()) {
    Json one = {{"type", "string"}};
    if (section.name == "defaults") one = map_of(section.fields);
    if (section.name == "tests") {
      Json test = map_of(section.fields, {"repeat", "set"});
      test["properties"]["set"] = {{"type", "object"},
                                   {"additionalProperties", ref("formula")},
                                   {"description", "parameters of the scene; formulas may use the counters of repeat"}};
      one = one_or_list(test);
    }
    one["description"] = section.description;
    all[section.name] = std::move(one);
  }
  return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
          {"title", "Lekalo regression suite"},
          {"type", "object"},
          {"properties", all},
          {"required", {"lekalo_suite", "tests"}},
          {"additionalProperties", false},
          {"$defs", definitions_}};
}

}  // namespace

std::string suite_schema() { return SchemaWriter().write_suite().dump(2) + "\n"; }

std::string scene_schema() { return SchemaWriter().write().dump(2) + "\n"; }

}  // namespace lekalo::render
