// lekalo measure: one table of the questions that it answers, another of what they may be told besides.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <span>

#include "command.h"
#include "geometry/queries/intersections/curve_intersections.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::Vec3;

// Places in each direction where two curves or surfaces are compared.
constexpr int kSamples = 65;
// Jumps of a joint that pass unless told otherwise.
constexpr double kSmooth = 1e-6;

struct Options {
  SceneOptions scene;
  std::string name;
  std::map<std::string, std::vector<std::string>> questions;  // values of those asked, by option
  std::map<std::string, std::string> details;                 // what was told besides, by option
  bool json = false;
};

struct Answer {
  ordered_json found;
  void (*print)(const ordered_json&) = nullptr;
};

// A question about a thing of a scene. What is told besides must be asked for: what no answer asks for is a mistake.
class Inquiry {
 public:
  Inquiry(const Options& options, const render::LoadedScene& scene, const render::Entity& entity)
      : name(options.name), scene(scene), entity(entity), options_(options) {}

  const std::string& name;
  const render::LoadedScene& scene;
  const render::Entity& entity;

  std::vector<std::string> values(const std::string& option) const {
    const auto found = options_.questions.find(option);
    return found == options_.questions.end() ? std::vector<std::string>() : found->second;
  }
  std::string value(const std::string& option) const {
    const std::vector<std::string> all = values(option);
    return all.empty() ? std::string() : all.front();
  }
  std::vector<double> numbers(const std::string& option, int count) const {
    return parse_numbers(value(option), count, option);
  }
  const render::Entity& other(const std::string& option, size_t i = 0) const {
    return find_geometry(scene, values(option)[i]);
  }

  // What is told besides; nothing if it is not.
  std::optional<std::string> detail(const std::string& option) const {
    used_.insert(option);
    const auto found = options_.details.find(option);
    return found == options_.details.end() ? std::nullopt : std::optional(found->second);
  }
  bool told(const std::string& option) const { return detail(option).has_value(); }
  std::vector<double> detail_numbers(const std::string& option, int count) const {
    const auto text = detail(option);
    return text ? parse_numbers(*text, count, option) : std::vector<double>();
  }
  std::optional<double> tolerance() const {
    const auto text = detail("--tolerance");
    return text ? std::optional(parse_numbers(*text, 1, "--tolerance")[0]) : std::nullopt;
  }
  double same_point() const { return tolerance().value_or(geometry::kSamePoint); }
  int samples(int otherwise) const {
    const auto text = detail("--samples");
    return text ? std::stoi(*text) : otherwise;
  }
  const std::set<std::string>& used() const { return used_; }

 private:
  const Options& options_;
  mutable std::set<std::string> used_;
};

bool is_curve(const render::Entity& entity) { return std::holds_alternative<geometry::CurvePtr>(entity); }
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

// A name without an ending that no file has was meant to be that of a thing of the scene.
void check_table_name(const render::LoadedScene& scene, const std::string& against) {
  std::error_code ignored;
  const std::filesystem::path path(against);
  if (!path.has_extension() && !path.has_parent_path() && !std::filesystem::exists(path, ignored))
    find_geometry(scene, against);
}

Answer against(const Inquiry& asked) {
  const std::string with = asked.value("--against");
  if (asked.scene.model->geometry.contains(with)) {
    const auto order = asked.detail("--order");
    return {compare_pair(asked.name, asked.entity, with, asked.other("--against"), asked.samples(kSamples),
                         order ? std::stoi(*order) : 2, asked.tolerance()),
            print_pair};
  }
  check_table_name(asked.scene, with);
  return {compare_with_table(asked.name, asked.entity, load_table(with), with, asked.tolerance()), print_comparison};
}

// Whether a point beside it needs no z, as in scene files: of a curve in the plane z = 0. Of a surface two numbers
// might be meant for u and v.
bool is_in_plane_of_x_and_y(const render::Entity& entity) {
  const auto* curve = std::get_if<geometry::CurvePtr>(&entity);
  if (!curve) return false;
  const geometry::Box3 box = (*curve)->enclose((*curve)->domain(), 0).d[0];
  return std::max(std::abs(box.lo.z), std::abs(box.hi.z)) <= 1e-12 * box.diameter();
}

