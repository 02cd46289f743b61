#include "parameters.h"

#include <fmt/format.h>

#include <cmath>

#include "command.h"
#include "geometry/queries/contours/parameter_lines.h"

namespace lekalo::command {

namespace {

ordered_json entry(const char* name, const geometry::Interval& domain, double period, bool closed) {
  const auto finite = [](double x) { return std::isfinite(x) ? ordered_json(x) : ordered_json(nullptr); };
  return {{"name", name},
          {"domain", ordered_json::array({finite(domain.lo), finite(domain.hi)})},
          {"period", period > 0 ? ordered_json(period) : ordered_json(nullptr)},
          {"closed", closed}};
}

}  // namespace

ordered_json parameters_of(const geometry::Curve& curve) {
  const geometry::Interval domain = curve.domain();
  const bool bounded = domain.width() < geometry::kInfinity;
  return ordered_json::array({entry("t", domain, curve.period(), bounded && curve.is_closed())});
}

ordered_json parameters_of(const geometry::Surface& surface) {
  using geometry::IsoDirection;
  const geometry::Rectangle domain = surface.domain();
  const bool bounded = surface.bounded();
  return ordered_json::array(
      {entry("u", domain.u, surface.periods().u, bounded && is_closed_in(surface, IsoDirection::u)),
       entry("v", domain.v, surface.periods().v, bounded && is_closed_in(surface, IsoDirection::v))});
}

void print_parameters(const ordered_json& parameters) {
  const auto end = [](const ordered_json& x) { return x.is_null() ? "infinity" : digits(x.get<double>()); };
  for (const ordered_json& one : parameters) {
    const std::string lo = one["domain"][0].is_null() ? "-infinity" : end(one["domain"][0]);
    const std::string period = one["period"].is_null() ? "" : ", period " + digits(one["period"].get<double>());
    fmt::print("{:<21} {} to {}{}{}\n", "domain of " + one["name"].get<std::string>(), lo, end(one["domain"][1]),
               period, one["closed"].get<bool>() ? ", closed" : "");
  }
}

void note_outside(const char* name, double x, const geometry::Interval& domain, double period) {
  const bool repeats = period > 0 && domain.width() >= period * (1 - 1e-12);
  if (repeats || domain.contains(x)) return;
  const double wrapped = period > 0 ? x - period * std::floor((x - domain.lo) / period) : x;
  const std::string which = domain.contains(wrapped) ? fmt::format("by the period the place is {:.9g}", wrapped)
                                                     : std::string("this is the continuation");
  fmt::print(stderr, "note: {} = {:.9g} lies outside the domain {:.9g} to {:.9g}, {}\n", name, x, domain.lo, domain.hi,
             which);
}

}  // namespace lekalo::command
