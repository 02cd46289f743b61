// How smoothly curves, surfaces and the faces of a body join.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "command.h"
#include "geometry/queries/differential/continuity.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::Continuity;
using geometry::ContinuityTolerances;
using geometry::IsoDirection;

constexpr const char* kJumps[] = {"gap", "angle", "curvature", "curvature_derivative"};

void put(ordered_json& row, const Continuity& continuity) {
  row["order"] = continuity.order;
  for (int i = 0; i < 4; ++i) {
    const geometry::ContinuityJump& jump = continuity.jumps[i];
    row[kJumps[i]] = {
        {"largest", jump.largest}, {"relative", jump.relative}, {"t", jump.t}, {"point", to_json(jump.point)}};
  }
}

ordered_json edge_row(const geometry::DomainEdge& edge) {
  const bool holds_u = edge.held == IsoDirection::u;
  return {{holds_u ? "u" : "v", edge.at}, {holds_u ? "v_range" : "u_range", range(edge.range)}};
}

ordered_json joints_of(const geometry::Curve& a, const geometry::Curve& b, const ContinuityTolerances& tolerances) {
  const geometry::CurveJoint found = joint(a, b, tolerances);
  ordered_json row{{"end", found.a_end ? "last" : "first"}, {"end_other", found.b_end ? "last" : "first"}};
  put(row, found.continuity);
  return ordered_json::array({row});
}

ordered_json joints_of(const geometry::Curve& curve, const ContinuityTolerances& tolerances) {
  ordered_json rows = ordered_json::array();
  for (const geometry::CurveOwnJoint& one : joints(curve, tolerances)) {
    ordered_json row{{"t", one.t}};
    put(row, one.continuity);
    rows.push_back(std::move(row));
  }
  return rows;
}

ordered_json joints_of(const geometry::Surface& a, const geometry::Surface& b, const ContinuityTolerances& tolerances) {
  ordered_json rows = ordered_json::array();
  for (const geometry::SurfaceJoint& one : joints(a, b, tolerances)) {
    ordered_json row{{"edge", edge_row(one.a)}, {"edge_other", edge_row(one.b)}};
    put(row, one.continuity);
    rows.push_back(std::move(row));
  }
  return rows;
}

ordered_json joints_of(const geometry::Body& body, const ContinuityTolerances& tolerances) {
  ordered_json rows = ordered_json::array();
  for (size_t k = 0; k < body.edges.size(); ++k) {
    const geometry::Edge& edge = body.edges[k];
    if (edge.kind == geometry::EdgeKind::pole || edge.coedges.size() != 2) continue;
    ordered_json row{{"edge", k}};
    row["faces"] = ordered_json::array();
    for (const int coedge : edge.coedges) row["faces"].push_back(body.loops[body.coedges[coedge].loop].face);
    put(row, continuity(body, static_cast<int>(k), tolerances));
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string edge_text(const ordered_json& edge) {
  const bool holds_u = edge.contains("u");
  const ordered_json& reach = edge[holds_u ? "v_range" : "u_range"];
  return fmt::format("{} {:.9g}, {} {:.9g} to {:.9g}", holds_u ? "u" : "v", edge[holds_u ? "u" : "v"].get<double>(),
                     holds_u ? "v" : "u", reach[0].get<double>(), reach[1].get<double>());
}

std::string joint_text(const ordered_json& joint) {
  if (joint.contains("faces"))
    return fmt::format("edge {}, faces {} and {}", joint["edge"].get<int>(), joint["faces"][0].get<int>(),
                       joint["faces"][1].get<int>());
  if (joint.contains("t")) return fmt::format("t {:.9g}", joint["t"].get<double>());
  if (joint.contains("end"))
    return fmt::format("{} end with {} end", joint["end"].get<std::string>(), joint["end_other"].get<std::string>());
  return edge_text(joint["edge"]) + " with " + edge_text(joint["edge_other"]);
}

}  // namespace

ordered_json continuity_of(const std::string& name, const render::Entity& entity, const std::string& other_name,
                           const render::Entity* other, double tolerance) {
  const ContinuityTolerances tolerances{{tolerance, tolerance, tolerance, tolerance}};
  ordered_json out{{"name", name}};
  try {
    ordered_json found;
    if (!other) {
      const auto* body = std::get_if<geometry::BodyPtr>(&entity);
      const auto* curve = std::get_if<geometry::CurvePtr>(&entity);
      if (!body && !curve)
        throw UsageError(fmt::format("'{}' is neither a curve nor a body: --continuity needs another surface", name));
      found = body ? joints_of(**body, tolerances) : joints_of(**curve, tolerances);
    } else {
      const auto *a = std::get_if<geometry::CurvePtr>(&entity), *b = std::get_if<geometry::CurvePtr>(other);
      const auto *s = std::get_if<geometry::SurfacePtr>(&entity), *t = std::get_if<geometry::SurfacePtr>(other);
      if (!(a && b) && !(s && t))
        throw UsageError(fmt::format("'{}' and '{}' do not join: two curves can, or two surfaces", name, other_name));
      found = a && b ? joints_of(**a, **b, tolerances) : joints_of(**s, **t, tolerances);
      out["with"] = other_name;
    }
    out["tolerance"] = tolerance;
    out["joints"] = std::move(found);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}'{}: {}", name, other ? fmt::format(" with '{}'", other_name) : "", error.what()));
  }
  return out;
}

void print_continuity(const ordered_json& found) {
  fmt::print("'{}'{}: {} joint{}\n", found["name"].get<std::string>(),
             found.contains("with") ? fmt::format(" with '{}'", found["with"].get<std::string>()) : "",
             found["joints"].size(), found["joints"].size() == 1 ? "" : "s");
  for (const ordered_json& joint : found["joints"]) {
    const int order = joint["order"].get<int>();
    fmt::print("  {}: {}\n", order < 0 ? "gap" : fmt::format("G{}", order), joint_text(joint));
    for (const char* key : kJumps) {
      const ordered_json& jump = joint[key];
      std::string label = key;
      std::replace(label.begin(), label.end(), '_', ' ');
      fmt::print("    {:<21} {:<12.4g} relative {:<12.4g} at t {:<12.9g} point {}\n", label,
                 jump["largest"].get<double>(), jump["relative"].get<double>(), jump["t"].get<double>(),
                 digits(vector_of(jump["point"])));
    }
  }
}

}  // namespace lekalo::command
