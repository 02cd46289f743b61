#include "command.h"

#include "geometry/bodies/booleans/solid_boundary.h"
#include "geometry/shapes/csg/csg.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <string_view>

#include "geometry/bodies/topology/copied_face.h"
#include "geometry/bodies/topology/selection.h"
#include "geometry/expression/expression.h"
#include "geometry/expression/nearest_name.h"
#include "render/scene/yaml/include.h"

namespace lekalo::command {

void SceneOptions::add_to(CLI::App& app) {
  app.add_option("scene", file, "scene file")->required()->type_name("FILE");
  app.add_option("--set", set, "value of a parameter, e.g. --set w=4; repeatable")->type_name("NAME=VALUE");
  add_allow_external(app, allow_external);
}

render::LoadOptions SceneOptions::load_options() const {
  render::LoadOptions options;
  options.allow_external = allow_external;
  for (const std::string& one : set) {
    const size_t equals = one.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError(fmt::format("--set takes NAME=VALUE, found '{}'", one));
    options.set_parameters.push_back({one.substr(0, equals), one.substr(equals + 1)});
  }
  return options;
}

render::LoadedScene SceneOptions::load() const {
  render::LoadedScene scene = render::load_scene(file, load_options());
  print_external_notes(scene, false);
  return scene;
}

void add_allow_external(CLI::App& app, bool& allow_external) {
  app.add_flag("--allow-external", allow_external,
               "let the scene run code from outside the program: libraries and commands that it names");
}

void print_external_notes(const render::LoadedScene& scene, bool all) {
  for (const render::ExternalNote& note : scene.external_notes) {
    const std::string place = render::where(note.place);
    if (all) fmt::print(stderr, "note: {}: {}\n", place, note.text);
    for (const std::string& doubt : note.doubts) fmt::print(stderr, "warning: {}: {}\n", place, doubt);
  }
}

std::string shell_word(const std::string& text) {
  const auto is_plain = [](unsigned char c) {
    return (c < 0x80 && std::isalnum(c)) ||
           std::string_view("_-+=:,./@%").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

render::Entity by_boundary(const render::Entity& entity, std::string* why_not) {
  // Trees of thousands of leaves are for rays.
  constexpr int kMaxLeaves = 64;
  const auto* shape = std::get_if<geometry::ShapePtr>(&entity);
  if (!shape || !geometry::has_boundary(**shape)) return entity;
  const auto* moved = dynamic_cast<const geometry::TransformedShape*>(shape->get());
  const auto* solid = dynamic_cast<const geometry::Csg*>(moved ? moved->original().get() : shape->get());
  if (!solid || solid->leaf_count() > kMaxLeaves) return entity;
  try {
    return geometry::boundary_of(*shape);
  } catch (const std::exception& error) {
    if (why_not) *why_not = error.what();
    return entity;
  }
}

namespace {

// part.end, part.edge.3, part.vertex.0: what of a body is called so; null where there is no such body.
const render::Entity* find_part(const render::LoadedScene& scene, const std::string& name) {
  static std::deque<render::Entity> parts;  // for as long as the command runs
  for (size_t dot = name.rfind('.'); dot != std::string::npos && dot > 0; dot = name.rfind('.', dot - 1)) {
    const auto whole = scene.model->geometry.find(name.substr(0, dot));
    if (whole == scene.model->geometry.end()) continue;
    std::string no_boundary;
    const render::Entity entity = by_boundary(whole->second, &no_boundary);
    const auto* shared = std::get_if<geometry::BodyPtr>(&entity);
    if (!no_boundary.empty())
      throw UsageError(fmt::format("'{}': the boundary of '{}' is not made: {}", name, whole->first, no_boundary));
    if (!shared) return nullptr;
    const geometry::Body& body = **shared;
    const std::string rest = name.substr(dot + 1);
    using geometry::Element;
    try {
      if (!called(body, Element::edge, rest).empty() && called(body, Element::face, rest).empty())
        return &parts.emplace_back(body.edges[one_called(body, Element::edge, rest, "")].curve);
      if (!called(body, Element::vertex, rest).empty() && called(body, Element::face, rest).empty())
        return &parts.emplace_back(body.vertices[one_called(body, Element::vertex, rest, "")].point);
      const int face = one_called(body, Element::face, rest, "");
      return &parts.emplace_back(std::make_shared<const geometry::Body>(face_alone(body, face)));
    } catch (const geometry::FieldError& error) {
      throw UsageError(fmt::format("'{}': {}; {}", name, error.what(), error.hint));
    }
  }
  return nullptr;
}

}  // namespace

const render::Entity& find_geometry(const render::LoadedScene& scene, const std::string& name) {
  const auto& geometry = scene.model->geometry;
  const auto found = geometry.find(name);
  if (found != geometry.end()) return found->second;
  if (const render::Entity* part = find_part(scene, name)) return *part;
  std::vector<std::string> names;
  for (const auto& [known, entity] : geometry) names.push_back(known);
  const auto nearest = geometry::nearest_name(name, names);
  throw UsageError(fmt::format("the scene has no geometry called '{}'{}", name,
                               scene.model->materials.contains(name) ? ": this is a material"
                               : nearest                             ? fmt::format(" (did you mean '{}'?)", *nearest)
                                                                     : ""));
}

render::Table load_table(const std::string& path) {
  render::Diagnostics diagnostics;
  std::string reason;
  auto text = render::read_file(path, render::kTableBytes, true, reason);
  if (!text) {
    diagnostics.unreadable({render::make_source(path, ""), 0, 0, 1}, fmt::format("cannot be read: {}", reason));
    throw render::SceneError(diagnostics);
  }
  auto table = render::read_table(render::make_source(path, std::move(*text), path), diagnostics);
  if (!table) throw render::SceneError(diagnostics);
  return std::move(*table);
}

std::string digits(double x) { return fmt::format("{:.17g}", x); }
std::string digits(const geometry::Vec3& v) { return fmt::format("{:.17g} {:.17g} {:.17g}", v.x, v.y, v.z); }

std::string not_finite(const std::string& number) {
  char* end = nullptr;
  const double value = std::strtod(number.c_str(), &end);
  // What is no number at all others refuse.
  return end == number.c_str() || std::isfinite(value) ? "" : fmt::format("'{}' is no finite number", number);
}

std::vector<double> parse_numbers(const std::string& text, size_t count, const std::string& option) {
  std::vector<double> numbers;
  size_t begin = 0;
  for (size_t i = 0, depth = 0; i <= text.size(); ++i) {
    if (i < text.size() && text[i] == '(') ++depth;
    if (i < text.size() && text[i] == ')' && depth > 0) --depth;
    if (i < text.size() && (text[i] != ',' || depth > 0)) continue;
    const std::string part = text.substr(begin, i - begin);
    begin = i + 1;
    auto parsed = geometry::Expression::parse(part);
    if (const auto* error = std::get_if<geometry::ExpressionError>(&parsed))
      throw UsageError(fmt::format("{}: '{}': {}", option, part, error->message));
    auto& expression = std::get<geometry::Expression>(parsed);
    if (const auto error = expression.bind({}))
      throw UsageError(fmt::format("{}: '{}': {}", option, part, error->message));
    numbers.push_back(expression());
    if (!std::isfinite(numbers.back())) throw UsageError(fmt::format("{}: '{}' is no finite number", option, part));
  }
  if (count > 0 && numbers.size() != count)
    throw UsageError(
        count == 1 ? fmt::format("{} takes one number, found {}", option, numbers.size())
                   : fmt::format("{} takes {} numbers with commas between, found {}", option, count, numbers.size()));
  return numbers;
}

}  // namespace lekalo::command