Answer to(const Inquiry& asked) {
  std::string other = asked.value("--to");
  if (is_in_plane_of_x_and_y(asked.entity) && std::count(other.begin(), other.end(), ',') == 1) other += ",0";
  return {
      distance_to(asked.name, asked.entity, other, thing_or_point(asked.scene, other, "--to"), asked.told("--nearest")),
      print_distance};
}

Answer intersect(const Inquiry& asked) {
  const std::vector<std::string> others = asked.values("--intersect");
  if (others.size() > 2) throw UsageError("--intersect stands once, or twice for the common points of three surfaces");
  const render::Entity& first = asked.other("--intersect");
  if (others.size() == 2)
    return {common_points_of({asked.name, others[0], others[1]},
                             {&asked.entity, &first, &asked.other("--intersect", 1)}, asked.same_point()),
            print_common_points};
  if (has_faces(asked.entity) && has_faces(first))
    return {surface_intersections(asked.name, asked.entity, others[0], first, asked.same_point(), asked.samples(0)),
            print_contours};
  return {intersections(asked.name, asked.entity, others[0], first, asked.same_point()), print_intersections};
}

Answer self_intersection(const Inquiry& asked) {
  if (has_faces(asked.entity))
    return {surface_self_intersections(asked.name, asked.entity, asked.same_point(), asked.samples(0)), print_contours};
  if (!is_curve(asked.entity)) throw UsageError(fmt::format("'{}' is neither a curve nor a surface", asked.name));
  return {self_intersections(asked.name, std::get<geometry::CurvePtr>(asked.entity), asked.same_point()),
          print_self_intersections};
}

// Sections and silhouettes, of faces or of a solid that has none.
Answer of_contours(const Inquiry& asked, ordered_json (*of_faces)(const Inquiry&),
                   ordered_json (*of_solid)(const Inquiry&)) {
  if (has_faces(asked.entity)) return {of_faces(asked), print_contours};
  if (is_solid_without_faces(asked.entity)) return {of_solid(asked), print_contours};
  throw UsageError(
      fmt::format("'{}' is neither a surface nor a body: sections and silhouettes are taken of those", asked.name));
}

Answer section_asked(const Inquiry& asked) {
  return of_contours(
      asked, [](const Inquiry& a) { return section(a.name, a.entity, a.value("--section"), a.samples(0)); },
      [](const Inquiry& a) { return section_of_solid(a.name, a.entity, a.value("--section"), a.samples(0)); });
}

Answer silhouette_asked(const Inquiry& asked) {
  return of_contours(
      asked,
      [](const Inquiry& a) {
        return silhouette_seen(a.name, a.entity, a.value("--silhouette"), a.scene.model->camera.get(), a.samples(0));
      },
      [](const Inquiry& a) {
        return silhouette_of_solid(a.name, a.entity, a.value("--silhouette"), a.scene.model->camera.get(),
                                   a.samples(0));
      });
}

Answer continuity(const Inquiry& asked) {
  const std::string other = asked.value("--continuity");
  return {continuity_of(asked.name, asked.entity, other, other.empty() ? nullptr : &asked.other("--continuity"),
                        asked.tolerance().value_or(kSmooth)),
          print_continuity};
}

Answer rim(const Inquiry& asked) {
  const std::vector<double> chord = asked.detail_numbers("--chord", 2);
  const auto secant = asked.detail("--secant");
  return {rim_of(asked.name, asked.entity, chord, secant ? &find_geometry(asked.scene, *secant) : nullptr), print_rim};
}

Answer cubature(const Inquiry& asked) {
  const std::vector<double> turn = asked.detail_numbers("--turn", 1);
  return {cubature_of(asked.name, asked.entity, std::stoi(asked.value("--cubature")), turn.empty() ? 20 : turn[0]),
          print_cubature};
}

// One question at a time.
struct Question {
  const char* option;
  const char* value;  // what it takes; null: nothing
  const char* help;
  Answer (*answer)(const Inquiry&);
  bool of_boundary = false;       // a solid that is put together is asked by its boundary, if it has one
  int most = 1;                   // how often it may stand
  bool may_be_empty = false;      // the value may be left out
  std::vector<int> choices = {};  // whole numbers that it takes
};

