// What is known of a scene's constraints after they are solved.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "geometry/constraints/constraint_solution.h"
#include "geometry/vectors.h"

namespace lekalo::render {

// How the system is taken apart (Golovanov 2016, 7.6).
struct ConstraintGraph {
  struct Block {
    std::string part;  // "over", "well" or "under": determined, by count
    std::vector<std::string> unknowns, conditions;
  };
  std::vector<Block> blocks;  // in the order in which they are solved
  size_t largest = 0;         // number of unknowns of the largest block
  bool is_solved_by_blocks = false;
  std::vector<std::string> unmatched;  // unknowns for which no equation is left, by one of several choices
  // Points of the plane that keep their distances: by the count of the distances given, by the rank of all conditions.
  std::vector<std::vector<std::string>> rigid_by_count, rigid_by_rank;
};

struct ConstraintReport {
  geometry::ConstraintSolution solution;
  std::map<std::string, geometry::Vec3> points;
  std::map<std::string, double> variables;
  std::map<std::string, double> parameters;  // of points on curves
  std::map<std::string, geometry::Affine> poses;
  std::vector<std::string> free;  // names of what can still move
  // Bodies that cannot move against each other, "ground" among them.
  std::vector<std::vector<std::string>> clusters;
  ConstraintGraph graph;
  int unknowns = 0;
  int formal_freedom = 0;  // unknowns - equations, each condition counted fully (Golovanov 2016, 7.6.1)
};

}  // namespace lekalo::render
