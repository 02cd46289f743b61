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
  bool graph = false;
};

ordered_json as_json(const render::ConstraintGraph& graph) {
  ordered_json blocks = ordered_json::array();
  for (const auto& block : graph.blocks)
    blocks.push_back({{"part", block.part}, {"unknowns", block.unknowns}, {"conditions", block.conditions}});
  return {{"blocks", std::move(blocks)},
          {"largest", graph.largest},
          {"solved_by_blocks", graph.is_solved_by_blocks},
          {"unmatched", graph.unmatched},
          {"rigid_by_count", graph.rigid_by_count},
          {"rigid_by_rank", graph.rigid_by_rank}};
}

ordered_json as_json(const render::ConstraintReport& report, bool with_graph) {
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
  if (with_graph) out["graph"] = as_json(report.graph);
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

void print_parts(const char* what, const std::vector<std::vector<std::string>>& parts) {
  for (const auto& part : parts)
    if (part.size() > 2) fmt::print("{}: {}\n", what, fmt::join(part, ", "));
}

void print(const render::ConstraintGraph& graph) {
  fmt::print("{} block{}, the largest of {} unknown{}, solved {}:\n", graph.blocks.size(),
             graph.blocks.size() == 1 ? "" : "s", graph.largest, graph.largest == 1 ? "" : "s",
             graph.is_solved_by_blocks ? "one after another" : "as one");
  size_t number = 0;
  for (const auto& block : graph.blocks)
    fmt::print("{:4} {:5} {}{}{}\n", ++number, block.part, fmt::join(block.unknowns, ", "),
               block.conditions.empty() ? "" : " <- ", fmt::join(block.conditions, ", "));
  if (!graph.unmatched.empty()) fmt::print("no equation is left for: {}\n", fmt::join(graph.unmatched, ", "));
  print_parts("rigid by count of distances", graph.rigid_by_count);
  print_parts("rigid by rank", graph.rigid_by_rank);
}

int run(const Options& options) {
  const render::LoadedScene scene = options.scene.load();
  if (!scene.constraints) throw UsageError("the scene has no section 'constraints'");
  if (options.json) {
    const ordered_json out = as_json(*scene.constraints, options.graph);
    demand_finite(out);
    fmt::print("{}\n", out.dump(2));
  } else {
    print(*scene.constraints);
    if (options.graph) print(scene.constraints->graph);
  }
  return kDone;
}

}  // namespace

void add_solve(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("solve", "Tell what the constraints of a scene came to, and what they leave free");
  sub->footer(
      "Examples:\n"
      "  lekalo solve sketch.yaml\n"
      "  lekalo solve slider.yaml --set angle=40 --json\n"
      "  lekalo solve sketch.yaml --graph\n\n"
      "Points, variables and poses as found; unknowns, equations and their rank; what can still move, and which "
      "bodies\n"
      "cannot move against each other. With --graph also how the system is taken apart: its blocks in the order in "
      "which\n"
      "they are solved, with more equations than unknowns (over), as many (well) or fewer (under); the parts of a "
      "plane\n"
      "framework that are rigid by the count of its distances, and by the rank of all conditions.");
  auto options = std::make_shared<Options>();
  options->scene.add_to(*sub);
  sub->add_flag("--json", options->json, "machine-readable output");
  sub->add_flag("--graph", options->graph, "how the system is taken apart: blocks, rigid parts");
  sub->callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace lekalo::command