std::span<const Question> questions() {
  static const std::vector<Question> all = {
      {"--topology", nullptr, "faces, edges and vertices with their names instead",
       [](const Inquiry& a) -> Answer {
         return {topology(a.name, a.entity), print_topology};
       },
       true},
      {"--regularity", nullptr, "whether the curve or surface is regular: bounds of speed and curvature",
       [](const Inquiry& a) -> Answer {
         return {regularity(a.name, a.entity), print_regularity};
       }},
      {"--cubature",
       "POINTS",
       "area and volume by rules of so many points on triangular cells, without bounds of the error: 1, 3, 4, 6 or 7, "
       "exact for degrees 1 to 5",
       cubature,
       true,
       1,
       false,
       {1, 3, 4, 6, 7}},
      {"--cells", "NU,NV", "cut into so many cells: bounds of their diameters and of the surface's",
       [](const Inquiry& a) -> Answer {
         return {cells_of(a.name, a.entity, a.numbers("--cells", 2), a.detail_numbers("--line", 6)), print_cells};
       }},
      {"--to", "NAME|X,Y,Z", "distance from a point, with all its feet; from a curve, surface or body, with all minima",
       to},
      {"--intersect", "NAME",
       "where the curve, surface or body meets another: crossings, contacts, common parts, curves; given twice, the "
       "common points of three surfaces or bodies",
       intersect, true, 1000},
      {"--self-intersection", nullptr,
       "where the curve or surface meets itself: crossings, contacts, cusps, parts run twice, curves",
       self_intersection},
      {"--section", "X,Y,Z,NX,NY,NZ", "where a plane cuts the surface or body: a point of the plane and its normal",
       section_asked, true},
      {"--silhouette", "camera|DX,DY,DZ|eye:X,Y,Z",
       "the outline of the surface or body as the scene's camera sees it, along a direction, or from an eye",
       silhouette_asked, true},
      {"--position", "NAME|X,Y,Z|U,V",
       "where a point lies: above or below a surface, inside or outside of a body or closed plane curve; or U,V in the "
       "region of a trimmed surface",
       [](const Inquiry& a) -> Answer {
         const std::string of = a.value("--position");
         return {position_of(a.name, a.entity, of, place_named(a.scene, of)), print_position};
       }},
      {"--continuity", "[NAME]",
       "how smoothly it joins another curve or surface; alone, how a body's faces or the pieces of a curve join: G0 to "
       "G3",
       continuity, true, 1, true},
      {"--nurbs", nullptr,
       "the curve or surface as NURBS: degree, knots, points, weights, Bezier pieces; exact, else fitted",
       [](const Inquiry& a) -> Answer {
         return {nurbs_form(a.name, a.entity), print_nurbs_form};
       }},
      {"--features", nullptr,
       "inflections, vertices, cusps and corners of the curve, total curvature, the widest angle between tangents "
       "(monotone: less than a right one); of a closed plane one its turning number and area; of a surface its "
       "umbilics",
       [](const Inquiry& a) -> Answer {
         return {curve_shape(a.name, a.entity), print_curve_shape};
       }},
      {"--arc", "T,T", "the length of the curve's part between two parameters",
       [](const Inquiry& a) -> Answer {
         const std::vector<double> ends = a.numbers("--arc", 2);
         return {arc_of(a.name, a.entity, ends[0], ends[1]), print_arc};
       }},
      {"--at-length", "LENGTH", "the parameter at this length from the curve's beginning",
       [](const Inquiry& a) -> Answer {
         return {parameter_at(a.name, a.entity, a.numbers("--at-length", 1)[0]), print_arc};
       }},
      {"--hausdorff", "NAME",
       "how far the farthest point of the curve or of another one is from the other: a certain bracket",
       [](const Inquiry& a) -> Answer {
         return {hausdorff_between(a.name, a.entity, a.value("--hausdorff"), a.other("--hausdorff")), print_nearness};
       }},
      {"--frechet", "NAME", "the same for points that run along both curves at best, from beginning to end",
       [](const Inquiry& a) -> Answer {
         return {frechet_between(a.name, a.entity, a.value("--frechet"), a.other("--frechet")), print_nearness};
       }},
      {"--against", "FILE|NAME",
       "table of points with columns t,x,y,z or u,v,x,y,z; or another curve or surface of the scene, whose domain is "
       "mapped linearly",
       against},
      {"--rim", nullptr, "whether the closed plane curve is the rim of a sheet that may overlap itself", rim},
      {"--stretch", "NAME",
       "by how much the surface stretches when it is laid on another one of the same parameters, as a development on "
       "its surface",
       [](const Inquiry& a) -> Answer {
         return {stretch_of(a.name, a.entity, a.value("--stretch"), a.other("--stretch"), a.samples(kSamples)),
                 print_stretch};
       }},
      {"--blank", "DX,DY,DZ",
       "the smallest box that stands along this direction and holds the curve, surface or body, and by how much it is "
       "turned about it: the blank of a workpiece",
       [](const Inquiry& a) -> Answer {
         return {blank_of(a.name, a.entity, a.value("--blank")), print_blank};
       }},
  };
  return all;
}

