#include "geometry/queries/rays/line_group.h"

#include <algorithm>
#include <cmath>

#include "geometry/numerics/instruction_sets.h"
#include "geometry/queries/rays/cell_newton.h"
#include "geometry/queries/rays/line_basis.h"

namespace lekalo::geometry {

namespace {

using Numbers = LineGroup::Numbers;
using Vectors = LineGroup::Vectors;
constexpr int kMaxLines = LineGroup::kMaxLines;

// PreparedLine's parts of the directions of all lines.
LEKALO_WIDE void split(const Vectors& direction, Vectors& upper, Vectors& lower, Numbers& inverse_length2) {
  for (int i = 0; i < kMaxLines; ++i) {
    const double d[3] = {direction[0][i], direction[1][i], direction[2][i]};
    inverse_length2[i] = 1 / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; ++k) {
      upper[k][i] = static_cast<float>(d[k]);
      lower[k][i] = d[k] - upper[k][i];
    }
  }
}

// LineBasis of all lines.
LEKALO_WIDE void make_bases(const Vectors& direction, Vectors& to_n1, Vectors& to_n2, Vectors& to_unit,
                            Numbers& to_inverse_length) {
  for (int i = 0; i < kMaxLines; ++i) {
    const double d[3] = {direction[0][i], direction[1][i], direction[2][i]};
    const double length2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const double inverse_length = 1 / std::sqrt(length2);
    const double unit[3] = {inverse_length * d[0], inverse_length * d[1], inverse_length * d[2]};
    double n1[3], n2[3];
    vectors_across(unit, n1, n2);
    to_inverse_length[i] = inverse_length;
    for (int k = 0; k < 3; ++k) to_unit[k][i] = unit[k], to_n1[k][i] = n1[k], to_n2[k][i] = n2[k];
  }
}

LEKALO_WIDE void move_all_near(const Vectors& origin, const Vectors& direction, const Vectors& upper,
                               const Vectors& lower, const Numbers& inverse_length2, const Vec3& center, Vectors& near,
                               Numbers& foot_point) {
  for (int i = 0; i < kMaxLines; ++i) {
    double at[3];
    foot_point[i] =
        move_near({origin[0][i], origin[1][i], origin[2][i]}, {direction[0][i], direction[1][i], direction[2][i]},
                  {upper[0][i], upper[1][i], upper[2][i]}, {lower[0][i], lower[1][i], lower[2][i]}, inverse_length2[i],
                  center, at);
    for (int k = 0; k < 3; ++k) near[k][i] = at[k];
  }
}

// The box of decide(patch, cell, ...) for all lines.
LEKALO_WIDE unsigned enters_box(const PatchCell& cell, const Vectors& near, const Vectors& direction,
                                const Numbers& foot_point, const Numbers& begin, const Numbers& end) {
  double middle[3], lo[3], hi[3];
  for (int k = 0; k < 3; ++k) middle[k] = cell.frame[k][3], lo[k] = cell.lo[k], hi[k] = cell.hi[k];
  Numbers enters, leaves;
  for (int i = 0; i < kMaxLines; ++i) enters[i] = begin[i] - foot_point[i], leaves[i] = end[i] - foot_point[i];
  for (int k = 0; k < 3; ++k) {
    const double x = cell.frame[0][k], y = cell.frame[1][k], z = cell.frame[2][k];
    for (int i = 0; i < kMaxLines; ++i) {
      const double from = (near[0][i] - middle[0]) * x + (near[1][i] - middle[1]) * y + (near[2][i] - middle[2]) * z;
      const double along = direction[0][i] * x + direction[1][i] * y + direction[2][i] * z;
      const double per = 1 / along, at_lo = (lo[k] - from) * per, at_hi = (hi[k] - from) * per;
      const double first = at_lo < at_hi ? at_lo : at_hi, last = at_lo < at_hi ? at_hi : at_lo;
      enters[i] = enters[i] < first ? first : enters[i];
      leaves[i] = last < leaves[i] ? last : leaves[i];
    }
  }
  unsigned result = 0;
  for (int i = 0; i < kMaxLines; ++i) result |= static_cast<unsigned>(!(enters[i] > leaves[i])) << i;
  return result;
}

// Its guess. That everything is computed again costs less than to keep it from the box, which few lines enter.
LEKALO_WIDE void guess_roots(const PatchCell& cell, const Vectors& near, const Vectors& direction,
                             LineGroup::Guesses& guesses) {
  const double shift_x = cell.lo[3], shift_y = cell.hi[3], bend = cell.bend;
  double middle[3], x[3], y[3], z[3];
  for (int k = 0; k < 3; ++k)
    middle[k] = cell.frame[k][3], x[k] = cell.frame[0][k], y[k] = cell.frame[1][k], z[k] = cell.frame[2][k];
  for (int i = 0; i < kMaxLines; ++i) {
    double from[3], along[3];
    for (int k = 0; k < 3; ++k) {
      from[k] = (near[0][i] - middle[0]) * x[k] + (near[1][i] - middle[1]) * y[k] + (near[2][i] - middle[2]) * z[k];
      along[k] = direction[0][i] * x[k] + direction[1][i] * y[k] + direction[2][i] * z[k];
    }
    const double per = 1 / along[2], lean_x = along[0] * per, lean_y = along[1] * per;
    guesses.x[i] = from[0] - from[2] * lean_x;
    guesses.y[i] = from[1] - from[2] * lean_y;
    guesses.ex[i] = shift_x + std::abs(lean_x) * bend;
    guesses.ey[i] = shift_y + std::abs(lean_y) * bend;
  }
}

// Vectors or homogeneous points of four lines.
template <int kN>
struct Four {
  Lanes part[kN]{};
  const Lanes& operator[](int k) const { return part[k]; }
  friend Four operator*(const Lanes& f, const Four& v) {
    Four r;
    for (int k = 0; k < kN; ++k) r.part[k] = f * v.part[k];
    return r;
  }
  friend Four operator+(const Four& a, const Four& b) {
    Four r;
    for (int k = 0; k < kN; ++k) r.part[k] = a.part[k] + b.part[k];
    return r;
  }
  friend Four operator-(const Four& a, const Four& b) {
    Four r;
    for (int k = 0; k < kN; ++k) r.part[k] = a.part[k] - b.part[k];
    return r;
  }
  Four& operator+=(const Four& b) { return *this = *this + b; }
  // Adds a multiple of a control point.
  friend void add_product(const Lanes& f, const Vec4& p, Four& sum) {
    for (int k = 0; k < kN; ++k) sum.part[k] += f * p[k];
  }
};

// Four lines at their starts.
struct FourStarts {
  Lanes cell_x, cell_y, half_x, half_y, x, y, inverse_length;
  Four<3> axes[3], origin;
};

template <int kP, int kQ>
inline void iterate_as(const PatchView& patch, const FourStarts& from, std::span<const LineGroup::Start> starts,
                       LineGroup::End* ends) {
  using State = NewtonProgress::State;
  NewtonProgress progress[4];
  unsigned active = (1u << starts.size()) - 1;
  for (size_t i = 0; i < starts.size(); ++i) progress[i] = NewtonProgress(starts[i].guess);
  Four<3> origin;
  see(from.axes, from.origin[0], from.origin[1], from.origin[2], origin);
  Lanes x = from.x, y = from.y;
  do {
    SeenPlace<Lanes, Four<3>> p;
    see_patch<kP, kQ, Lanes, Four<4>, Four<3>>(patch, from.cell_x, from.cell_y, from.half_x, from.half_y, from.axes,
                                               origin, x, y, p);
    NewtonStep<Lanes> step;
    step_from(x, y, p, step);
    Lanes t;
    way_to(x, y, p, step, t);
    t *= from.inverse_length;
    for (unsigned rest = active; rest; rest &= rest - 1) {
      const int i = __builtin_ctz(rest);
      const NewtonStep<double> own{step.determinant[i], step.to_x[i], step.to_y[i], step.next_x[i], step.next_y[i]};
      const State state = progress[i].after(x[i], y[i], own, kBorderSlack, kBorderSlack);
      if (state == State::goes_on) continue;
      active &= ~(1u << i);
      ends[i].verdict = state == State::one ? Verdict::one : state == State::none ? Verdict::none : Verdict::unsure;
      ends[i].hit = {t[i], own.next_x, own.next_y};
    }
    x = step.next_x;
    y = step.next_y;
  } while (active);
}

LEKALO_WIDE void iterate_four(const PatchView& patch, const FourStarts& from, std::span<const LineGroup::Start> starts,
                              LineGroup::End* ends) {
  for_degrees(patch, [&]<int kP, int kQ>() { iterate_as<kP, kQ>(patch, from, starts, ends); });
}

}  // namespace

