// lekalo measure: lengths, areas, volumes and moments with their errors; topology; comparison with a table.
#include "measure.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "command.h"
#include "geometry/curves/operations/arc_blend_curve.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/queries/differential/plane_lines.h"
#include "geometry/queries/intersections/curve_intersections.h"
#include "geometry/queries/measures/enclosed_area.h"
#include "geometry/queries/measures/mass_properties.h"
#include "geometry/queries/measures/shape_measures.h"
#include "geometry/queries/quadrics/conic_of_curve.h"
#include "parameters.h"

namespace lekalo::command {

namespace {

using geometry::MassProperties;
using geometry::Measured;
using geometry::Vec3;

void put(ordered_json& out, const char* key, const Measured& measured) {
  out[key] = measured.value;
  out[std::string(key) + "_error"] = measured.error;
}

void put_centroid(ordered_json& out, const Vec3& centroid, double error) {
  out["centroid"] = to_json(centroid);
  out["centroid_error"] = error;
}

void put_conic(ordered_json& out, const geometry::Curve& curve) {
  const auto conic = geometry::conic_of(curve);
  if (!conic) return;
  out["conic"] = geometry::name(conic->kind);
  if (conic->kind == geometry::CanonicalConic::Kind::parabola) {
    out["vertex"] = to_json(conic->frame.origin);
    out["focal_length"] = conic->a;
  } else {
    out["center"] = to_json(conic->frame.origin);
    out["half_axes"] = {conic->a, conic->b};
  }
  out["axis"] = to_json(conic->frame.x);
}

void put(ordered_json& out, const MassProperties& mass) {
  put(out, "area", mass.area);
  out["closed"] = mass.closed;
  if (!mass.closed) return;
  put(out, "volume", mass.volume);
  put_centroid(out, mass.centroid, mass.centroid_error);
  out["inertia"] = to_json(mass.inertia);
  out["inertia_error"] = mass.inertia_error;
  out["principal_moments"] = to_json(mass.principal_moments);
  out["principal_axes"] = to_json(glm::transpose(mass.principal_axes));
}

void put(ordered_json& out, const geometry::SurfaceMeasures& measures) {
  put(out, "area", measures.area);
  put_centroid(out, measures.centroid, measures.centroid_error);
}

// Normals of the planes that the surface, or its lines of parameter, lie in.
void put_planes(ordered_json& out, const geometry::Surface& surface) {
  if (!surface.bounded()) return;
  const geometry::PlaneLines planes = geometry::plane_lines(surface);
  if (planes.surface) out["plane"] = to_json(*planes.surface);
  if (planes.along_u) out["plane_of_u_lines"] = to_json(*planes.along_u);
  if (planes.along_v) out["plane_of_v_lines"] = to_json(*planes.along_v);
}

geometry::SurfaceMeasures sum_of(const std::vector<geometry::SurfaceMeasures>& parts) {
  geometry::SurfaceMeasures sum;
  for (const geometry::SurfaceMeasures& one : parts) {
    sum.area.value += one.area.value;
    sum.area.error += one.area.error;
    sum.centroid += one.area.value * one.centroid;
  }
  if (!(sum.area.value > 0)) return sum;
  sum.centroid /= sum.area.value;
  for (const geometry::SurfaceMeasures& one : parts)
    sum.centroid_error +=
        (one.area.value * one.centroid_error + glm::length(one.centroid - sum.centroid) * one.area.error) /
        sum.area.value;
  return sum;
}

geometry::SurfaceMeasures measure_set(const render::SurfaceSet& set) {
  std::vector<geometry::SurfaceMeasures> parts;
  for (const geometry::SurfacePtr& surface : set) parts.push_back(geometry::measure(*surface));
  return sum_of(parts);
}

// An open shell bounds nothing: it has an area and a centroid as a surface has.
void put_body(ordered_json& out, const geometry::Body& body) {
  const MassProperties mass = geometry::measure(body);
  put(out, mass);
  if (mass.closed) return;
  std::vector<geometry::SurfaceMeasures> parts;
  for (int face = 0; face < static_cast<int>(body.faces.size()); ++face)
    parts.push_back(geometry::measure_face(body, face));
  const geometry::SurfaceMeasures sum = sum_of(parts);
  put_centroid(out, sum.centroid, sum.centroid_error);
}

// Places in each direction where two curves or surfaces are compared.
constexpr int kSamples = 65;
// Jumps of a joint that pass unless told otherwise.
constexpr double kSmooth = 1e-6;

struct Options {
  SceneOptions scene;
  std::string name, against, to, section, silhouette, position, cells, line, hausdorff, frechet, arc, at_length, chord,
      secant, stretch;
  std::vector<std::string> intersect;     // one, or two: common points of three
  std::optional<std::string> continuity;  // empty: of a body by itself
  std::optional<double> tolerance;
  std::optional<int> samples, order;
  int cubature = 0;  // points of the rule; 0: not asked for
  double turn = 20;  // degrees
  bool topology = false, regularity = false, self_intersection = false, nearest = false, nurbs = false,
       features = false, rim = false, json = false;
};

// Whether what --against names is a thing of the scene; else it is a file.
bool is_in_scene(const render::LoadedScene& scene, const std::string& against) {
  return scene.model->geometry.contains(against);
}

// A name without an ending that no file has was meant to be that of a thing of the scene.
void check_table_name(const render::LoadedScene& scene, const std::string& against) {
  std::error_code ignored;
  const std::filesystem::path path(against);
  if (!path.has_extension() && !path.has_parent_path() && !std::filesystem::exists(path, ignored))
    find_geometry(scene, against);
}

ordered_json as_json(const std::vector<render::ExternalNote>& notes) {
  ordered_json list = ordered_json::array();
  for (const render::ExternalNote& note : notes)
    list.push_back({{"place", render::where(note.place)}, {"fit", note.text}, {"doubts", note.doubts}});
  return list;
}

bool has_faces(const render::Entity& entity) {
  return std::holds_alternative<geometry::SurfacePtr>(entity) || std::holds_alternative<geometry::BodyPtr>(entity);
}

// A thing of the scene, or the point "x,y,z".
render::Entity thing_or_point(const render::LoadedScene& scene, const std::string& text, const std::string& option) {
  if (text.find(',') == std::string::npos) return find_geometry(scene, text);
  const std::vector<double> numbers = parse_numbers(text, 3, option);
  return Vec3(numbers[0], numbers[1], numbers[2]);
}

// The coordinates of a point of the scene, or those written: "x,y,z" or "u,v".
std::vector<double> place_named(const render::LoadedScene& scene, const std::string& text) {
  const auto commas = std::count(text.begin(), text.end(), ',');
  if (commas > 0) return parse_numbers(text, commas == 1 ? 2 : 3, "--position");
  if (const auto* point = std::get_if<Vec3>(&find_geometry(scene, text))) return {point->x, point->y, point->z};
  throw UsageError(fmt::format("'{}' is no point: --position takes a point of the scene, X,Y,Z, or U,V", text));
}

// The value of a parameter of the scene; angles in radians.
int print_parameter(const std::string& name, double value, bool json) {
  const ordered_json out{{"name", name}, {"kind", "parameter"}, {"value", value}};
  demand_finite(out);
  if (json)
    fmt::print("{}\n", out.dump(2));
  else
    fmt::print("parameter '{}'\nvalue              {}\n", name, digits(value));
  return kDone;
}

int run(const Options& options) {
  if (options.tolerance && options.against.empty() && options.intersect.empty() && !options.self_intersection &&
      !options.continuity)
    throw UsageError(
        "--tolerance belongs to --against SAMPLES.csv, --against NAME, --intersect NAME, --self-intersection or "
        "--continuity");
  if (options.intersect.size() > 2)
    throw UsageError("--intersect stands once, or twice for the common points of three surfaces");
  if (options.nearest && options.to.empty()) throw UsageError("--nearest belongs to --to");
  const render::LoadedScene scene = render::load_scene(options.scene.file, options.scene.load_options());
  const auto parameter = scene.model->parameters.find(options.name);
  if (parameter != scene.model->parameters.end() && !scene.model->geometry.contains(options.name))
    return print_parameter(options.name, parameter->second, options.json);
  const render::Entity& given = find_geometry(scene, options.name);
  // What asks for faces gets those of a solid that is put together; the plain measures ask for them themselves.
  const bool asks_for_faces = options.topology || !options.section.empty() || !options.silhouette.empty() ||
                              !options.intersect.empty() || options.continuity || options.cubature > 0;
  std::string no_boundary;
  const render::Entity entity = asks_for_faces ? by_boundary(given, &no_boundary) : given;
  if (options.topology && !no_boundary.empty())
    throw UsageError(fmt::format("'{}' has no topology: {}", options.name, no_boundary));
  print_external_notes(scene, !options.json);
  const bool of_pair = !options.against.empty() && is_in_scene(scene, options.against);
  const bool of_contours =
      has_faces(entity) && (!options.section.empty() || !options.silhouette.empty() || options.self_intersection ||
                            (options.intersect.size() == 1 && has_faces(find_geometry(scene, options.intersect[0]))));
  if (options.order && !of_pair)
    throw UsageError("--order belongs to --against NAME, another curve or surface of the scene");
  const bool of_solid = is_solid_without_faces(entity) && (!options.section.empty() || !options.silhouette.empty());
  if (options.samples && !of_pair && !of_contours && !of_solid)
    throw UsageError(
        "--samples belongs to --against NAME, another curve or surface of the scene, and to intersections, sections "
        "and silhouettes of surfaces");
  const double same_point = options.tolerance.value_or(geometry::kSamePoint);
  ordered_json out;
  void (*print)(const ordered_json&) = print_measures;
  if (options.features) {
    out = curve_shape(options.name, entity);
    print = print_curve_shape;
  } else if (!options.arc.empty()) {
    const std::vector<double> ends = parse_numbers(options.arc, 2, "--arc");
    out = arc_of(options.name, entity, ends[0], ends[1]);
    print = print_arc;
  } else if (!options.at_length.empty()) {
    out = parameter_at(options.name, entity, parse_numbers(options.at_length, 1, "--at-length")[0]);
    print = print_arc;
  } else if (!options.hausdorff.empty()) {
    out = hausdorff_between(options.name, entity, options.hausdorff, find_geometry(scene, options.hausdorff));
    print = print_nearness;
  } else if (!options.frechet.empty()) {
    out = frechet_between(options.name, entity, options.frechet, find_geometry(scene, options.frechet));
    print = print_nearness;
  } else if (options.nurbs) {
    out = nurbs_form(options.name, entity);
    print = print_nurbs_form;
  } else if (of_pair) {
    out = compare_pair(options.name, entity, options.against, find_geometry(scene, options.against),
                       options.samples.value_or(kSamples), options.order.value_or(2), options.tolerance);
    print = print_pair;
  } else if (!options.against.empty()) {
    check_table_name(scene, options.against);
    out = compare_with_table(options.name, entity, load_table(options.against), options.against, options.tolerance);
    print = print_comparison;
  } else if (!options.to.empty()) {
    out = distance_to(options.name, entity, options.to, thing_or_point(scene, options.to, "--to"), options.nearest);
    print = print_distance;
  } else if (!options.position.empty()) {
    out = position_of(options.name, entity, options.position, place_named(scene, options.position));
    print = print_position;
  } else if (options.continuity) {
    const render::Entity* other = options.continuity->empty() ? nullptr : &find_geometry(scene, *options.continuity);
    out = continuity_of(options.name, entity, *options.continuity, other, options.tolerance.value_or(kSmooth));
    print = print_continuity;
  } else if (of_contours) {
    const int samples = options.samples.value_or(0);
    if (!options.section.empty())
      out = section(options.name, entity, options.section, samples);
    else if (!options.silhouette.empty())
      out = silhouette_seen(options.name, entity, options.silhouette, scene.model->camera.get(), samples);
    else if (options.self_intersection)
      out = surface_self_intersections(options.name, entity, same_point, samples);
    else
      out = surface_intersections(options.name, entity, options.intersect[0],
                                  find_geometry(scene, options.intersect[0]), same_point, samples);
    print = print_contours;
  } else if ((!options.section.empty() || !options.silhouette.empty()) && is_solid_without_faces(entity)) {
    const int samples = options.samples.value_or(0);
    out = !options.section.empty()
              ? section_of_solid(options.name, entity, options.section, samples)
              : silhouette_of_solid(options.name, entity, options.silhouette, scene.model->camera.get(), samples);
    print = print_contours;
  } else if (!options.section.empty() || !options.silhouette.empty()) {
    throw UsageError(
        fmt::format("'{}' is neither a surface nor a body: sections and silhouettes are taken of those", options.name));
  } else if (options.self_intersection) {
    const auto* curve = std::get_if<geometry::CurvePtr>(&entity);
    if (!curve) throw UsageError(fmt::format("'{}' is neither a curve nor a surface", options.name));
    out = self_intersections(options.name, *curve, same_point);
    print = print_self_intersections;
  } else if (options.intersect.size() == 2) {
    out = common_points_of(
        {options.name, options.intersect[0], options.intersect[1]},
        {&entity, &find_geometry(scene, options.intersect[0]), &find_geometry(scene, options.intersect[1])},
        same_point);
    print = print_common_points;
  } else if (!options.intersect.empty()) {
    out = intersections(options.name, entity, options.intersect[0], find_geometry(scene, options.intersect[0]),
                        same_point);
    print = print_intersections;
  } else if (options.topology) {
    out = topology(options.name, entity);
    print = print_topology;
  } else if (options.rim) {
    out = rim_of(options.name, entity,
                 options.chord.empty() ? std::vector<double>() : parse_numbers(options.chord, 2, "--chord"),
                 options.secant.empty() ? nullptr : &find_geometry(scene, options.secant));
    print = print_rim;
  } else if (!options.stretch.empty()) {
    out = stretch_of(options.name, entity, options.stretch, find_geometry(scene, options.stretch),
                     options.samples.value_or(kSamples));
    print = print_stretch;
  } else if (options.regularity) {
    out = regularity(options.name, entity);
    print = print_regularity;
  } else if (options.cubature > 0) {
    out = cubature_of(options.name, entity, options.cubature, options.turn);
    print = print_cubature;
  } else if (!options.cells.empty()) {
    out = cells_of(options.name, entity, parse_numbers(options.cells, 2, "--cells"),
                   options.line.empty() ? std::vector<double>() : parse_numbers(options.line, 6, "--line"));
    print = print_cells;
  } else {
    out = measures(options.name, entity);
  }
  if (options.json && !scene.external_notes.empty()) out["external"] = as_json(scene.external_notes);
  demand_finite(out);
  if (options.json)
    fmt::print("{}\n", out.dump(2));
  else
    print(out);
  return out.value("passed", true) ? kDone : kDiffers;
}

}  // namespace

ordered_json measures(const std::string& name, const render::Entity& given) {
  ordered_json out;
  out["name"] = name;
  std::string no_boundary;
  const render::Entity entity = by_boundary(given, &no_boundary);
  try {
    if (const auto* curve = std::get_if<geometry::CurvePtr>(&entity)) {
      const geometry::CurveMeasures measured = geometry::measure(**curve);
      out["kind"] = "curve";
      put(out, "length", measured.length);
      put_centroid(out, measured.centroid, measured.centroid_error);
      if (const auto area = geometry::enclosed_area(**curve)) put(out, "enclosed_area", *area);
      put_conic(out, **curve);
      out["parameters"] = parameters_of(**curve);
      // A line found by steps says how far it may be from the one that is meant.
      const auto* line = dynamic_cast<const geometry::SurfaceCurve*>(curve->get());
      if (line && line->error() > 0) out["deviation"] = line->error();
      const auto* blend = dynamic_cast<const geometry::ArcBlendCurve*>(curve->get());
      if (blend) out["segments"] = blend->segments();
      if (blend && blend->bounds()) {
        out["deviation_bound"] = blend->bounds()->position;
        out["angle_bound"] = blend->bounds()->angle;
      }
    } else if (const auto* surface = std::get_if<geometry::SurfacePtr>(&entity)) {
      out["kind"] = "surface";
      put(out, geometry::measure(**surface));
      put_planes(out, **surface);
      out["parameters"] = parameters_of(**surface);
    } else if (const auto* set = std::get_if<render::SurfaceSet>(&entity)) {
      out["kind"] = "patches";
      put(out, measure_set(*set));
    } else if (const auto* body = std::get_if<geometry::BodyPtr>(&entity)) {
      out["kind"] = "body";
      put_body(out, **body);
    } else if (const auto* mesh = std::get_if<geometry::MeshPtr>(&entity)) {
      out["kind"] = "mesh";
      put(out, geometry::measure(**mesh));
      if (!out["closed"].get<bool>()) put_open_sides(out, geometry::sides(**mesh));
    } else if (const auto* shape = std::get_if<geometry::ShapePtr>(&entity)) {
      const geometry::ShapeMeasures measured = geometry::measure(**shape);
      out["kind"] = "shape";
      if (!no_boundary.empty()) out["by_lines"] = "its boundary is not made: " + no_boundary;
      put(out, "area", measured.area);
      put(out, "volume", measured.volume);
      put_centroid(out, measured.centroid, measured.centroid_error);
    } else {
      throw UsageError(fmt::format("'{}' is a point or a group: there is nothing to measure", name));
    }
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}': {}", name, error.what()));
  }
  try {
    demand_finite(out);
  } catch (const std::invalid_argument&) {
    throw UsageError(fmt::format("'{}' is too large: its measures are beyond what numbers can hold", name));
  }
  return out;
}