// What may be told besides.
struct Modifier {
  const char* option;
  const char* value;  // null: a flag
  std::string help;
  const char* belongs_to;  // in messages
  const char* needs;       // an option that must stand too; null: see belongs_to
  double lowest = -1e300, highest = 1e300;
  bool whole = false;
};

std::span<const Modifier> modifiers() {
  static const std::vector<Modifier> all = {
      {"--turn", "DEGREES", "of --cubature, how far the normal turns inside of a cell at most [20]", "--cubature",
       "--cubature", 0.5, 90},
      {"--line", "X,Y,Z,DX,DY,DZ",
       "of --cells, a point and a direction: whether the diameters prove that the line misses the surface", "--cells",
       "--cells"},
      {"--nearest", nullptr, "of --to only what is nearest, which takes less time", "--to", nullptr},
      {"--chord", "T,T",
       "of --rim, two parameters: whether the straight line between the points is one line on the sheet", "--rim",
       "--rim"},
      {"--secant", "NAME", "the same of a curve between these points, as that of the section by a cylinder", "--chord",
       "--chord"},
      {"--tolerance", "X",
       fmt::format("largest difference that passes; of --intersect and --self-intersection the part of the size below "
                   "which points are one [{:g}]; of --continuity the relative jump that passes [{:g}]",
                   geometry::kSamePoint, kSmooth),
       "--against SAMPLES.csv, --against NAME, --intersect NAME, --self-intersection or --continuity", nullptr, 0},
      {"--samples", "N",
       fmt::format("of --against and --stretch, places in each direction [{}]; of curves that surfaces make, points "
                   "along each branch",
                   kSamples),
       "--against NAME, another curve or surface of the scene, to --stretch, and to intersections, sections and "
       "silhouettes of surfaces",
       nullptr, 2, 10000, true},
      {"--order", "N", "compare derivatives up to this order [2]",
       "--against NAME, another curve or surface of the scene", nullptr, 0, 2, true},
  };
  return all;
}

ordered_json as_json(const std::vector<render::ExternalNote>& notes) {
  ordered_json list = ordered_json::array();
  for (const render::ExternalNote& note : notes)
    list.push_back({{"place", render::where(note.place)}, {"fit", note.text}, {"doubts", note.doubts}});
  return list;
}

// The value of a parameter of the scene; angles in radians.
Answer parameter(const std::string& name, double value) {
  return {{{"name", name}, {"kind", "parameter"}, {"value", value}}, [](const ordered_json& found) {
            fmt::print("parameter '{}'\nvalue              {}\n", found["name"].get<std::string>(),
                       digits(found["value"].get<double>()));
          }};
}

Answer plain_measures(const std::string& name, const render::Entity& entity, const render::SceneWithAttributes& scene) {
  ordered_json found = measures(name, entity);
  put_attributes(found, scene, name);
  return {std::move(found), print_measures};
}

