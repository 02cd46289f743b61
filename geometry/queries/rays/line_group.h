// Lines on their way through pieces together: their arithmetic is done for several at once, the same operations in the
// same order as for one (line_cells.h), so that hits have the same bits.
#pragma once

#include <array>
#include <span>

#include "geometry/numerics/interval.h"
#include "geometry/queries/rays/line_cells.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

// Several lines, each with the range of t in which it is asked. Those that are not set are computed with, nothing else.
class LineGroup {
 public:
  static constexpr int kMaxLines = 8;
  using Numbers = std::array<double, kMaxLines>;  // one for each line
  using Vectors = std::array<Numbers, 3>;         // x of all, y, z

  void set(int i, const Line& line, const Interval& range);
  void set_end(int i, double t) { end_[i] = t; }
  Line line(int i) const;
  Interval range(int i) const { return {begin_[i], end_[i]}; }

  // Which of the lines asked, bit i for line i, enter the box of a cell in their ranges, and where the linear model has
  // their roots. `center`: of the cell's patch.
  struct Guesses {
    Numbers x, y, ex, ey;
    Guess of(int i) const { return {x[i], y[i], ex[i], ey[i]}; }
  };
  unsigned may_meet(unsigned asked, const PatchCell& cell, const Vec3& center, Guesses& guesses) const;

  // Newton's iteration in cells of the patch whose centre was asked for last, from guesses that are certain.
  struct Start {
    int line, piece;
    const PatchCell* cell;
    Guess guess;
  };
  struct End {
    Verdict verdict;
    CellHit hit;  // its t from the foot point
  };
  void iterate(const PatchView& patch, std::span<const Start> starts, End* ends) const;
  double foot_point(int i) const { return foot_point_[i]; }

 private:
  Vectors origin_{}, direction_{};
  Numbers begin_{}, end_{};
  // Made when they are first needed, as in PreparedLine and LineBasis.
  mutable bool is_split_ = false, has_bases_ = false, is_near_ = false;
  mutable Vectors upper_{}, lower_{}, n1_{}, n2_{}, unit_{};
  mutable Numbers inverse_length2_{}, inverse_length_{};
  // Of the last center, often the next one's too.
  mutable Vec3 center_{0};
  mutable Vectors near_{};
  mutable Numbers foot_point_{};
};

// What is found of a line of a group on a piece.
struct GroupHit {
  int line, piece;
  bool is_open;  // nothing yet: piece_hits has to be asked
  LineHit hit;
};

// At most one for each line and each of the pieces that are asked together.
class GroupHits {
 public:
  static constexpr int kMaxPieces = 2;
  void add(const GroupHit& hit) { hits_[count_++] = hit; }
  const GroupHit* begin() const { return hits_.data(); }
  const GroupHit* end() const { return hits_.data() + count_; }

 private:
  std::array<GroupHit, LineGroup::kMaxLines * kMaxPieces> hits_;  // not initialised
  int count_ = 0;
};

}  // namespace lekalo::geometry
