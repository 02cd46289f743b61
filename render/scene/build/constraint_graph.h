// The graph of a scene's constraints in names (Golovanov 2016, 7.6).
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "geometry/constraints/conditions.h"
#include "render/scene/build/constraint_report.h"

namespace lekalo::render {

// What conditions between points of the plane say by their kind, names of points: distances, points that are one, and
// points that stay.
struct PlaneFramework {
  std::vector<std::pair<std::string, std::string>> bars, joined;
  std::vector<std::string> fixed;
};

// `unknowns`: their names; `velocities`: those that the solution allows, one a column.
ConstraintGraph constraint_graph(const geometry::ConstraintSystem& system, const geometry::ConstraintSolution& solution,
                                 const std::vector<std::string>& unknowns,
                                 const std::map<std::string, geometry::UnknownPoint>& points,
                                 const PlaneFramework& framework, const Eigen::MatrixXd& velocities);

}  // namespace lekalo::render