void LineGroup::set(int i, const Line& line, const Interval& range) {
  is_split_ = has_bases_ = is_near_ = false;
  begin_[i] = range.lo;
  end_[i] = range.hi;
  for (int k = 0; k < 3; ++k) {
    origin_[k][i] = line.origin[k];
    direction_[k][i] = line.direction[k];
  }
}

Line LineGroup::line(int i) const {
  return {{origin_[0][i], origin_[1][i], origin_[2][i]}, {direction_[0][i], direction_[1][i], direction_[2][i]}};
}

unsigned LineGroup::may_meet(unsigned asked, const PatchCell& cell, const Vec3& center, Guesses& guesses) const {
  if (!is_near_ || center != center_) {
    if (!is_split_) split(direction_, upper_, lower_, inverse_length2_);
    is_split_ = true;
    move_all_near(origin_, direction_, upper_, lower_, inverse_length2_, center, near_, foot_point_);
    is_near_ = true;
    center_ = center;
  }
  const unsigned met = asked & enters_box(cell, near_, direction_, foot_point_, begin_, end_);
  if (met) guess_roots(cell, near_, direction_, guesses);
  return met;
}

void LineGroup::iterate(const PatchView& patch, std::span<const Start> starts, End* ends) const {
  if (!has_bases_) make_bases(direction_, n1_, n2_, unit_, inverse_length_);
  has_bases_ = true;
  for (size_t first = 0; first < starts.size(); first += 4) {
    const std::span<const Start> some = starts.subspan(first, std::min<size_t>(4, starts.size() - first));
    FourStarts four;
    for (size_t i = 0; i < 4; ++i) {
      const Start& start = some[std::min(i, some.size() - 1)];
      const CellPlace place = start.cell->place();
      const int line = start.line;
      four.cell_x[i] = place.x, four.cell_y[i] = place.y, four.half_x[i] = place.hx, four.half_y[i] = place.hy;
      four.x[i] = std::clamp(start.guess.x, -1.0, 1.0), four.y[i] = std::clamp(start.guess.y, -1.0, 1.0);
      four.inverse_length[i] = inverse_length_[line];
      for (int k = 0; k < 3; ++k) {
        four.axes[k].part[0][i] = n1_[k][line];
        four.axes[k].part[1][i] = n2_[k][line];
        four.axes[k].part[2][i] = unit_[k][line];
        four.origin.part[k][i] = near_[k][line];
      }
    }
    iterate_four(patch, four, some, ends + first);
  }
}

}  // namespace lekalo::geometry
