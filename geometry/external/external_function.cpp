#include "geometry/external/external_function.h"

#include <fmt/format.h>

#include <cmath>

namespace lekalo::geometry {

namespace {

// All answers, `each` vectors a place.
std::vector<Vec3> answers(const ExternalFunction& function, std::span<const double> places, size_t parameters,
                          int order, size_t each) {
  const size_t count = places.size() / parameters;
  std::vector<double> values(count * each * 3);
  function.evaluate(places, order, values);
  std::vector<Vec3> result(count * each);
  for (size_t i = 0; i < result.size(); ++i) {
    const Vec3 value(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    if (!std::isfinite(value.x) || !std::isfinite(value.y) || !std::isfinite(value.z))
      throw ExternalError(fmt::format("{} is ({}, {}, {}) at {}", quantity_text(parameters, i % each), value.x, value.y,
                                      value.z, place_text(places.subspan(i / each * parameters, parameters))));
    result[i] = value;
  }
  return result;
}

}  // namespace

std::vector<CurveJet> curve_jets(const ExternalFunction& function, std::span<const double> t, int order) {
  const size_t each = static_cast<size_t>(order) + 1;
  const std::vector<Vec3> values = answers(function, t, 1, order, each);
  std::vector<CurveJet> jets(t.size());
  for (size_t i = 0; i < jets.size(); ++i) {
    jets[i].order = order;
    for (size_t k = 0; k < each; ++k) jets[i].d[k] = values[i * each + k];
  }
  return jets;
}

std::vector<SurfaceJet> surface_jets(const ExternalFunction& function, std::span<const Vec2> uv, int order) {
  std::vector<double> places;
  places.reserve(2 * uv.size());
  for (const Vec2& place : uv) places.insert(places.end(), {place.x, place.y});
  const size_t each = static_cast<size_t>(order + 1) * (order + 2) / 2;
  const std::vector<Vec3> values = answers(function, places, 2, order, each);
  std::vector<SurfaceJet> jets(uv.size(), SurfaceJet(order));
  for (size_t i = 0; i < jets.size(); ++i)
    for (size_t k = 0; k < each; ++k) jets[i].values[k] = values[i * each + k];
  return jets;
}

std::string place_text(std::span<const double> place) {
  return place.size() == 1 ? fmt::format("t = {:.12g}", place[0])
                           : fmt::format("u = {:.12g}, v = {:.12g}", place[0], place[1]);
}

std::string quantity_text(size_t parameters, size_t index) {
  if (index == 0) return "the point";
  if (parameters == 1) return fmt::format("derivative {}", index);
  size_t order = 1;
  while ((order + 1) * (order + 2) / 2 <= index) ++order;
  const size_t by_v = index - order * (order + 1) / 2;
  return "the derivative d" + std::string(order - by_v, 'u') + std::string(by_v, 'v');
}

}  // namespace lekalo::geometry