Answer answer(const Options& options, const render::SceneWithAttributes& scene) {
  const auto known = scene.model->parameters.find(options.name);
  if (known != scene.model->parameters.end() && !scene.model->geometry.contains(options.name))
    return parameter(options.name, known->second);
  const render::Entity& given = find_geometry(scene, options.name);
  const Question* question = nullptr;
  for (const Question& one : questions())
    if (options.questions.contains(one.option)) question = &one;
  // The plain measures ask for the boundary themselves.
  std::string no_boundary;
  const render::Entity entity = question && question->of_boundary ? by_boundary(given, &no_boundary) : given;
  if (question && std::string_view(question->option) == "--topology" && !no_boundary.empty())
    throw UsageError(fmt::format("'{}' has no topology: {}", options.name, no_boundary));
  print_external_notes(scene, !options.json);
  const Inquiry asked(options, scene, entity);
  const Answer found = question ? question->answer(asked) : plain_measures(options.name, entity, scene);
  for (const Modifier& detail : modifiers())
    if (options.details.contains(detail.option) && !asked.used().contains(detail.option))
      throw UsageError(fmt::format("{} belongs to {}", detail.option, detail.belongs_to));
  return found;
}

int run(const Options& options) {
  const render::SceneWithAttributes scene =
      render::load_with_attributes(options.scene.file, options.scene.load_options());
  Answer found = answer(options, scene);
  if (options.json && !scene.external_notes.empty()) found.found["external"] = as_json(scene.external_notes);
  demand_finite(found.found);
  if (options.json)
    fmt::print("{}\n", found.found.dump(2));
  else
    found.print(found.found);
  return found.found.value("passed", true) ? kDone : kDiffers;
}

CLI::Option* add(CLI::App& app, const Question& question, const std::shared_ptr<Options>& options) {
  const std::string name = question.option;
  if (!question.value)
    return app.add_flag_callback(
        name, [options, name] { options->questions[name]; }, question.help);
  CLI::Option* option =
      app.add_option_function<std::vector<std::string>>(
             name, [options, name](const std::vector<std::string>& values) { options->questions[name] = values; },
             question.help)
          ->type_name(question.value);
  if (question.may_be_empty)
    option->expected(0, 1);
  else if (question.most > 1)
    option->allow_extra_args(false);
  else
    option->expected(1);
  if (!question.choices.empty()) {
    std::vector<std::string> words;
    for (const int choice : question.choices) words.push_back(std::to_string(choice));
    option->check(CLI::IsMember(words));
  }
  return option;
}

void add(CLI::App& app, const Modifier& detail, const std::shared_ptr<Options>& options) {
  const std::string name = detail.option;
  CLI::Option* option = nullptr;
  if (!detail.value) {
    option = app.add_flag_callback(
        name, [options, name] { options->details[name]; }, detail.help);
  } else {
    option = app.add_option_function<std::string>(
                    name, [options, name](const std::string& value) { options->details[name] = value; }, detail.help)
                 ->type_name(detail.value);
    if (detail.whole)
      option->check(CLI::Range(static_cast<int>(detail.lowest), static_cast<int>(detail.highest)));
    else if (detail.lowest == 0)
      option->check(CLI::NonNegativeNumber)->check(not_finite);
    else if (detail.lowest > 0)
      option->check(CLI::Range(detail.lowest, detail.highest));
  }
  if (detail.needs) option->needs(app.get_option(detail.needs));
}

}  // namespace

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
      "Density is one; of what has an attribute `density` the mass and its moments follow, in kilograms and metres. "
      "The inertia tensor is about the centroid; principal axes are listed in the order of the moments.\n"
      "Exit code 1 if a sample is farther away than the tolerance; of two curves or surfaces, if points, derivatives, "
      "tangents or normals differ by more.");
  auto options = std::make_shared<Options>();
  options->scene.add_to(*sub);
  sub->add_option("name", options->name, "name of the curve, surface, body, shape or mesh, or of a parameter")
      ->required();
  std::vector<CLI::Option*> modes;
  for (const Question& question : questions()) {
    CLI::Option* mode = add(*sub, question, options);
    for (CLI::Option* other : modes) mode->excludes(other);
    modes.push_back(mode);
  }
  for (const Modifier& detail : modifiers()) add(*sub, detail, options);
  sub->add_flag("--json", options->json, "print JSON");
  sub->callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace lekalo::command
