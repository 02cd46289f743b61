// What a system of constraints came to (Golovanov 2016, chapter 7).
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace lekalo::geometry {

struct ConstraintSolution {
  std::vector<double> unknowns;
  double change = 0;                // sum of w (p - p_start)^2 / 2
  int equations = 0;                // inequalities that hold with room are none
  int rank = 0;                     // of the Jacobian there
  int freedom = 0;                  // unknowns - rank: degrees of freedom that are left
  int redundant = 0;                // equations - rank
  double residual = 0;              // the largest that is left
  bool by_blocks = false;           // found block by block
  std::vector<int> active;          // numbers of the constraints that are equations there
  std::vector<double> multipliers;  // of the equations in their order (Golovanov 2016, 7.5.2)
};

// The equations contradict each other, or no solution was found from the start.
class ConstraintError : public std::runtime_error {
 public:
  ConstraintError(const std::string& message, std::vector<std::string> unmet)
      : std::runtime_error(message), unmet(std::move(unmet)) {}
  std::vector<std::string> unmet;  // names of the constraints, the one farthest from being met first
};

}  // namespace lekalo::geometry
