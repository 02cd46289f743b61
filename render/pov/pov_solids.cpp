// Closed shapes as POV-Ray's own constructive solid geometry. A union is written as `merge`, which has no walls inside
// either.
#include <fmt/format.h>

#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "geometry/shapes/csg/half_space.h"
#include "render/pov/pov_parts.h"

namespace lekalo::render {

using namespace geometry;

std::optional<PovShape> pov_shape(const ShapePtr& shape, const std::string& name, const PovOptions& options,
                                  PovNotes& notes) {
  if (const auto* moved = dynamic_cast<const TransformedShape*>(shape.get())) {
    std::optional<PovShape> original = pov_shape(moved->original(), name, options, notes);
    if (original) original->text += pov(moved->map());
    return original;
  }
  if (const auto* solid = dynamic_cast<const BodyShape*>(shape.get())) {
    PovShape body = pov_shape(*solid->body(), name, options, notes);
    if (body.text.starts_with("mesh2")) {
      // POV-Ray asks which way to look for the border of a mesh.
      body.text += "\n  inside_vector <0.3, 0.5, 0.8>";
    }
    return body;
  }
  if (const auto* half = dynamic_cast<const HalfSpaceShape*>(shape.get())) {
    std::string text = pov_plane(half->frame().z, half->frame().origin);
    text.erase(text.rfind(" }"));  // a whole plane object; its brace opens again for the attributes
    return PovShape{text, {}};
  }
  const auto* csg = dynamic_cast<const Csg*>(shape.get());
  if (!csg) return std::nullopt;
  std::string text = csg->operation() == Csg::Operation::unite       ? "merge {"
                     : csg->operation() == Csg::Operation::intersect ? "intersection {"
                                                                     : "difference {";
  for (const ShapePtr& operand : csg->operands()) {
    const std::optional<PovShape> written = pov_shape(operand, name, options, notes);
    if (!written) return std::nullopt;
    text += fmt::format("\n{} }}", written->text);
  }
  return PovShape{text, {}};
}

}  // namespace lekalo::render
