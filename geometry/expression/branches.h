// Formulas that are made of branches, as the smooth formulas they are made of: |a| is a where a >= 0 and -a elsewhere,
// max(a, b) is a where a - b >= 0 and b elsewhere, likewise min, clamp, sign and `if`; floor(a) is n where a - n >= 0
// and a - (n + 1) <= 0, likewise ceil, round and mod.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/expression/expression.h"

namespace lekalo::geometry {

struct ExpressionBranch {
  // Where `height` is not negative, or not positive; it may be made of branches itself. Of the two branches that meet
  // where it vanishes one has the positive side.
  struct Side {
    Expression height;
    bool positive = true;
  };
  std::vector<Expression> formulas;
  std::vector<Side> sides;
};

// Of bound formulas of the same variables, chosen together: equal parts are on equal sides. floor, ceil, round and mod
// stay as they are where they would make more than 256 branches, and without the `ranges` of the variables; atan2
// always. None where there are more than 256.
std::optional<std::vector<ExpressionBranch>> expression_branches(std::span<const Expression> formulas,
                                                                 std::span<const Interval> ranges = {});

// Whether there are steps that branches may tell of: floor, ceil, round, mod, sign or `if`.
bool have_steps(std::span<const Expression> formulas);

}  // namespace lekalo::geometry