void print_measures(const ordered_json& measured) {
  const auto vector_text = [](const ordered_json& v) { return digits(Vec3(v[0], v[1], v[2])); };
  fmt::print("{} '{}'{}\n", measured["kind"].get<std::string>(), measured["name"].get<std::string>(),
             !measured.value("closed", true)     ? ", not closed: it has no volume"
             : measured.value("volume", 0.0) < 0 ? ", inside out: its volume is negative"
                                                 : "");
  for (const auto& [key, value] : measured.items()) {
    if (key == "by_lines") fmt::print("by lines           {}\n", value.get<std::string>());
    if (key == "conic") fmt::print("{:<18} {}\n", key, value.get<std::string>());
    if (value.is_string() || value.is_boolean() || key.ends_with("_error")) continue;
    if (key == "parameters") {
      print_parameters(value);
      continue;
    }
    const bool is_matrix = value.is_array() && value[0].is_array();
    std::string label = key;
    std::replace(label.begin(), label.end(), '_', ' ');
    fmt::print("{:<18} {}", label,
               is_matrix ? vector_text(value[0])
               : key == "half_axes"
                   ? fmt::format("{} {}", digits(value[0].get<double>()), digits(value[1].get<double>()))
               : value.is_array() ? vector_text(value)
                                  : digits(value.get<double>()));
    if (const auto error = measured.find(key + "_error"); error != measured.end())
      fmt::print("   error {:.2g}", error->get<double>());
    fmt::print("\n");
    for (size_t row = 1; is_matrix && row < value.size(); ++row) fmt::print("{:<18} {}\n", "", vector_text(value[row]));
  }
}

