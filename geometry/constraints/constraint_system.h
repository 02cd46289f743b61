// Systems of geometric constraints (Golovanov 2016, chapter 7): unknown numbers with start values, and equations and
// inequalities between them. Of all solutions the one is taken that changes the unknowns least (7.5).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/constraints/constraint_solution.h"

namespace lekalo::geometry {

// f(p) = 0, or f(p) >= 0: `count` numbers of the unknowns.
struct Constraint {
  std::string name;  // for messages
  int count = 1;
  bool is_inequality = false;  // f >= 0, one number
  std::vector<int> unknowns;   // numbers of those that it depends on
  // Fills f, and the rows of the Jacobian over all unknowns, which are 0 before.
  std::function<void(std::span<const double> unknowns, Eigen::Ref<Eigen::VectorXd> f,
                     Eigen::Ref<Eigen::MatrixXd> jacobian)>
      evaluate;
};

struct ConstraintSystem {
  std::vector<double> start;
  std::vector<double> weights;  // of the unknowns' changes, positive; heavier ones move less
  std::vector<Constraint> constraints;
  double size = 1;  // a length of the model, which errors are relative to
};

// The solution with the least change: block by block where the system can be taken apart so (7.6), else as one. Throws
// ConstraintError.
ConstraintSolution solve(const ConstraintSystem& system);

// By blocks alone (decomposition.h); nothing where they do not say all: where one has no solution, or leaves unknowns
// free that its count holds, or where an inequality is no more than just met.
std::optional<ConstraintSolution> solved_by_blocks(const ConstraintSystem& system);

// Newton's method on the conditions of Lagrange for the least change, from the start; where it does not come to an end,
// or to a place from which the change can fall, steps of least norm to a solution first, and from it again.
// Inequalities that are violated become equations, those whose multiplier says that they hold nothing back cease to be
// one. Throws ConstraintError.
ConstraintSolution solved_as_one(const ConstraintSystem& system);

// The rank of the Jacobian at given unknowns, by singular values above 1e-9 of the largest.
int jacobian_rank(const ConstraintSystem& system, std::span<const double> unknowns);

// Velocities of the unknowns that keep all equations of the solution, one a column, orthonormal: the null space of the
// Jacobian. Inequalities that are met just so are equations.
Eigen::MatrixXd allowed_velocities(const ConstraintSystem& system, const ConstraintSolution& solution);

}  // namespace lekalo::geometry
