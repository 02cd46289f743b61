// lekalo evaluate: a point of a curve or surface with derivatives, normal and curvatures.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "command.h"
#include "geometry/queries/differential/curvature.h"
#include "geometry/queries/differential/divided_difference.h"
#include "geometry/queries/differential/osculation.h"
#include "geometry/queries/differential/trihedron.h"
#include "parameters.h"

namespace lekalo::command {

namespace {

using geometry::Vec3;

ordered_json json_or_null(bool known, double x) { return known ? finite_or_null(x) : ordered_json(nullptr); }

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

ordered_json evaluate_surface(const geometry::Surface& surface, double u, double v) {
  const geometry::SurfaceJet jet = surface.evaluate(u, v, 2);
  ordered_json out;
  out["u"] = u;
  out["v"] = v;
  out["point"] = to_json(jet.point());
  out["du"] = finite_or_null(jet.du());
  out["dv"] = finite_or_null(jet.dv());
  out["duu"] = finite_or_null(jet.duu());
  out["duv"] = finite_or_null(jet.duv());
  out["dvv"] = finite_or_null(jet.dvv());
  const Vec3 normal = surface.normal(u, v);
  out["normal"] = finite_or_null(normal);
  const geometry::SurfaceCurvature c = geometry::curvature(surface, u, v);
  out["gaussian_curvature"] = json_or_null(c.regular, c.gaussian);
  out["mean_curvature"] = json_or_null(c.regular, c.mean);
  out["principal_curvatures"] =
      c.regular ? ordered_json::array({c.principal[0], c.principal[1]}) : ordered_json(nullptr);
  out["parameters"] = parameters_of(surface);
  return out;
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
    } else if (value.is_array()) {
      std::string text;
      for (const auto& x : value) text += (text.empty() ? "" : " ") + digits(x.get<double>());
      fmt::print("{:<21} {}\n", key, text);
    } else {
      fmt::print("{:<21} {}\n", key, digits(value.get<double>()));
    }
  }
}

struct Options {
  SceneOptions scene;
  std::string name, at, face, divided_difference;
  std::vector<std::string> on;
  double share = 0.5;
  int order = 2;
  bool placement = false, json = false;
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
  for (size_t i = 0; i < count; ++i)
    if (options.face == std::to_string(i) || (count == 1 && options.face.empty()) ||
        (body && options.face == (*body)->faces[i].origin.text()))
      return set ? (*set)[i] : (*body)->faces[i].surface;
  const std::string hint =
      fmt::format("--face 0 to {}{}", count - 1, body ? ", or a name of 'lekalo measure --topology'" : "");
  if (options.face.empty())
    throw UsageError(fmt::format("'{}' has {} faces; say which one: {}", options.name, count, hint));
  throw UsageError(fmt::format("'{}' has no face '{}'; take {}", options.name, options.face, hint));
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

int run(const Options& options) {
  if (options.at.empty() == options.divided_difference.empty())
    throw UsageError(
        "evaluate takes --at T or --at U,V, or of a curve --divided-difference T,T,..\n"
        "'lekalo evaluate --help' shows how to use it");
  const render::LoadedScene scene = options.scene.load();
  const render::Entity& entity = find_geometry(scene, options.name);
  ordered_json out;
  if (!options.divided_difference.empty()) {
    const auto* curve = std::get_if<geometry::CurvePtr>(&entity);
    if (!curve)
      throw UsageError(fmt::format("'{}' is no curve: divided differences are those of curves", options.name));
    const std::vector<double> nodes = parse_numbers(options.divided_difference, 0, "--divided-difference");
    for (const double t : nodes) note_outside("t", t, (*curve)->domain(), (*curve)->period());
    out = differences_of(**curve, nodes);
  } else if (const auto* curve = std::get_if<geometry::CurvePtr>(&entity)) {
    const double t = parse_numbers(options.at, 1, "--at of a curve")[0];
    note_outside("t", t, (*curve)->domain(), (*curve)->period());
    out = evaluate_curve(**curve, t, options.order);
    if (options.placement || !options.on.empty()) out["placement"] = placement_of(scene, **curve, t, options);
  } else {
    if (options.placement || !options.on.empty()) throw UsageError("--placement and --on belong to curves");
    const geometry::SurfacePtr surface = surface_of(entity, options);
    const std::vector<double> uv = parse_numbers(options.at, 2, "--at of a surface");
    note_outside("u", uv[0], surface->domain().u, surface->periods().u);
    note_outside("v", uv[1], surface->domain().v, surface->periods().v);
    out = evaluate_surface(*surface, uv[0], uv[1]);
  }
  demand_finite(out);
  if (options.json)
    fmt::print("{}\n", out.dump(2));
  else
    print(out);
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
      "Newton's polynomial through the curve's points at the nodes; a node given twice stands for the derivative.");
  auto options = std::make_shared<Options>();
  options->scene.add_to(*sub);
  sub->add_option("name", options->name, "name of the curve or surface")->required();
  sub->add_option("--at", options->at, "parameter t, or u,v; formulas without names")->type_name("T|U,V");
  sub->add_option("--divided-difference", options->divided_difference,
                  "of a curve its divided differences over these nodes instead")
      ->type_name("T,T,..");
  sub->add_option("--face", options->face, "face of a body or patch of a set, as trace and measure --topology call it")
      ->type_name("NUMBER|NAME");
  sub->add_option("--order", options->order, "derivatives of a curve up to this order")
      ->check(CLI::Range(1, geometry::kMaxCurveOrder));
  sub->add_flag("--placement", options->placement,
                "the matrix that places things at the point: columns tangent, normal, binormal and the point");
  auto* on = sub->add_option("--on", options->on,
                             "the same with the normal of a surface that the curve lies on, or between those of two")
                 ->type_name("NAME")
                 ->expected(1, 2);
  sub->add_option("--share", options->share, "of the first of two surfaces in the direction of the normal [0.5]")
      ->check(CLI::Range(0.0, 1.0))
      ->needs(on);
  sub->add_flag("--json", options->json, "print JSON");
  sub->callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace lekalo::command
