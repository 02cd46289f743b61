// Where a point lies: by a surface, in a region of the parameter plane, in a body or shape.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "command.h"
#include "geometry/queries/closest/position.h"
#include "geometry/queries/measures/curve_features.h"
#include "measure.h"

namespace lekalo::command {

namespace {

using geometry::Containment;
using geometry::Vec3;

const char* word(geometry::SurfacePosition::Side side) {
  using Side = geometry::SurfacePosition::Side;
  return side == Side::above ? "above" : side == Side::below ? "below" : side == Side::on ? "on" : "beside";
}
const char* word(Containment where) {
  return where == Containment::inside ? "inside" : where == Containment::outside ? "outside" : "on";
}

ordered_json row_of(const geometry::SurfacePosition& found) {
  return {{"position", word(found.side)},
          {"distance", found.distance},
          {"height", found.height},
          {"nearest", place_row(found.nearest)}};
}
ordered_json row_of(const geometry::BodyPosition& found) {
  return {{"position", word(found.where)},
          {"distance", found.distance},
          {"nearest", place_row(found.nearest)},
          {"by_lines", found.by_lines}};
}
ordered_json row_of(const geometry::RegionPosition& found) {
  ordered_json row{{"position", word(found.where)}, {"distance", nullptr}};
  if (!std::isfinite(found.distance)) return row;
  row["distance"] = found.distance;
  row["loop"] = found.loop;
  row["curve"] = found.curve;
  row["t"] = found.t;
  row["nearest"] = {{"u", found.nearest.x}, {"v", found.nearest.y}};
  return row;
}

ordered_json position_in_plane(const std::string& name, const render::Entity& entity, const geometry::Vec2& at) {
  const auto* body = std::get_if<geometry::BodyPtr>(&entity);
  if (!body || (*body)->faces.size() != 1)
    throw UsageError(fmt::format("'{}' is no body of one face: U,V has a place in the region of one", name));
  ordered_json out{{"kind", "face"}};
  out.update(row_of(position(at, **body, 0)));
  return out;
}

ordered_json position_in_space(const std::string& name, const render::Entity& entity, const Vec3& point) {
  ordered_json out;
  if (const auto* surface = std::get_if<geometry::SurfacePtr>(&entity)) {
    out["kind"] = "surface";
    out.update(row_of(position(point, **surface)));
  } else if (const auto* body = std::get_if<geometry::BodyPtr>(&entity)) {
    out["kind"] = "body";
    out.update(row_of(position(point, **body)));
  } else if (const auto* curve = std::get_if<geometry::CurvePtr>(&entity)) {
    const int winding = geometry::winding_number(**curve, point);
    out["kind"] = "curve";
    out["position"] = winding != 0 ? "inside" : "outside";
    out["winding_number"] = winding;
  } else if (const auto* shape = std::get_if<geometry::ShapePtr>(&entity)) {
    out["kind"] = "shape";
    out["position"] = is_inside(point, **shape) ? "inside" : "outside";
  } else {
    throw UsageError(fmt::format("'{}' is no curve, surface, body or shape: a point has no position by it", name));
  }
  return out;
}

}  // namespace

ordered_json position_of(const std::string& name, const render::Entity& entity, const std::string& of,
                         const std::vector<double>& place) {
  ordered_json out{{"name", name}};
  try {
    const ordered_json found = place.size() == 2 ? position_in_plane(name, entity, {place[0], place[1]})
                                                 : position_in_space(name, entity, {place[0], place[1], place[2]});
    out["kind"] = found["kind"];
    out["of"] = of;
    out.update(found);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}': {}", name, error.what()));
  }
  return out;
}

void print_position(const ordered_json& found) {
  fmt::print("{} is {} {} '{}'", found["of"].get<std::string>(), found["position"].get<std::string>(),
             found["kind"].get<std::string>(), found["name"].get<std::string>());
  if (found.contains("winding_number"))
    fmt::print(", which goes round it {} times", found["winding_number"].get<int>());
  if (!found.contains("distance") || found["distance"].is_null()) return fmt::print("\n");
  fmt::print(": distance {}\n", digits(found["distance"].get<double>()));
  const ordered_json& nearest = found["nearest"];
  if (nearest.contains("point"))
    fmt::print("  nearest  {}\n", place_text(nearest));
  else
    fmt::print("  nearest  loop {}  curve {}  t {}  u {}  v {}\n", found["loop"].get<int>(), found["curve"].get<int>(),
               digits(found["t"].get<double>()), digits(nearest["u"].get<double>()),
               digits(nearest["v"].get<double>()));
}

}  // namespace lekalo::command
