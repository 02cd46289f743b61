// Two curves or two surfaces of one scene at the same parameters.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "command.h"
#include "geometry/queries/differential/deviation.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::Deviation;
using geometry::Interval;
using geometry::Vec2;

// So many surface points are evaluated at a time: enough that a program behind one of the surfaces is rarely waited
// for.
constexpr size_t kAtATime = 1 << 16;

std::vector<double> places(const Interval& domain, int samples) {
  std::vector<double> result;
  for (int i = 0; i < samples; ++i)
    result.push_back(i == samples - 1 ? domain.hi : domain.lo + domain.width() * i / (samples - 1));
  return result;
}

void merge(std::vector<Deviation>& all, const std::vector<Deviation>& more) {
  if (all.empty()) all.resize(more.size());
  for (size_t i = 0; i < more.size(); ++i) {
    const double scale = std::max(all[i].scale, more[i].scale);
    if (all[i].quantity.empty() || more[i].largest > all[i].largest) all[i] = more[i];
    all[i].scale = scale;
  }
}

std::vector<Deviation> compare(const geometry::Surface& a, const geometry::Surface& b, int samples, int order) {
  std::vector<Deviation> result;
  std::vector<Vec2> uv;
  const std::vector<double> along_u = places(a.domain().u, samples), along_v = places(a.domain().v, samples);
  for (const double u : along_u) {
    for (const double v : along_v) uv.emplace_back(u, v);
    if (uv.size() < kAtATime && u != along_u.back()) continue;
    merge(result, geometry::deviations(a, b, uv, order));
    uv.clear();
  }
  return result;
}

ordered_json number_or_null(double x) { return std::isfinite(x) ? ordered_json(x) : ordered_json(nullptr); }

}  // namespace

ordered_json compare_pair(const std::string& name, const render::Entity& entity, const std::string& other_name,
                          const render::Entity& other, int samples, int order, std::optional<double> tolerance) {
  const auto* curve = std::get_if<geometry::CurvePtr>(&entity);
  const auto* surface = std::get_if<geometry::SurfacePtr>(&entity);
  const auto* other_curve = std::get_if<geometry::CurvePtr>(&other);
  const auto* other_surface = std::get_if<geometry::SurfacePtr>(&other);
  if (!(curve && other_curve) && !(surface && other_surface))
    throw UsageError(
        fmt::format("'{}' and '{}' cannot be compared: two curves can, or two surfaces", name, other_name));
  std::vector<Deviation> found;
  try {
    found = curve ? geometry::deviations(**curve, **other_curve, places((*curve)->domain(), samples), order)
                  : compare(**surface, **other_surface, samples, order);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}' against '{}': {}", name, other_name, error.what()));
  }
  ordered_json out;
  out["name"] = name;
  out["kind"] = curve ? "curve" : "surface";
  out["against"] = other_name;
  out["samples"] = curve ? samples : samples * samples;
  out["maximum_distance"] = number_or_null(found.front().largest);
  double largest = 0;
  for (const Deviation& one : found) largest = std::max(largest, one.largest);
  if (tolerance) {
    out["tolerance"] = *tolerance;
    out["passed"] = largest <= *tolerance;
  }
  out["deviations"] = ordered_json::array();
  for (const Deviation& one : found) {
    ordered_json row;
    row["quantity"] = one.quantity;
    row["maximum"] = number_or_null(one.largest);
    row["relative"] = number_or_null(one.scale > 0 ? one.largest / one.scale : one.largest);
    if (curve) {
      row["t"] = one.at[0];
    } else {
      row["u"] = one.at[0];
      row["v"] = one.at[1];
    }
    row["first"] = to_json(one.first);
    row["second"] = to_json(one.second);
    out["deviations"].push_back(std::move(row));
  }
  return out;
}

void print_pair(const ordered_json& compared) {
  const bool judged = compared.contains("passed");
  fmt::print("{} '{}' against '{}': {} places{}\n", compared["kind"].get<std::string>(),
             compared["name"].get<std::string>(), compared["against"].get<std::string>(),
             compared["samples"].get<int>(),
             !judged                          ? ""
             : compared["passed"].get<bool>() ? ": passed"
                                              : fmt::format(": more than {:.6g}", compared["tolerance"].get<double>()));
  const auto number = [](const ordered_json& x) {
    return x.is_null() ? std::string("infinite") : fmt::format("{:.4g}", x.get<double>());
  };
  fmt::print("{:<10}{:<14}{:<12}{}\n", "", "largest", "relative", "at");
  for (const auto& row : compared["deviations"]) {
    const std::string place = row.contains("t")
                                  ? fmt::format("t {:.12g}", row["t"].get<double>())
                                  : fmt::format("u {:.12g}  v {:.12g}", row["u"].get<double>(), row["v"].get<double>());
    const bool same = row["maximum"] == 0.0;
    fmt::print("{:<10}{:<14}{:<12}{}\n", row["quantity"].get<std::string>(), number(row["maximum"]),
               number(row["relative"]), same ? "-" : place);
  }
}

}  // namespace lekalo::command
