// JSON as the commands print it: numbers with all digits, keys in the order of docs/reference-json.md.
#pragma once

#include <nlohmann/json.hpp>

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

}  // namespace lekalo::command
