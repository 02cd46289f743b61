// Parts of a POV-Ray scene, for pov_export.cpp, pov_shapes.cpp and pov_materials.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/shape.h"
#include "render/pov/pov_export.h"

namespace lekalo::render {

// Notes without repetition, in the order of their first use.
class PovNotes {
 public:
  void add(const std::string& note);
  std::vector<std::string> take() { return std::move(notes_); }

 private:
  std::vector<std::string> notes_;
};

// <x, y, z>; the shortest digits that give the same double.
std::string pov(const Vec3& v);
// The first three lanes as `rgb <r, g, b>`; the shortest digits that give the same float.
std::string pov_rgb(const Spectrum& s);
// `matrix <...>` with a space before it; nothing for the identity.
std::string pov(const geometry::Affine& map);
// The map from a frame's local coordinates, stretched, to the frame's place.
geometry::Affine pov_frame(const geometry::Frame& frame, const Vec3& stretch = Vec3(1));
// Half-space dot(p - through, normal) <= 0.
std::string pov_plane(const Vec3& normal, const Vec3& through);

// A shape without its closing brace, so that material, transform and flags can be added.
struct PovShape {
  std::string text;
  // Of planes: where u and v of a texture run.
  std::optional<geometry::Frame> parameters;
};

PovShape pov_shape(const geometry::SurfacePtr& surface, const std::string& name, const PovOptions& options,
                   PovNotes& notes);
PovShape pov_shape(const geometry::Body& body, const std::string& name, const PovOptions& options, PovNotes& notes);
PovShape pov_shape(const geometry::Mesh& mesh);
// Nothing for a shape that POV-Ray does not have as exactly.
std::optional<PovShape> pov_shape(const geometry::ShapePtr& shape, const std::string& name, const PovOptions& options,
                                  PovNotes& notes);

// ` material { ... }` of an object; `parameters` as in PovShape.
std::string pov_material(const Material& material, const std::string& name,
                         const std::optional<geometry::Frame>& parameters, PovNotes& notes);

}  // namespace lekalo::render
