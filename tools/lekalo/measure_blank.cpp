// The smallest box along an axis about a curve, a surface or a body.
#include <fmt/format.h>

#include "command.h"
#include "geometry/bodies/topology/blank_box.h"
#include "measure.h"
#include "parameters.h"

namespace lekalo::command {

ordered_json blank_of(const std::string& name, const render::Entity& entity, const std::string& axis) {
  const std::vector<double> d = parse_numbers(axis, 3, "--blank");
  const geometry::Vec3 along(d[0], d[1], d[2]);
  if (!(glm::length(along) > 0)) throw UsageError("--blank 0,0,0 is no direction");
  geometry::Distant of;
  if (const auto* curve = std::get_if<geometry::CurvePtr>(&entity))
    of = curve->get();
  else if (const auto* surface = std::get_if<geometry::SurfacePtr>(&entity))
    of = surface->get();
  else if (const auto* body = std::get_if<geometry::BodyPtr>(&entity))
    of = body->get();
  else
    throw UsageError(fmt::format("'{}' is no curve, surface or body", name));
  try {
    const geometry::BlankBox box = geometry::blank_box(of, render::bounds(entity), glm::normalize(along));
    ordered_json out{{"name", name}};
    out["size"] = to_json(box.size);
    out["volume"] = box.volume();
    out["angle"] = box.angle * 180 / geometry::kPi;
    out["corner"] = to_json(box.frame.origin);
    out["x"] = to_json(box.frame.x), out["y"] = to_json(box.frame.y), out["z"] = to_json(box.frame.z);
    return out;
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("'{}': {}", name, error.what()));
  }
}

void print_blank(const ordered_json& found) {
  const auto three = [&](const char* key) {
    return fmt::format("{} {} {}", digits(found[key][0].get<double>()), digits(found[key][1].get<double>()),
                       digits(found[key][2].get<double>()));
  };
  fmt::print("the smallest box about '{}' along the axis\n", found["name"].get<std::string>());
  for (const char* key : {"size", "corner", "x", "y", "z"}) fmt::print("{:<8} {}\n", key, three(key));
  fmt::print("{:<8} {}\n{:<8} {} degrees\n", "volume", digits(found["volume"].get<double>()), "angle",
             digits(found["angle"].get<double>()));
}

}  // namespace lekalo::command
