// Is the place of a hit inside the domain: closed ranges, angles taken into them by whole turns; and the `domain` field
// of scene files.
#pragma once

#include <cmath>
#include <functional>
#include <optional>

#include "geometry/describe.h"
#include "geometry/surface.h"
#include "geometry/tolerances.h"

namespace lekalo::geometry {

// Room at the ends of a range: rounding (a few ulps of the largest number in it) and kHitSlack of its width, so that
// a line through the common border of two faces meets both; merge_hits makes that one crossing, or two of a graze.
inline double range_slack(const Interval& range) {
  const double lo = std::abs(range.lo), hi = std::abs(range.hi);
  const double largest = std::max(lo < kInfinity ? lo : 0.0, hi < kInfinity ? hi : 0.0);
  const double width = range.hi - range.lo;
  return 4 * std::numeric_limits<double>::epsilon() * largest + (width < kInfinity ? kHitSlack * width : 0.0);
}

// x moved into the range if it lies inside or within rounding of it, or nearer than `min_slack`.
inline std::optional<double> within(const Interval& range, double x, double min_slack = 0) {
  if (range.contains(x)) return x;
  const double slack = std::max(range_slack(range), min_slack);
  if (!(x >= range.lo - slack && x <= range.hi + slack)) return std::nullopt;
  return range.clamp(x);
}

// The same for an angle in [-pi, pi], which may be meant any number of turns away.
inline std::optional<double> angle_within(const Interval& range, double angle) {
  if (range.contains(angle)) return angle;
  if (range.contains(angle + kTwoPi)) return angle + kTwoPi;
  const double slack = 4 * std::numeric_limits<double>::epsilon() * std::max({kPi, -range.lo, range.hi});
  const double turns = std::ceil((range.lo - slack - angle) / kTwoPi);
  const double x = angle + turns * kTwoPi;
  if (x <= range.hi + slack) return range.clamp(x);
  return std::nullopt;
}

// True if the domain is as wide as `whole` both ways: all of a closed surface, its angles whole turns.
inline bool covers(const Rectangle& domain, const Rectangle& whole) {
  return domain.u.width() >= whole.u.width() && domain.v.width() >= whole.v.width();
}

// What a domain may be: within `limits`, and u (v) at most a turn wide where it is an angle.
struct DomainRules {
  Rectangle limits{Interval::entire(), Interval::entire()};
  bool u_is_angle = true;
  bool v_is_angle = false;
};

// The optional field `domain`, or `natural` where it is not given. Throws FieldError.
Rectangle read_domain(const Fields& fields, const Rectangle& natural, const DomainRules& rules);

// The domain with v between the parameters of the two heights of the optional field `heights`. Throws FieldError.
Rectangle read_heights(const Fields& fields, Rectangle domain, const std::function<double(double)>& parameter);

// The field `semi_axes` of three positive numbers. Throws FieldError.
Vec3 read_semi_axes(const Fields& fields);

// The same check as read_domain for C++ callers; throws std::invalid_argument.
void check_domain(const Rectangle& domain, const DomainRules& rules);

}  // namespace lekalo::geometry
