// What is known of a scene's constraints after they are solved.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "geometry/constraints/constraint_solution.h"
#include "geometry/vectors.h"

namespace lekalo::render {

struct ConstraintReport {
  geometry::ConstraintSolution solution;
  std::map<std::string, geometry::Vec3> points;
  std::map<std::string, double> variables;
  std::map<std::string, double> parameters;  // of points on curves
  std::map<std::string, geometry::Affine> poses;
  std::vector<std::string> free;  // names of what can still move
  // Bodies that cannot move against each other, "ground" among them.
  std::vector<std::vector<std::string>> clusters;
  int unknowns = 0;
  int formal_freedom = 0;  // unknowns - equations, each condition counted fully (Golovanov 2016, 7.6.1)
};

}  // namespace lekalo::render
