#include "geometry/queries/rays/line_group.h"

#include <algorithm>

#include "geometry/numerics/instruction_sets.h"
#include "geometry/queries/rays/cell_model.h"

namespace lekalo::geometry {

namespace {

using Numbers = LineGroup::Numbers;
constexpr int kMost = LineGroup::kMost;

// PreparedLine::near for all lines.
LEKALO_WIDE void move_to(const Vec3& center, const std::array<Numbers, 3>& origin,
                         const std::array<Numbers, 3>& direction, const std::array<Numbers, 3>& upper,
                         const std::array<Numbers, 3>& lower, const Numbers& inverse_length2,
                         std::array<Numbers, 3>& near, Numbers& foot_point) {
  for (int i = 0; i < kMost; ++i) {
    double from[3], error[3];
    for (int k = 0; k < 3; ++k) {
      from[k] = origin[k][i] - center[k];
      const double taken = origin[k][i] - from[k];
      error[k] = (origin[k][i] - (from[k] + taken)) + (taken - center[k]);
    }
    const double along = from[0] * direction[0][i] + from[1] * direction[1][i] + from[2] * direction[2][i];
    const double foot = static_cast<float>(-along * inverse_length2[i]);
    for (int k = 0; k < 3; ++k) near[k][i] = (from[k] + foot * upper[k][i]) + (foot * lower[k][i] + error[k]);
    foot_point[i] = foot;
  }
}

// The box of decide(patch, cell, ...) for all lines.
LEKALO_WIDE unsigned enters_box(const PatchCell& cell, const std::array<Numbers, 3>& near,
                                const std::array<Numbers, 3>& direction, const Numbers& foot_point,
                                const Numbers& begin, const Numbers& end) {
  double middle[3], lo[3], hi[3];
  for (int k = 0; k < 3; ++k) middle[k] = cell.frame[k][3], lo[k] = cell.lo[k], hi[k] = cell.hi[k];
  std::array<double, kMost> enters, leaves;
  for (int i = 0; i < kMost; ++i) enters[i] = begin[i] - foot_point[i], leaves[i] = end[i] - foot_point[i];
  for (int k = 0; k < 3; ++k) {
    const double x = cell.frame[0][k], y = cell.frame[1][k], z = cell.frame[2][k];
    for (int i = 0; i < kMost; ++i) {
      const double from = (near[0][i] - middle[0]) * x + (near[1][i] - middle[1]) * y + (near[2][i] - middle[2]) * z;
      const double along = direction[0][i] * x + direction[1][i] * y + direction[2][i] * z;
      const double per = 1 / along, at_lo = (lo[k] - from) * per, at_hi = (hi[k] - from) * per;
      const double first = at_lo < at_hi ? at_lo : at_hi, last = at_lo < at_hi ? at_hi : at_lo;
      enters[i] = enters[i] < first ? first : enters[i];
      leaves[i] = last < leaves[i] ? last : leaves[i];
    }
  }
  unsigned result = 0;
  for (int i = 0; i < kMost; ++i) result |= static_cast<unsigned>(!(enters[i] > leaves[i])) << i;
  return result;
}

}  // namespace

void LineGroup::set(int i, const Line& line, const Interval& range) {
  is_near_ = false;
  begin_[i] = range.lo;
  end_[i] = range.hi;
  for (int k = 0; k < 3; ++k) {
    origin_[k][i] = line.origin[k];
    direction_[k][i] = line.direction[k];
    upper_[k][i] = static_cast<float>(line.direction[k]);
    lower_[k][i] = line.direction[k] - upper_[k][i];
  }
  inverse_length2_[i] = 1 / glm::dot(line.direction, line.direction);
}

void LineGroup::move_near(const Vec3& center) const {
  if (is_near_ && center == center_) return;
  move_to(center, origin_, direction_, upper_, lower_, inverse_length2_, near_, foot_point_);
  is_near_ = true;
  center_ = center;
}

unsigned LineGroup::may_meet(const PatchCell& cell, const Vec3& center) const {
  move_near(center);
  return enters_box(cell, near_, direction_, foot_point_, begin_, end_);
}

}  // namespace lekalo::geometry
