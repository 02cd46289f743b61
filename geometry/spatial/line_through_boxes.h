// A line on its way through boxes, for hierarchies in double precision.
//
// Boxes are taken larger by the rounding of places on the line, which are computed from its origin, and of the boxes'
// own coordinates: what meets a line knows its hits no better.
//
// The extremes are taken in an order in which a NaN, of a line that runs in the plane of a side, changes nothing.
#pragma once

#include <algorithm>
#include <cmath>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "geometry/numerics/interval.h"
#include "geometry/vectors.h"

namespace lekalo::geometry {

class LineThroughBoxes {
 public:
  // `farthest`: the largest coordinate of the boxes; 0 for such as are inflated beyond its rounding.
  explicit LineThroughBoxes(const Line& line, double farthest = 0);

  // Whether the line may be in the box at t in the range, for boxes that are inflated beyond the rounding of the test:
  // 4e-16 of the way from the line's origin to the box.
  bool may_enter(const Box3& box, const Interval& range) const;
  // The same for any box: true wherever the line is in it, whatever the rounding.
  bool meets(const Box3& box, const Interval& range) const;

 private:
  // Of a place, as a part of the origin's coordinates and of the boxes'.
  static constexpr double kPlaceRounding = 4e-16;
  // Of t, where it is compared; each side of it has at most three roundings.
  static constexpr double kRounding = 1e-15;
  // No line is followed further: beside a box, and going neither to it nor from it, it has the box at infinity.
  static constexpr double kFarthest = 1e308;

#ifdef __SSE2__
  // x and y together, then z. The extremes of two are the second where one is a NaN.
  struct Stretch {
    __m128d begin, end;  // the lower lanes
  };
  Stretch inside(const Box3& box, const Interval& range) const;

  // Beyond the origin by its rounding, for the lower and for the upper sides.
  __m128d above_xy_, above_z_, below_xy_, below_z_, inverse_xy_, inverse_z_;
#else
  struct Stretch {
    double begin, end;
  };
  Stretch inside(const Box3& box, const Interval& range) const;

  Vec3 above_, below_, inverse_;
#endif
};

#ifdef __SSE2__
inline LineThroughBoxes::LineThroughBoxes(const Line& line, double farthest)
    : inverse_xy_(_mm_div_pd(_mm_set1_pd(1), _mm_loadu_pd(&line.direction.x))),
      inverse_z_(_mm_div_sd(_mm_set_sd(1), _mm_load_sd(&line.direction.z))) {
  const __m128d xy = _mm_loadu_pd(&line.origin.x), z = _mm_load_sd(&line.origin.z), sign = _mm_set1_pd(-0.0),
                part = _mm_set1_pd(kPlaceRounding), more = _mm_set1_pd(farthest),
                by_xy = _mm_mul_pd(part, _mm_add_pd(_mm_andnot_pd(sign, xy), more)),
                by_z = _mm_mul_sd(part, _mm_add_sd(_mm_andnot_pd(sign, z), more));
  above_xy_ = _mm_add_pd(xy, by_xy);
  below_xy_ = _mm_sub_pd(xy, by_xy);
  above_z_ = _mm_add_sd(z, by_z);
  below_z_ = _mm_sub_sd(z, by_z);
}

inline LineThroughBoxes::Stretch LineThroughBoxes::inside(const Box3& box, const Interval& range) const {
  const __m128d a = _mm_mul_pd(_mm_sub_pd(_mm_loadu_pd(&box.lo.x), above_xy_), inverse_xy_),
                b = _mm_mul_pd(_mm_sub_pd(_mm_loadu_pd(&box.hi.x), below_xy_), inverse_xy_),
                a_z = _mm_mul_sd(_mm_sub_sd(_mm_load_sd(&box.lo.z), above_z_), inverse_z_),
                b_z = _mm_mul_sd(_mm_sub_sd(_mm_load_sd(&box.hi.z), below_z_), inverse_z_);
  const __m128d in = _mm_min_pd(b, a), out = _mm_max_pd(b, a), in_z = _mm_min_sd(b_z, a_z),
                out_z = _mm_max_sd(b_z, a_z);
  __m128d begin = _mm_max_sd(in, _mm_load_sd(&range.lo)), end = _mm_min_sd(out, _mm_load_sd(&range.hi));
  begin = _mm_max_sd(_mm_unpackhi_pd(in, in), begin);
  end = _mm_min_sd(_mm_unpackhi_pd(out, out), end);
  return {_mm_max_sd(in_z, begin), _mm_min_sd(out_z, end)};
}

inline bool LineThroughBoxes::may_enter(const Box3& box, const Interval& range) const {
  const Stretch s = inside(box, range);
  return _mm_comile_sd(s.begin, s.end);
}

inline bool LineThroughBoxes::meets(const Box3& box, const Interval& range) const {
  const Stretch s = inside(box, range);
  const __m128d far = _mm_set_sd(kFarthest), begin = _mm_max_sd(s.begin, _mm_set_sd(-kFarthest)),
                end = _mm_min_sd(s.end, far), size = _mm_min_sd(_mm_andnot_pd(_mm_set_sd(-0.0), end), far);
  return _mm_comile_sd(begin, _mm_add_sd(end, _mm_mul_sd(_mm_set_sd(kRounding), size)));
}
#else
inline LineThroughBoxes::LineThroughBoxes(const Line& line, double farthest)
    : above_(line.origin + kPlaceRounding * (glm::abs(line.origin) + farthest)),
      below_(line.origin - kPlaceRounding * (glm::abs(line.origin) + farthest)),
      inverse_(1.0 / line.direction) {}

inline LineThroughBoxes::Stretch LineThroughBoxes::inside(const Box3& box, const Interval& range) const {
  Stretch s{range.lo, range.hi};
  for (int k = 0; k < 3; ++k) {
    const double a = (box.lo[k] - above_[k]) * inverse_[k], b = (box.hi[k] - below_[k]) * inverse_[k];
    s.begin = std::max(s.begin, std::min(a, b));
    s.end = std::min(s.end, std::max(a, b));
  }
  return s;
}

inline bool LineThroughBoxes::may_enter(const Box3& box, const Interval& range) const {
  const Stretch s = inside(box, range);
  return s.begin <= s.end;
}

inline bool LineThroughBoxes::meets(const Box3& box, const Interval& range) const {
  const Stretch s = inside(box, range);
  const double end = std::min(s.end, kFarthest);
  return std::max(s.begin, -kFarthest) <= end + kRounding * std::min(std::abs(end), kFarthest);
}
#endif

}  // namespace lekalo::geometry
