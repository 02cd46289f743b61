// Axes, frames, lists and nets of points, transforms.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/transformed.h"
#include "render/scene/build/builder.h"
#include "render/scene/values/scalars.h"
#include "render/scene/values/words.h"
#include "render/scene/yaml/table.h"

namespace lekalo::render {

using geometry::Grid;

// `axis: z` is the line through the origin; in full { through, along }.
std::optional<Axis> Builder::read_axis(const Value& value, const Counters& counters) {
  Axis axis;
  const bool full = value.is_map() && (value.find("through") || value.find("along"));
  if (full) {
    for (const Entry& entry : value.entries)
      if (entry.key.name != "through" && entry.key.name != "along") {
        diagnostics_.error(entry.key.place, fmt::format("unknown field '{}' of an axis", entry.key.name),
                           "{ through: point, along: direction }");
        return std::nullopt;
      }
    if (const Value* through = value.find("through")) {
      const auto point = read_point(*through, counters);
      if (!point) return std::nullopt;
      axis.through = *point;
    }
  }
  const Value* along = full ? value.find("along") : &value;
  if (!along) return axis;
  const auto direction = read_vector(*along, counters, true);
  if (!direction) return std::nullopt;
  axis.along = *direction;
  return axis;
}

std::optional<Frame> Builder::read_frame(const Value& value, const Counters& counters) {
  if (!value.is_map()) {
    diagnostics_.error(value.place, fmt::format("expected a frame, found {}", kind_name(value)),
                       "write { origin: [0, 0, 0], z: z, x: x }");
    return std::nullopt;
  }
  Vec3 origin(0), z(0, 0, 1);
  std::optional<Vec3> x;
  for (const Entry& entry : value.entries) {
    if (entry.key.name == "origin") {
      const auto point = read_point(entry.value, counters);
      if (!point) return std::nullopt;
      origin = *point;
    } else if (entry.key.name == "z" || entry.key.name == "x") {
      const auto direction = read_vector(entry.value, counters, true);
      if (!direction) return std::nullopt;
      if (entry.key.name == "z")
        z = *direction;
      else
        x = *direction;
    } else {
      diagnostics_.error(entry.key.place, fmt::format("unknown field '{}' of a frame", entry.key.name),
                         "a frame has origin, z and x");
      return std::nullopt;
    }
  }
  try {
    return x ? geometry::frame_from(origin, z, *x) : geometry::frame_about(origin, z);
  } catch (const std::invalid_argument& error) {
    diagnostics_.error(value.place, error.what());
    return std::nullopt;
  }
}

// `center` and `normal` (or `axis`) are the short form of `frame`.
std::optional<Frame> Builder::read_short_frame(const Value& map, const Value* frame, const Counters& counters) {
  const Value* center = map.find("center");
  const Value* normal = map.find("normal");
  const Value* axis = map.find("axis");
  if (frame) {
    for (const Value* other : {center, normal, axis})
      if (other) {
        diagnostics_.error(other->place, "a placement is given by 'frame' or by 'center' and 'normal', not by both");
        return std::nullopt;
      }
    return read_frame(*frame, counters);
  }
  Axis placement;
  if (axis) {
    if (normal) {
      diagnostics_.error(normal->place, "'axis' and 'normal' say the same: leave one out");
      return std::nullopt;
    }
    const auto read = read_axis(*axis, counters);
    if (!read) return std::nullopt;
    placement = *read;
  }
  if (center) {
    const auto point = read_point(*center, counters);
    if (!point) return std::nullopt;
    placement.through = *point;
  }
  if (normal) {
    const auto direction = read_vector(*normal, counters, true);
    if (!direction) return std::nullopt;
    placement.along = *direction;
  }
  return geometry::frame_about(placement.through, placement.along);
}

std::optional<std::vector<Vec3>> Builder::read_points(const FieldType& type, const Value& value,
                                                      const Counters& counters) {
  std::vector<Vec3> points;
  if (value.is_map() && value.find("file")) {
    const auto path = read(geometry::file(), *value.find("file"), counters);
    if (!path) return std::nullopt;
    const auto table = read_table(std::any_cast<std::string>(*path), value.place, diagnostics_);
    if (!table) return std::nullopt;
    if (table->column_count != 2 && table->column_count != 3) {
      diagnostics_.error(table->place(0), fmt::format("points have 2 or 3 columns, found {}", table->column_count));
      return std::nullopt;
    }
    for (size_t row = 0; row < table->row_count(); ++row)
      points.push_back({table->at(row, 0), table->at(row, 1), table->column_count == 3 ? table->at(row, 2) : 0});
  } else if (!value.is_sequence()) {
    diagnostics_.error(value.place, fmt::format("expected a list of points, found {}", kind_name(value)),
                       "write [[0, 0, 0], [1, 0, 0], ...]");
    return std::nullopt;
  } else {
    bool good = true;
    for (const Scoped& item : items(value, counters)) {
      const auto point = read_point(*item.value, item.counters);
      if (point)
        points.push_back(*point);
      else
        good = false;
    }
    if (!good) return std::nullopt;
  }
  if (!check_count(type, value, points.size())) return std::nullopt;
  return points;
}

// points[i][j]: rows run with u.
std::optional<Grid<Vec3>> Builder::read_net(const FieldType&, const Value& value, const Counters& counters) {
  Grid<Vec3> net;
  const auto add_row = [&](const std::vector<Vec3>& row, const Place& place) {
    if (net.rows > 0 && static_cast<int>(row.size()) != net.columns) {
      diagnostics_.error(place, fmt::format("this row has {} points, the rows before it {}", row.size(), net.columns));
      return false;
    }
    net.columns = static_cast<int>(row.size());
    net.values.insert(net.values.end(), row.begin(), row.end());
    ++net.rows;
    return true;
  };
  if (value.is_map() && value.find("file")) {
    const auto path = read(geometry::file(), *value.find("file"), counters);
    if (!path) return std::nullopt;
    const auto table = read_table(std::any_cast<std::string>(*path), value.place, diagnostics_);
    if (!table) return std::nullopt;
    if (table->column_count != 3) {
      diagnostics_.error(table->place(0), fmt::format("a net's points have 3 columns, found {}", table->column_count));
      return std::nullopt;
    }
    for (size_t block = 0; block < table->blocks.size(); ++block) {
      const size_t end = block + 1 < table->blocks.size() ? table->blocks[block + 1] : table->row_count();
      std::vector<Vec3> row;
      for (size_t k = table->blocks[block]; k < end; ++k)
        row.push_back({table->at(k, 0), table->at(k, 1), table->at(k, 2)});
      if (!add_row(row, table->place(table->blocks[block]))) return std::nullopt;
    }
    return net;
  }
  if (!value.is_sequence()) {
    diagnostics_.error(value.place, fmt::format("expected rows of points, found {}", kind_name(value)),
                       "write a list of rows; each row is a list of points");
    return std::nullopt;
  }
  for (const Scoped& item : items(value, counters)) {
    const Value& row = row_of(*item.value);
    const auto points = read_points(geometry::points().count(1), row, item.counters);
    if (!points || !add_row(*points, row.place)) return std::nullopt;
  }
  return net;
}

std::optional<Affine> Builder::read_transform(const Value& value, const Counters& counters) {
  Affine all;
  for (const Scoped& step : items(value, counters)) {
    const auto one = read_transform_step(*step.value, step.counters);
    if (!one) return std::nullopt;
    all = *one * all;
  }
  return all;
}

std::optional<Affine> Builder::read_transform_step(const Value& step, const Counters& counters) {
  static const std::vector<std::string> kinds = {"translate", "rotate", "scale", "mirror", "matrix", "pose"};
  if (!step.is_map()) {
    diagnostics_.error(step.place, fmt::format("expected a step of a transform, found {}", kind_name(step)),
                       "for example { rotate: 30, axis: z } or { translate: [1, 0, 0] }");
    return std::nullopt;
  }
  const Entry* kind = nullptr;
  for (const Entry& entry : step.entries) {
    const std::string& name = entry.key.name;
    if (std::find(kinds.begin(), kinds.end(), name) != kinds.end()) {
      if (kind) {
        diagnostics_.error(entry.key.place, "one step does one thing",
                           "write a list of steps: [{ rotate: ... }, { translate: ... }]");
        return std::nullopt;
      }
      kind = &entry;
    } else if (name != "axis" && name != "about" && name != "repeat") {
      diagnostics_.error(entry.key.place,
                         fmt::format("unknown step '{}' of a transform{}", name, suggestion(name, kinds)),
                         "translate, rotate (with axis), scale, mirror, matrix or pose; about: the point that stays");
      return std::nullopt;
    }
  }
  if (!kind) {
    diagnostics_.error(step.place, "a step of a transform says translate, rotate, scale, mirror or matrix");
    return std::nullopt;
  }
  const std::string& name = kind->key.name;
  const Value* axis = step.find("axis");
  if (axis && name != "rotate") {
    diagnostics_.error(axis->place, fmt::format("'axis' goes with 'rotate', not with '{}'", name));
    return std::nullopt;
  }
  Vec3 about(0);
  if (const Value* value = step.find("about")) {
    const auto point = read_point(*value, counters);
    if (!point) return std::nullopt;
    about = *point;
  }
  if (name == "pose") {
    const auto* poses = constraints_ ? &constraints_->poses : nullptr;
    if (const auto found = poses ? poses->find(kind->value.text) : decltype(poses->find(""))();
        poses && found != poses->end())
      return found->second;
    diagnostics_.error(kind->value.place, fmt::format("the constraints have no body '{}'", kind->value.text),
                       "a name of 'constraints: bodies'");
    return std::nullopt;
  }
  if (name == "translate") {
    const auto by = read_vector(kind->value, counters, false);
    return by ? std::optional(Affine::translation(*by)) : std::nullopt;
  }
  if (name == "rotate") {
    const auto angle = parameters_.angle(kind->value, counters);
    Axis line;
    if (axis) {
      const auto read = read_axis(*axis, counters);
      if (!read) return std::nullopt;
      line = *read;
    }
    if (!angle) return std::nullopt;
    return Affine::rotation(*angle, line.along, step.find("about") ? about : line.through);
  }
  if (name == "mirror") {
    const auto normal = read_vector(kind->value, counters, true);
    return normal ? std::optional(Affine::mirror(*normal, about)) : std::nullopt;
  }
  if (name == "scale") {
    Vec3 factors;
    if (kind->value.is_sequence()) {
      const auto three = read_numbers(geometry::numbers().count(3, 3), kind->value, counters);
      if (!three) return std::nullopt;
      factors = {(*three)[0], (*three)[1], (*three)[2]};
    } else {
      const auto one = parameters_.number(kind->value, counters);
      if (!one) return std::nullopt;
      factors = Vec3(*one);
    }
    if (factors.x == 0 || factors.y == 0 || factors.z == 0) {
      diagnostics_.error(kind->value.place, "a scale factor of 0 flattens everything");
      return std::nullopt;
    }
    return Affine::scaling(factors, about);
  }
  const auto rows = read_number_grid(geometry::number_grid(), kind->value, counters);
  if (!rows) return std::nullopt;
  if ((rows->rows != 3 && rows->rows != 4) || rows->columns != 4 ||
      (rows->rows == 4 && (rows->at(3, 0) != 0 || rows->at(3, 1) != 0 || rows->at(3, 2) != 0 || rows->at(3, 3) != 1))) {
    diagnostics_.error(kind->value.place, "expected a matrix of 3 rows of 4 numbers (a fourth row must be 0 0 0 1)");
    return std::nullopt;
  }
  Affine map;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) map.linear[j][i] = rows->at(i, j);
    map.offset[i] = rows->at(i, 3);
  }
  if (!(std::abs(map.determinant()) > 0)) {
    diagnostics_.error(kind->value.place, "this matrix flattens everything: its determinant is 0");
    return std::nullopt;
  }
  return map;
}

}  // namespace lekalo::render
