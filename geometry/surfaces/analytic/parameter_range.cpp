#include "geometry/surfaces/analytic/parameter_range.h"

#include <fmt/format.h>

namespace lekalo::geometry {

namespace {

void check_direction(char name, const Interval& range, const Interval& limits, bool is_angle) {
  if (!(range.lo < range.hi)) throw std::invalid_argument(fmt::format("the range of {} is empty", name));
  if (is_angle && !(range.width() <= kTwoPi * (1 + 1e-12)))
    throw std::invalid_argument(fmt::format("the range of {} is longer than one turn", name));
  // Room for limits written with rounded multiples of pi.
  const double slack = 4 * range_slack(limits);
  if (!(range.lo >= limits.lo - slack && range.hi <= limits.hi + slack))
    throw std::invalid_argument(
        fmt::format("the range of {} must lie in [{:.6g}, {:.6g}]", name, limits.lo, limits.hi));
}

}  // namespace

void check_domain(const Rectangle& domain, const DomainRules& rules) {
  check_direction('u', domain.u, rules.limits.u, rules.u_is_angle);
  check_direction('v', domain.v, rules.limits.v, rules.v_is_angle);
}

Rectangle read_domain(const Fields& fields, const Rectangle& natural, const DomainRules& rules) {
  if (!fields.has("domain")) return natural;
  const Rectangle& domain = fields.rectangle("domain");
  try {
    check_domain(domain, rules);
  } catch (const std::invalid_argument& error) {
    throw FieldError("domain", error.what(), rules.u_is_angle ? "angles are in radians; 90 deg is accepted" : "");
  }
  return domain;
}

Rectangle read_heights(const Fields& fields, Rectangle domain, const std::function<double(double)>& parameter) {
  if (!fields.has("heights")) return domain;
  if (fields.has("domain")) throw FieldError("heights", "the surface is cut by heights or by a domain, not both");
  const Interval& heights = fields.range("heights");
  domain.v = {parameter(heights.lo), parameter(heights.hi)};
  return domain;
}

Vec3 read_semi_axes(const Fields& fields) {
  const std::vector<double>& axes = fields.numbers("semi_axes");
  for (const double axis : axes)
    if (!(axis > 0)) throw FieldError("semi_axes", "semi-axes must be positive");
  return {axes[0], axes[1], axes[2]};
}

}  // namespace lekalo::geometry
