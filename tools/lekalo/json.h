// JSON as the commands print it: numbers with all digits, keys in the order of docs/reference-json.md. What is infinite
// or has no value is null, and an error where it is none of these by design.
#pragma once

#include <nlohmann/json.hpp>

#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/vectors.h"

namespace lekalo::command {

using nlohmann::ordered_json;

inline ordered_json to_json(const geometry::Vec3& v) { return ordered_json::array({v.x, v.y, v.z}); }

// Row by row.
inline ordered_json to_json(const geometry::Mat3& m) {
  ordered_json rows = ordered_json::array();
  for (int i = 0; i < 3; ++i) rows.push_back({m[0][i], m[1][i], m[2][i]});
  return rows;
}

// Null where a coordinate is not finite.
inline ordered_json finite_or_null(const geometry::Vec3& v) {
  return std::isfinite(v.x + v.y + v.z) ? to_json(v) : ordered_json(nullptr);
}
inline ordered_json finite_or_null(double x) { return std::isfinite(x) ? ordered_json(x) : ordered_json(nullptr); }

// The last guard of what is printed: throws std::invalid_argument for a number that is none. `name`: its key.
inline void demand_finite(const ordered_json& value, const std::string& name = "the result") {
  if (value.is_number_float() && !std::isfinite(value.get<double>()))
    throw std::invalid_argument("'" + name + "' is infinite or has no value here");
  if (value.is_array())
    for (const ordered_json& item : value) demand_finite(item, name);
  if (value.is_object())
    for (const auto& [key, item] : value.items()) demand_finite(item, key);
}

}  // namespace lekalo::command
