// A system of constraints taken apart (Golovanov 2016, 7.6): the bipartite graph of equations and unknowns, its maximum
// matching, the parts of Dulmage and Mendelsohn (1958), and in them the blocks that can be solved one after another
// (Ait-Aoudia, Jegou, Michelucci 1993).
#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/constraints/constraint_system.h"

namespace lekalo::geometry {

// By count alone: more equations than unknowns, as many, fewer. What the numbers make of it is the rank's to tell.
enum class Determined { over, well, under };
std::string_view name_of(Determined part);

// The i-th number of a constraint.
struct Equation {
  int constraint, number;
};

// Unknowns that can be found once those of the blocks before are known, by these equations.
struct SystemBlock {
  Determined part;
  std::vector<int> unknowns;
  std::vector<Equation> equations;
};

struct Decomposition {
  // In the order in which they are solved: over-determined ones, well determined ones, each of which cannot be split,
  // under-determined ones. Equations without unknowns are blocks without unknowns.
  std::vector<SystemBlock> blocks;
  int matched = 0;             // size of the maximum matching: the structural rank
  std::vector<int> unmatched;  // unknowns that no equation is left for; one of several choices
  size_t largest() const;      // number of unknowns of the largest block
};

// Of the equations, without inequalities. Which unknowns an equation depends on is seen in the Jacobian at a few places
// about the start.
Decomposition decomposed(const ConstraintSystem& system);

// Rigid parts of a framework of bars in the plane, for bars in general position, by the count of Laman (1970): a part
// of n points is rigid if 2 n - 3 independent bars connect them. By the pebble game of Jacobs and Hendrickson (1997).
// Each bar that says something new lies in one part, points may lie in several; of each part the points, ascending.
std::vector<std::vector<int>> rigid_parts(int points, std::span<const std::pair<int, int>> bars);

}  // namespace lekalo::geometry
