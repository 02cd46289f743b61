// A surface of every type that a scene file can name, made from the example of its declaration, so that no new type
// escapes the tests of all.
#pragma once

#include <string>
#include <vector>

#include "geometry/describe.h"
#include "render/scene/manual/manual.h"
#include "render/scene/scene_text.h"

namespace lekalo::render::every_surface {

using geometry::SurfacePtr;

// What examples refer to by name.
inline constexpr const char* kNamed = R"(
  my_curve: { type: bezier_curve, points: [[1, 0, 0], [2.5, 0, 1], [0, 0, 2], [1.5, 0, 3]] }
  round: { type: circle, radius: 1 }
)";

// Of a map as it is written in a scene, "{ type: plane, size: [2, 1] }".
inline SurfacePtr surface_of(const std::string& fields) {
  const BuiltText built = build_text("geometry:\n  s: " + fields + kNamed);
  const auto found = built.model.geometry.find("s");
  if (found == built.model.geometry.end()) throw std::invalid_argument(fields + "\n" + built.said);
  return std::get<SurfacePtr>(found->second);
}

// All types of surfaces but those that are code or data from outside.
inline std::vector<geometry::TypeDeclaration> surface_types() {
  std::vector<geometry::TypeDeclaration> types;
  for (const geometry::TypeDeclaration& type : geometry::geometry_types())
    if (type.category == geometry::Category::surface && !type.runs_foreign_code) types.push_back(type);
  return types;
}

inline std::vector<std::string> surface_type_names() {
  std::vector<std::string> names;
  for (const geometry::TypeDeclaration& type : surface_types()) names.push_back(type.name);
  return names;
}

inline SurfacePtr example_surface(const std::string& name) {
  for (const geometry::TypeDeclaration& type : surface_types())
    if (type.name == name) return surface_of(example_of(type));
  throw std::invalid_argument(name);
}

// The same, and less of it where it is long: what asks each patch for every line takes long then.
inline SurfacePtr short_example(const std::string& name) {
  if (name == "thread_surface") return surface_of("{ type: thread_surface, diameter: 10, length: 1.5 }");
  if (name == "vintoid") return surface_of("{ type: vintoid, preset: toroid }");
  if (name == "serpentine") return surface_of("{ type: serpentine, preset: coil, n: 1 }");
  return example_surface(name);
}

}  // namespace lekalo::render::every_surface