void add_measure(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand(
      "measure", "Length, area, volume, moments; topology; distance, intersections; comparison with a table");
  sub->footer(
      "Examples:\n"
      "  lekalo measure ring.yaml ring\n"
      "  lekalo measure plate.yaml plate --topology\n"
      "  lekalo measure ring.yaml ring --to 4,-7,4.5\n"
      "  lekalo measure curves.yaml chord --to dome\n"
      "  lekalo measure curves.yaml rim --intersect chord\n"
      "  lekalo measure bottle.yaml bottle --self-intersection\n"
      "  lekalo measure room.yaml floor --intersect wall --intersect roof\n"
      "  lekalo measure ring.yaml ring --section 0,0,0.2,0,0,1 --samples 100 --json\n"
      "  lekalo measure ring.yaml ring --silhouette camera\n"
      "  lekalo measure curves.yaml dome --position 0,0,3\n"
      "  lekalo measure plate.yaml plate --continuity\n"
      "  lekalo measure ring.yaml ring --against samples.csv --tolerance 1e-12 --json\n"
      "  lekalo measure curves.yaml rim --features\n"
      "  lekalo measure curves.yaml rim --arc 0,pi/2\n"
      "  lekalo measure curves.yaml rim --hausdorff chord\n"
      "  lekalo measure curves.yaml rim --nurbs --json\n"
      "  lekalo measure curves.yaml rim --rim --chord 0.3,2\n"
      "  lekalo measure pipe.yaml flat --stretch pipe\n"
      "  lekalo measure kernel.yaml theirs --against ours --samples 200 --tolerance 1e-9 --allow-external\n\n"
      "Density is one. The inertia tensor is about the centroid; principal axes are listed in the order of the "
      "moments.\n"
      "Exit code 1 if a sample is farther away than the tolerance; of two curves or surfaces, if points, derivatives, "
      "tangents or normals differ by more.");
  auto options = std::make_shared<Options>();
  options->scene.add_to(*sub);
  sub->add_option("name", options->name, "name of the curve, surface, body, shape or mesh")->required();
  auto* topology = sub->add_flag("--topology", options->topology, "faces, edges and vertices with their names instead");
  auto* regular = sub->add_flag("--regularity", options->regularity,
                                "whether the curve or surface is regular: bounds of speed and curvature");
  auto* cubature =
      sub->add_option("--cubature", options->cubature,
                      "area and volume by rules of so many points on triangular cells, without bounds of the error: "
                      "1, 3, 4, 6 or 7, exact for degrees 1 to 5")
          ->type_name("POINTS")
          ->check(CLI::IsMember({1, 3, 4, 6, 7}));
  sub->add_option("--turn", options->turn, "of --cubature, how far the normal turns inside of a cell at most [20]")
      ->type_name("DEGREES")
      ->needs(cubature)
      ->check(CLI::Range(0.5, 90.0));
  auto* cells = sub->add_option("--cells", options->cells,
                                "cut into so many cells: bounds of their diameters and of the surface's")
                    ->type_name("NU,NV");
  sub->add_option("--line", options->line,
                  "of --cells, a point and a direction: whether the diameters prove that the line misses the surface")
      ->type_name("X,Y,Z,DX,DY,DZ")
      ->needs(cells);
  auto* to = sub->add_option("--to", options->to,
                             "distance from a point, with all its feet; from a curve, surface or body, with all minima")
                 ->type_name("NAME|X,Y,Z");
  sub->add_flag("--nearest", options->nearest, "of --to only what is nearest, which takes less time");
  auto* intersect =
      sub->add_option("--intersect", options->intersect,
                      "where the curve, surface or body meets another: crossings, contacts, common parts, curves; "
                      "given twice, the common points of three surfaces or bodies")
          ->type_name("NAME")
          ->allow_extra_args(false);
  auto* self_intersection =
      sub->add_flag("--self-intersection", options->self_intersection,
                    "where the curve or surface meets itself: crossings, contacts, cusps, parts run twice, curves");
  auto* section = sub->add_option("--section", options->section,
                                  "where a plane cuts the surface or body: a point of the plane and its normal")
                      ->type_name("X,Y,Z,NX,NY,NZ");
  auto* silhouette =
      sub->add_option(
             "--silhouette", options->silhouette,
             "the outline of the surface or body as the scene's camera sees it, along a direction, or from an eye")
          ->type_name("camera|DX,DY,DZ|eye:X,Y,Z");
  auto* position =
      sub->add_option(
             "--position", options->position,
             "where a point lies: above or below a surface, inside or outside of a body or closed plane curve; or U,V "
             "in the region of a trimmed surface")
          ->type_name("NAME|X,Y,Z|U,V");
  auto* continuity = sub->add_option("--continuity", options->continuity,
                                     "how smoothly it joins another curve or surface; alone, how a body's faces or the "
                                     "pieces of a curve join: G0 to G3")
                         ->type_name("[NAME]")
                         ->expected(0, 1);
  auto* nurbs = sub->add_flag("--nurbs", options->nurbs,
                              "the curve or surface as NURBS: degree, knots, points, weights, Bezier pieces; exact, "
                              "else fitted");
  auto* features = sub->add_flag("--features", options->features,
                                 "inflections, vertices, cusps and corners of the curve, total curvature, the widest "
                                 "angle between tangents (monotone: less than a right one); of a closed plane one its "
                                 "turning number and area; of a surface its umbilics");
  auto* arc =
      sub->add_option("--arc", options->arc, "the length of the curve's part between two parameters")->type_name("T,T");
  auto* at_length =
      sub->add_option("--at-length", options->at_length, "the parameter at this length from the curve's beginning")
          ->type_name("LENGTH");
  auto* hausdorff =
      sub->add_option("--hausdorff", options->hausdorff,
                      "how far the farthest point of the curve or of another one is from the other: a certain bracket")
          ->type_name("NAME");
  auto* frechet = sub->add_option("--frechet", options->frechet,
                                  "the same for points that run along both curves at best, from beginning to end")
                      ->type_name("NAME");
  auto* against =
      sub->add_option(
             "--against", options->against,
             "table of points with columns t,x,y,z or u,v,x,y,z; or another curve or surface of the scene, whose "
             "domain is mapped linearly")
          ->type_name("FILE|NAME");
  auto* rim = sub->add_flag("--rim", options->rim,
                            "whether the closed plane curve is the rim of a sheet that may overlap itself");
  auto* chord =
      sub->add_option("--chord", options->chord,
                      "of --rim, two parameters: whether the straight line between the points is one line on the sheet")
          ->type_name("T,T")
          ->needs(rim);
  sub->add_option("--secant", options->secant,
                  "the same of a curve between these points, as that of the section by a cylinder")
      ->type_name("NAME")
      ->needs(chord);
  auto* stretch = sub->add_option("--stretch", options->stretch,
                                  "by how much the surface stretches when it is laid on another one of the same "
                                  "parameters, as a development on its surface")
                      ->type_name("NAME");
  // One question at a time.
  const std::array modes{cubature,  topology,   regular,  cells,      to,    intersect, self_intersection,
                         section,   silhouette, position, continuity, nurbs, features,  arc,
                         at_length, hausdorff,  frechet,  against,    rim,   stretch};
  for (size_t i = 0; i < modes.size(); ++i)
    for (size_t j = 0; j < i; ++j) modes[i]->excludes(modes[j]);
  sub->add_option("--tolerance", options->tolerance,
                  fmt::format("largest difference that passes; of --intersect and --self-intersection the part of the "
                              "size below which points "
                              "are one [{:g}]; of --continuity the relative jump that passes [{:g}]",
                              geometry::kSamePoint, kSmooth))
      ->type_name("X")
      ->check(CLI::NonNegativeNumber)
      ->check(not_finite);
  sub->add_option(
         "--samples", options->samples,
         fmt::format(
             "of --against and --stretch, places in each direction [{}]; of curves that surfaces make, points along "
             "each branch",
             kSamples))
      ->check(CLI::Range(2, 10000));
  sub->add_option("--order", options->order, "compare derivatives up to this order [2]")->check(CLI::Range(0, 2));
  sub->add_flag("--json", options->json, "print JSON");
  sub->callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace lekalo::command
