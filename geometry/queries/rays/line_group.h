// Lines on their way through pieces together: what most of them are turned away by is computed for all at once.
#pragma once

#include <array>

#include "geometry/numerics/interval.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

struct PatchCell;

// Several lines, each with the range of t in which it is asked. A filter before the solver (line_cells.h), which
// decides each line by itself: whatever comes through here, hits have the same bits as without it.
class LineGroup {
 public:
  static constexpr int kMost = 8;
  using Numbers = std::array<double, kMost>;  // one for each line

  // Lines that are not set are never asked for, but computed with.
  void set(int i, const Line& line, const Interval& range);
  void set_end(int i, double t) { end_[i] = t; }

  // Which lines may meet a cell of a patch in their ranges: bit i for line i. The same operations in the same order as
  // of intersect(patch, cell, ...), which turns away the others. `center`: of the patch.
  unsigned may_meet(const PatchCell& cell, const Vec3& center) const;

 private:
  void move_near(const Vec3& center) const;

  using Vectors = std::array<Numbers, 3>;
  Vectors origin_{}, direction_{};
  Vectors upper_{}, lower_{};  // as in PreparedLine
  Numbers inverse_length2_{};
  Numbers begin_{}, end_{};
  // Of the last center, often the next one's too.
  mutable bool is_near_ = false;
  mutable Vec3 center_{0};
  mutable Vectors near_{};
  mutable Numbers foot_point_{};
};

}  // namespace lekalo::geometry
