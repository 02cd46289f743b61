// lekalo solve: what a scene's constraints came to, and what they leave free.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cmath>

#include "command.h"
#include "json.h"

namespace lekalo::command {

namespace {

struct Options {
  SceneOptions scene;
  bool json = false;
};

ordered_json as_json(const render::ConstraintReport& report) {
  ordered_json out{{"unknowns", report.unknowns},
                   {"equations", report.solution.equations},
                   {"rank", report.solution.rank},
                   {"freedom", report.solution.freedom},
                   {"formal_freedom", report.formal_freedom},
                   {"redundant", report.solution.redundant},
                   {"change", report.solution.change},
                   {"residual", report.solution.residual},
                   {"multipliers", report.solution.multipliers}};
  out["points"] = ordered_json::object();
  for (const auto& [name, point] : report.points) out["points"][name] = to_json(point);
  out["variables"] = ordered_json::object();
  for (const auto& [name, value] : report.variables) out["variables"][name] = value;
  out["parameters"] = ordered_json::object();
  for (const auto& [name, t] : report.parameters) out["parameters"][name] = t;
  out["poses"] = ordered_json::object();
  for (const auto& [name, pose] : report.poses)
    out["poses"][name] = {{"linear", to_json(pose.linear)}, {"offset", to_json(pose.offset)}};
  out["free"] = report.free;
  out["clusters"] = report.clusters;
  return out;
}

// Rounding about 0 is no number to read; JSON has all digits.
double shown(double x) { return std::abs(x) < 1e-15 ? 0 : x; }
std::string shown(const geometry::Vec3& p) { return fmt::format("{} {} {}", shown(p.x), shown(p.y), shown(p.z)); }

void print(const render::ConstraintReport& report) {
  const geometry::ConstraintSolution& s = report.solution;
  for (const auto& [name, point] : report.points) fmt::print("{:18} {}\n", name, shown(point));
  for (const auto& [name, value] : report.variables) fmt::print("{:18} {}\n", name, shown(value));
  for (const auto& [name, pose] : report.poses)
    fmt::print("{:18} moved by {}{}\n", name, shown(pose.offset), pose.linear == geometry::Mat3(1.0) ? "" : ", turned");
  fmt::print("{} unknowns, {} equations of rank {}: {} degree{} of freedom", report.unknowns, s.equations, s.rank,
             s.freedom, s.freedom == 1 ? "" : "s");
  if (s.redundant > 0) fmt::print(", {} equation{} too many", s.redundant, s.redundant == 1 ? "" : "s");
  fmt::print("\n");
  if (!report.free.empty()) fmt::print("free: {}\n", fmt::join(report.free, ", "));
  for (const auto& cluster : report.clusters)
    if (cluster.size() > 1) fmt::print("rigid: {}\n", fmt::join(cluster, ", "));
}

int run(const Options& options) {
  const render::LoadedScene scene = options.scene.load();
  if (!scene.constraints) throw UsageError("the scene has no section 'constraints'");
  if (options.json) {
    const ordered_json out = as_json(*scene.constraints);
    demand_finite(out);
    fmt::print("{}\n", out.dump(2));
  } else {
    print(*scene.constraints);
  }
  return kDone;
}

}  // namespace

void add_solve(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("solve", "Tell what the constraints of a scene came to, and what they leave free");
  sub->footer(
      "Examples:\n"
      "  lekalo solve sketch.yaml\n"
      "  lekalo solve slider.yaml --set angle=40 --json\n\n"
      "Points, variables and poses as found; unknowns, equations and their rank; what can still move, and which "
      "bodies\n"
      "cannot move against each other.");
  auto options = std::make_shared<Options>();
  options->scene.add_to(*sub);
  sub->add_flag("--json", options->json, "machine-readable output");
  sub->callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace lekalo::command
