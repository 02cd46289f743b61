// lekalo trace: everything that rays meet, in order.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "command.h"
#include "json.h"
#include "render/trace/world.h"

namespace lekalo::command {

namespace {

using geometry::Line;
using geometry::Vec3;

struct Options {
  SceneOptions scene;
  std::string ray, rays;
  bool json = false;
};

Line line_of(const std::array<double, 6>& x, const std::string& place) {
  const Line line{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
  const double length = glm::length(line.direction);
  if (!(length > 0 && length < geometry::kInfinity))
    throw UsageError(fmt::format("{}: the direction of a ray must not be zero", place));
  return line;
}

std::vector<Line> lines_of(const Options& options) {
  if (options.ray.empty() == options.rays.empty())
    throw UsageError("trace takes --ray ox,oy,oz,dx,dy,dz or --rays FILE");
  std::array<double, 6> x;
  if (!options.ray.empty()) {
    const std::vector<double> numbers = parse_numbers(options.ray, 6, "--ray");
    std::copy(numbers.begin(), numbers.end(), x.begin());
    return {line_of(x, "--ray")};
  }
  const render::Table table = load_table(options.rays);
  if (table.column_count != 6)
    throw UsageError(fmt::format("{}: a ray is six numbers, origin and direction; these rows have {}", options.rays,
                                 table.column_count));
  std::vector<Line> lines;
  for (size_t row = 0; row < table.row_count(); ++row) {
    for (size_t k = 0; k < 6; ++k) x[k] = table.at(row, k);
    lines.push_back(line_of(x, fmt::format("{}:{}", options.rays, table.lines[row])));
  }
  return lines;
}

// What the model calls a face; empty where it has only a number.
std::string face_name(const render::Object& object, int face) {
  const auto* body = std::get_if<geometry::BodyPtr>(&object.shape);
  if (!body || face < 0 || face >= static_cast<int>((*body)->faces.size())) return {};
  return (*body)->faces[face].origin.text();
}

ordered_json trace(const render::World& world, const Line& line) {
  const double length = glm::length(line.direction);
  render::Ray ray;
  ray.origin = line.origin;
  ray.direction = line.direction / length;
  ordered_json hits = ordered_json::array();
  for (const render::Hit& hit : world.all_hits(ray)) {
    const render::SurfacePoint point = world.surface_point(ray, hit);
    const render::Object& object = world.object(point);
    const std::string face = face_name(object, hit.face);
    ordered_json one;
    one["object"] = object.name;
    one["object_index"] = point.object;
    one["face"] = hit.face;
    one["face_name"] = face.empty() ? ordered_json(nullptr) : ordered_json(face);
    one["t"] = hit.t / length;
    one["u"] = point.u;
    one["v"] = point.v;
    one["point"] = to_json(point.position);
    one["normal"] = to_json(point.normal);
    one["geometric_normal"] = to_json(point.geometric_normal);
    hits.push_back(std::move(one));
  }
  ordered_json out;
  out["origin"] = to_json(line.origin);
  out["direction"] = to_json(line.direction);
  out["hits"] = std::move(hits);
  return out;
}

std::string vector_text(const ordered_json& v) { return digits(Vec3(v[0], v[1], v[2])); }

void print(const ordered_json& traced) {
  fmt::print("ray {} {}: {} hit{}\n", vector_text(traced["origin"]), vector_text(traced["direction"]),
             traced["hits"].size(), traced["hits"].size() == 1 ? "" : "s");
  for (const auto& hit : traced["hits"]) {
    const std::string object = hit["object"];
    const int face = hit["face"];
    fmt::print("  t      {}\n", digits(hit["t"].get<double>()));
    fmt::print("  object {}, face {}\n",
               object.empty() ? fmt::format("number {}", hit["object_index"].get<int>()) : object,
               hit["face_name"].is_null() ? fmt::format("{}", face)
                                          : fmt::format("{} ({})", face, hit["face_name"].get<std::string>()));
    fmt::print("  u, v   {} {}\n", digits(hit["u"].get<double>()), digits(hit["v"].get<double>()));
    fmt::print("  point  {}\n", vector_text(hit["point"]));
    fmt::print("  normal {}\n\n", vector_text(hit["normal"]));
  }
}

int run(const Options& options) {
  const std::vector<Line> lines = lines_of(options);
  const render::World world(options.scene.load().model);
  ordered_json all = ordered_json::array();
  for (const Line& line : lines) {
    ordered_json one = trace(world, line);
    demand_finite(one);
    if (options.json)
      all.push_back(std::move(one));
    else
      print(one);
  }
  if (options.json) fmt::print("{}\n", (options.rays.empty() ? all[0] : ordered_json{{"rays", all}}).dump(2));
  return kDone;
}

}  // namespace

void add_trace(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("trace", "All hits of rays with the scene's objects, in order");
  sub->footer(
      "Examples:\n"
      "  lekalo trace ring.yaml --ray 0,0,5,0,0,-1\n"
      "  lekalo trace ring.yaml --rays rays.csv --json\n\n"
      "Hits are those that a camera's ray has, from the origin on; t counts in lengths of the direction as given.\n"
      "u and v are the surface's own parameters: evaluate takes them.");
  auto options = std::make_shared<Options>();
  options->scene.add_to(*sub);
  sub->add_option("--ray", options->ray, "origin and direction; formulas without names")
      ->type_name("OX,OY,OZ,DX,DY,DZ");
  sub->add_option("--rays", options->rays, "a table of rays, one a row: ox, oy, oz, dx, dy, dz")->type_name("FILE");
  sub->add_flag("--json", options->json, "print JSON");
  sub->callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace lekalo::command
