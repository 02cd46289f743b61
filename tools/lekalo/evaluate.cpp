// lekalo evaluate: a point of a curve or surface with derivatives, normal and curvatures.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "command.h"
#include "evaluate.h"
#include "geometry/bodies/topology/selection.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/queries/differential/curvature.h"
#include "geometry/queries/differential/divided_difference.h"
#include "geometry/queries/differential/fundamental_forms.h"
#include "geometry/queries/differential/osculation.h"
#include "geometry/queries/differential/tool_axis.h"
#include "geometry/queries/differential/trihedron.h"
#include "geometry/queries/differential/turning_step.h"
#include "geometry/transformed.h"
#include "parameters.h"

namespace lekalo::command {

namespace {

using geometry::Vec3;

// The columns t, n, b and the point: a matrix that places things at the point of the curve.
ordered_json placement(const geometry::Frame& frame) {
  ordered_json rows = ordered_json::array();
  for (int i = 0; i < 3; ++i)
    rows.push_back(ordered_json::array({frame.z[i], frame.x[i], frame.y[i], frame.origin[i]}));
  rows.push_back(ordered_json::array({0.0, 0.0, 0.0, 1.0}));
  return rows;
}

// Darboux's vector, the osculating circle, whose centre is the point of the evolute, and the osculating sphere.
void put_osculation(ordered_json& out, const geometry::CurveJet& jet, const geometry::CurveCurvature& frame) {
  const geometry::Osculation o = geometry::osculation(jet, frame);
  out["darboux"] = o.darboux ? finite_or_null(*o.darboux) : ordered_json(nullptr);
  out["radius_of_curvature"] = o.circle ? finite_or_null(o.circle->radius) : ordered_json(nullptr);
  out["center_of_curvature"] = o.circle ? finite_or_null(o.circle->center) : ordered_json(nullptr);
  out["sphere_radius"] = o.sphere ? finite_or_null(o.sphere->radius) : ordered_json(nullptr);
  out["sphere_center"] = o.sphere ? finite_or_null(o.sphere->center) : ordered_json(nullptr);
}

// How a curve on a surface bends across it and within it.
void put_on_surface(ordered_json& out, const geometry::Curve& curve, double t) {
  const auto* on = dynamic_cast<const geometry::SurfaceCurve*>(&curve);
  if (!on) return;
  const Vec3 uv = on->image()->point(t), normal = on->surface()->normal(uv.x, uv.y);
  const geometry::CurveOnSurfaceCurvature c = geometry::curvature_on_surface(curve.evaluate(t, 2), normal);
  out["surface_normal"] = finite_or_null(normal);
  out["normal_curvature"] = finite_or_null(c.normal);
  out["geodesic_curvature"] = finite_or_null(c.geodesic);
}

ordered_json evaluate_curve(const geometry::Curve& curve, double t, int order) {
  const geometry::CurveJet jet = curve.evaluate(t, order);
  ordered_json out;
  out["t"] = t;
  out["point"] = to_json(jet.point());
  ordered_json derivatives = ordered_json::array();
  for (int k = 1; k <= order; ++k) derivatives.push_back(finite_or_null(jet.d[k]));
  out["derivatives"] = derivatives;
  const geometry::CurveCurvature c = geometry::curvature(curve, t);
  out["tangent"] = c.has_tangent ? to_json(c.tangent) : ordered_json(nullptr);
  out["normal"] = c.has_normal ? to_json(c.normal) : ordered_json(nullptr);
  out["binormal"] = c.has_normal ? to_json(c.binormal) : ordered_json(nullptr);
  out["curvature"] = json_or_null(c.has_curvature, c.curvature);
  out["torsion"] = json_or_null(c.has_normal || c.is_straight, c.torsion);
  put_osculation(out, curve.evaluate(t, 3), c);
  put_on_surface(out, curve, t);
  out["parameters"] = parameters_of(curve);
  return out;
}

// Divided differences over nodes, as the coefficients of Newton's polynomial.
ordered_json differences_of(const geometry::Curve& curve, const std::vector<double>& nodes) {
  geometry::DividedDifferences found;
  try {
    found = geometry::divided_differences(curve, nodes);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("--divided-difference: {}", error.what()));
  }
  ordered_json out, list = ordered_json::array();
  for (const Vec3& difference : found.differences) list.push_back(finite_or_null(difference));
  out["nodes"] = found.nodes;
  out["divided_differences"] = list;
  out["divided_difference"] = list.back();
  out["parameters"] = parameters_of(curve);
  return out;
}

std::string numbers_of(const ordered_json& list) {
  std::string text;
  for (const auto& x : list)
    text += (text.empty() ? "" : " ") + (x.is_array() ? numbers_of(x) : x.is_null() ? "-" : digits(x.get<double>()));
  return text;
}

void print(const ordered_json& out) {
  for (const auto& [key, value] : out.items()) {
    if (key == "parameters") {
      print_parameters(value);
    } else if (value.is_null()) {
      fmt::print("{:<21} -\n", key);
    } else if (key == "placement") {
      for (const auto& row : value)
        fmt::print("{:<21} {} {} {} {}\n", &row == &value[0] ? "placement" : "", digits(row[0].get<double>()),
                   digits(row[1].get<double>()), digits(row[2].get<double>()), digits(row[3].get<double>()));
    } else if (key == "derivatives" || key == "divided_differences") {
      const bool divided = key != "derivatives";
      for (size_t k = 0; k < value.size(); ++k)
        fmt::print("{:<21} {}\n", divided ? fmt::format("difference {}", k) : fmt::format("derivative {}", k + 1),
                   value[k].is_null() ? "-" : digits(Vec3(value[k][0], value[k][1], value[k][2])));
    } else if (value.is_string()) {
      fmt::print("{:<21} {}\n", key, value.get<std::string>());
    } else if (value.is_array() && !value.empty() && value[0].is_array()) {
      for (const auto& row : value) fmt::print("{:<21} {}\n", &row == &value[0] ? key : "", numbers_of(row));
    } else if (value.is_boolean()) {
      fmt::print("{:<21} {}\n", key, value.get<bool>() ? "true" : "false");
    } else if (value.is_array()) {
      fmt::print("{:<21} {}\n", key, numbers_of(value));
    } else {
      fmt::print("{:<21} {}\n", key, digits(value.get<double>()));
    }
  }
}

struct Options {
  SceneOptions scene;
  std::string name, at, uv, table, face, divided_difference;
  std::vector<std::string> on, along;
  double share = 0.5, turn = 0;  // turn: degrees
  std::optional<int> order;
  std::optional<double> tilt;  // degrees
  bool placement = false, metric = false, json = false;
};

// A surface of its own, a patch of a set by number, or a face of a body by number or name.
geometry::SurfacePtr surface_of(const render::Entity& entity, const Options& options) {
  const auto* surface = std::get_if<geometry::SurfacePtr>(&entity);
  const auto* set = std::get_if<render::SurfaceSet>(&entity);
  const auto* body = std::get_if<geometry::BodyPtr>(&entity);
  if (std::holds_alternative<geometry::ShapePtr>(entity))
    throw UsageError(fmt::format("'{}' is met by rays only: 'lekalo trace' tells its points", options.name));
  if (!surface && !set && !body) throw UsageError(fmt::format("'{}' is neither a curve nor a surface", options.name));
  if (surface) return *surface;
  const size_t count = set ? set->size() : (*body)->faces.size();
  const std::vector<int> called =
      body ? geometry::called(**body, geometry::Element::face, options.face) : std::vector<int>{};
  for (size_t i = 0; i < count; ++i)
    if (options.face == std::to_string(i) || (count == 1 && options.face.empty()) ||
        (called.size() == 1 && called.front() == static_cast<int>(i)))
      return set ? (*set)[i] : (*body)->faces[i].surface;
  const std::string hint =
      fmt::format("--face 0 to {}{}", count - 1, body ? ", or a name of 'lekalo measure --topology'" : "");
  if (options.face.empty())
    throw UsageError(fmt::format("'{}' has {} faces; say which one: {}", options.name, count, hint));
  throw UsageError(fmt::format("'{}' has no face '{}'; take {}", options.name, options.face, hint));
}

// All of them, or the face that is asked for.
std::vector<geometry::SurfacePtr> surfaces_of(const render::Entity& entity, const Options& options) {
  if (!options.face.empty()) return {surface_of(entity, options)};
  if (const auto* set = std::get_if<render::SurfaceSet>(&entity)) return *set;
  const auto* body = std::get_if<geometry::BodyPtr>(&entity);
  if (!body) return {surface_of(entity, options)};
  std::vector<geometry::SurfacePtr> surfaces;
  for (const geometry::Face& face : (*body)->faces) surfaces.push_back(face.surface);
  return surfaces;
}

// By the frame of Frenet, or that of the curve on surfaces.
ordered_json placement_of(const render::LoadedScene& scene, const geometry::Curve& curve, double t,
                          const Options& options) {
  if (options.on.empty()) {
    const geometry::CurveCurvature c = geometry::curvature(curve, t);
    if (!c.has_normal) return nullptr;
    return placement({curve.point(t), c.normal, c.binormal, c.tangent});
  }
  std::vector<geometry::SurfacePtr> surfaces;
  for (const std::string& name : options.on) {
    const auto* surface = std::get_if<geometry::SurfacePtr>(&find_geometry(scene, name));
    if (!surface) throw UsageError(fmt::format("'{}' is not a surface", name));
    surfaces.push_back(*surface);
  }
  try {
    return placement(geometry::SurfaceTrihedron(surfaces, options.share).at(curve.evaluate(t, 1)));
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

std::vector<geometry::Vec2> directions_of(const Options& options) {
  std::vector<geometry::Vec2> result;
  for (const std::string& one : options.along) {
    const std::vector<double> d = parse_numbers(one, 2, "--along");
    if (d[0] == 0 && d[1] == 0) throw UsageError("--along 0,0 is no direction");
    result.emplace_back(d[0], d[1]);
  }
  return result;
}

ordered_json divided_differences_of(const render::Entity& entity, const Options& options) {
  const auto* curve = std::get_if<geometry::CurvePtr>(&entity);
  if (!curve) throw UsageError(fmt::format("'{}' is no curve: divided differences are those of curves", options.name));
  const std::vector<double> nodes = parse_numbers(options.divided_difference, 0, "--divided-difference");
  for (const double t : nodes) note_outside("t", t, (*curve)->domain(), (*curve)->period());
  return differences_of(**curve, nodes);
}

// Of a tool that runs along the first direction.
ordered_json tool_axis_of(const geometry::Surface& surface, const geometry::Vec2& at, const Options& options) {
  const geometry::Vec2 way = directions_of(options).front();
  const geometry::SurfaceJet jet = surface.evaluate(at.x, at.y, 1);
  return finite_or_null(geometry::tool_axis(way.x * jet.du() + way.y * jet.dv(), surface.normal(at.x, at.y),
                                            *options.tilt * geometry::kPi / 180));
}

// At the parameter of a curve, or those of a surface.
ordered_json evaluate_at(const render::LoadedScene& scene, const render::Entity& entity, const Options& options,
                         const std::vector<double>& at) {
  if (const auto* curve = std::get_if<geometry::CurvePtr>(&entity)) {
    note_outside("t", at[0], (*curve)->domain(), (*curve)->period());
    ordered_json out = evaluate_curve(**curve, at[0], options.order.value_or(2));
    if (options.turn > 0)
      out["step"] =
          finite_or_null(geometry::turning_step((*curve)->evaluate(at[0], 2), options.turn * geometry::kPi / 180));
    if (options.placement || !options.on.empty()) out["placement"] = placement_of(scene, **curve, at[0], options);
    return out;
  }
  const geometry::SurfacePtr surface = surface_of(entity, options);
  if (const auto [one, map] = geometry::placed<geometry::CoordinateSurface>(*surface); one && at.size() != 2) {
    if (!options.along.empty() || options.turn > 0)
      throw UsageError("--along and --turn take --at U,V of the surface, not its coordinates in space");
    return at.size() == 1 ? evaluate_path(one->system(), map, at[0]) : evaluate_system(one->system(), map, at);
  }
  note_outside("u", at[0], surface->domain().u, surface->periods().u);
  note_outside("v", at[1], surface->domain().v, surface->periods().v);
  ordered_json out = evaluate_surface(*surface, {at[0], at[1]}, directions_of(options),
                                      options.turn * geometry::kPi / 180, options.metric);
  if (options.tilt) out["tool_axis"] = tool_axis_of(*surface, {at[0], at[1]}, options);
  return out;
}

// Curvilinear coordinates are three, or t of a path in them.
std::vector<double> place_of(const render::Entity& entity, const Options& options) {
  if (std::holds_alternative<geometry::CurvePtr>(entity)) return parse_numbers(options.at, 1, "--at of a curve");
  const auto* surface = std::get_if<geometry::SurfacePtr>(&entity);
  if (surface && geometry::placed<geometry::CoordinateSurface>(**surface).surface) {
    const std::vector<double> at = parse_numbers(options.at, 0, "--at");
    if (at.size() > 3) throw UsageError("--at of coordinates takes U,V,W, or T of their path");
    return at;
  }
  return parse_numbers(options.at, 2, "--at of a surface");
}

ordered_json evaluate_uv(const render::Entity& entity, const Options& options) {
  if (std::holds_alternative<geometry::CurvePtr>(entity)) throw UsageError("--uv belongs to surfaces");
  const std::vector<double> uv = parse_numbers(options.uv, 2, "--uv");
  return evaluate_over_triangles(surfaces_of(entity, options), {uv[0], uv[1]}, directions_of(options));
}

// At each row of a table.
ordered_json evaluate_table(const render::LoadedScene& scene, const render::Entity& entity, const Options& options) {
  const render::Table table = load_table(options.table);
  const size_t count = std::holds_alternative<geometry::CurvePtr>(entity) ? 1 : 2;
  if (table.column_count != count)
    throw UsageError(fmt::format("{}: a row is {}; these rows have {} numbers", options.table,
                                 count == 1 ? "the parameter of the curve" : "u and v", table.column_count));
  ordered_json rows = ordered_json::array();
  for (size_t row = 0; row < table.row_count(); ++row) {
    std::vector<double> at;
    for (size_t k = 0; k < count; ++k) at.push_back(table.at(row, k));
    rows.push_back(evaluate_at(scene, entity, options, at));
  }
  return {{"rows", rows}};
}

int run(const Options& options) {
  if (!options.at.empty() + !options.uv.empty() + !options.divided_difference.empty() + !options.table.empty() != 1)
    throw UsageError(
        "evaluate takes --at T or --at U,V, --uv U,V, --table FILE, or of a curve --divided-difference T,T,..\n"
        "'lekalo evaluate --help' shows how to use it");
  const render::LoadedScene scene = options.scene.load();
  std::string no_boundary;
  const render::Entity entity = by_boundary(find_geometry(scene, options.name), &no_boundary);
  if (!no_boundary.empty())
    throw UsageError(fmt::format("'{}' has no faces: its boundary is not made: {}", options.name, no_boundary));
  const bool is_curve = std::holds_alternative<geometry::CurvePtr>(entity);
  if (is_curve && (!options.along.empty() || options.metric || !options.face.empty()))
    throw UsageError("--along, --metric and --face belong to surfaces");
  if (!is_curve && options.order) throw UsageError("--order belongs to curves");
  if (!is_curve && (options.placement || !options.on.empty()))
    throw UsageError("--placement and --on belong to curves");
  ordered_json out;
  if (!options.divided_difference.empty())
    out = divided_differences_of(entity, options);
  else if (!options.table.empty())
    out = evaluate_table(scene, entity, options);
  else if (!options.uv.empty())
    out = evaluate_uv(entity, options);
  else
    out = evaluate_at(scene, entity, options, place_of(entity, options));
  demand_finite(out);
  if (options.json) {
    fmt::print("{}\n", out.dump(2));
  } else if (out.contains("rows")) {
    for (const auto& row : out["rows"]) {
      if (&row != &out["rows"][0]) fmt::print("\n");
      print(row);
    }
  } else {
    print(out);
  }
  return kDone;
}

}  // namespace

void add_evaluate(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("evaluate", "A point of a curve or surface with derivatives and curvatures");
  sub->footer(
      "Examples:\n  lekalo evaluate ring.yaml section --at 0.5\n  lekalo evaluate ring.yaml ring --at pi/2,1.2 --json\n"
      "  lekalo evaluate wave.yaml wave --divided-difference 0,0,1,2\n\n"
      "Of a curve it prints derivatives, Frenet's frame, curvature and torsion, Darboux's vector, the osculating "
      "circle\n"
      "(its centre is the point of the evolute) and the osculating sphere. Divided differences are the coefficients "
      "of\n"
      "Newton's polynomial through the curve's points at the nodes; a node given twice stands for the derivative.\n\n"
      "Of a surface it prints the fundamental forms (E F G, L M N), Weingarten's map W (m_u = -W11 r_u - W12 r_v,\n"
      "m_v = -W21 r_u - W22 r_v), the derivatives of the normal, the principal curvatures with their directions, what\n"
      "kind of point it is, and the directions without normal curvature. Of a curve on a surface it prints the normal\n"
      "curvature and the geodesic curvature, positive where it turns left seen from the normal.\n\n"
      "Of a coordinate_surface --at takes the three coordinates, or t of their path, and tells the local basis, the "
      "metric,\n"
      "Christoffel's symbols (christoffel: [k][i][j] upper index first; riemann: [r][j][i][n] with n above, so that "
      "the "
      "scalar\n"
      "curvature of a surface is -2 K), and the derivatives of the fields that are given in these coordinates.\n\n"
      "--uv tells of a surface over triangles the barycentric coordinates of the place and, with --along, of the\n"
      "direction, and the derivatives by the parameters of the triangle.");
  auto options = std::make_shared<Options>();
  options->scene.add_to(*sub);
  sub->add_option("name", options->name, "name of the curve or surface")->required();
  sub->add_option("--at", options->at, "parameter t, or u,v; formulas without names")->type_name("T|U,V");
  auto* uv = sub->add_option(
                    "--uv", options->uv,
                    "of surfaces over triangles, one or many: the parameters of the triangles in place of the squares'")
                 ->type_name("U,V");
  sub->add_option("--table", options->table, "at each row of a table: t, or u and v")->type_name("FILE");
  auto* nodes = sub->add_option("--divided-difference", options->divided_difference,
                                "of a curve its divided differences over these nodes instead")
                    ->type_name("T,T,..");
  sub->add_option("--face", options->face, "face of a body or patch of a set, as trace and measure --topology call it")
      ->type_name("NUMBER|NAME");
  auto* along =
      sub->add_option("--along", options->along,
                      "of a surface its normal curvature in this direction of its parameters; of two the angle between")
          ->type_name("DU,DV")
          ->expected(1, 2);
  auto* tilt = sub->add_option("--tilt", options->tilt,
                               "of a surface the axis of a milling tool that runs in the first of these directions, at "
                               "this angle to the tangent plane")
                   ->type_name("DEGREES")
                   ->needs(along);
  auto* turn =
      sub->add_option(
             "--turn", options->turn,
             "the step of the parameter over which the tangent, or along u and v the normal, turns by this angle")
          ->type_name("DEGREES")
          ->check(CLI::PositiveNumber);
  auto* metric = sub->add_flag("--metric", options->metric,
                               "of a surface also Christoffel's symbols and the curvature tensors of its metric");
  auto* order = sub->add_option("--order", options->order, "derivatives of a curve up to this order")
                    ->check(CLI::Range(1, geometry::kMaxCurveOrder));
  auto* placement =
      sub->add_flag("--placement", options->placement,
                    "the matrix that places things at the point: columns tangent, normal, binormal and the point");
  auto* on = sub->add_option("--on", options->on,
                             "the same with the normal of a surface that the curve lies on, or between those of two")
                 ->type_name("NAME")
                 ->expected(1, 2);
  sub->add_option("--share", options->share, "of the first of two surfaces in the direction of the normal [0.5]")
      ->check(CLI::Range(0.0, 1.0))
      ->needs(on);
  // What these do not tell.
  uv->excludes(turn)->excludes(order)->excludes(metric)->excludes(tilt);
  nodes->excludes(turn)->excludes(order)->excludes(placement)->excludes(on);
  sub->add_flag("--json", options->json, "print JSON");
  sub->callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace lekalo::command
