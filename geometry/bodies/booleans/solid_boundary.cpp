#include "geometry/bodies/booleans/solid_boundary.h"

#include <algorithm>
#include <stdexcept>

#include "geometry/bodies/booleans/boolean.h"
#include "geometry/bodies/primitives/primitives.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "geometry/shapes/csg/half_space.h"

namespace lekalo::geometry {

namespace {

BodyPtr made(const Csg& solid);

BodyPtr body_of(const ShapePtr& shape, const Affine& map, const Box3& within) {
  if (const auto* body = dynamic_cast<const BodyShape*>(shape.get()))
    return std::make_shared<Body>(transformed(*body->body(), map));
  if (const auto* moved = dynamic_cast<const TransformedShape*>(shape.get()))
    return body_of(moved->original(), map * moved->map(), within);
  if (const auto* solid = dynamic_cast<const Csg*>(shape.get()))
    return std::make_shared<Body>(transformed(*solid->boundary(made), map));
  if (const auto* half = dynamic_cast<const HalfSpaceShape*>(shape.get())) {
    if (!within.bounded() || within.empty())
      throw std::invalid_argument("a half-space without anything bounded beside it has no boundary");
    Body block = block_behind(map.point(half->frame().origin), map.normal(half->frame().z), within);
    for (Face& face : block.faces) face.origin = {"", "plane"};
    return std::make_shared<Body>(std::move(block));
  }
  throw std::invalid_argument("one of its parts is met by rays only and has no faces");
}

// The operand's name goes before the names that its faces have.
void name_faces(Body& body, const std::string& name) {
  const auto prefix = [&](Origin& origin) {
    if (origin.feature == name || origin.feature.starts_with(name + ".")) return;  // it has it already
    origin.feature = origin.feature.empty() ? name : name + "." + origin.feature;
  };
  for (Face& face : body.faces) prefix(face.origin);
}

// What half-spaces among the operands have to reach around.
Box3 extent_of(const Csg& solid) {
  Box3 all;
  for (const ShapePtr& operand : solid.operands())
    if (const Box3 box = operand->bounds(); box.bounded()) all.include(box);
  return all.empty() ? solid.bounds() : all;
}

BodyPtr made(const Csg& solid) {
  const Box3 all = extent_of(solid);
  if (solid.operation() == Csg::Operation::unite && !solid.bounds().bounded())
    throw std::invalid_argument("it is unbounded");
  Body result;
  for (size_t k = 0; k < solid.operands().size(); ++k) {
    Body operand = *body_of(solid.operands()[k], Affine(), all);
    if (k < solid.names().size()) name_faces(operand, solid.names()[k]);
    if (k == 0) {
      result = std::move(operand);
      continue;
    }
    const BooleanOperation operation = solid.operation() == Csg::Operation::unite       ? BooleanOperation::unite
                                       : solid.operation() == Csg::Operation::intersect ? BooleanOperation::intersect
                                                                                        : BooleanOperation::subtract;
    result = boolean(operation, result, operand);
  }
  return std::make_shared<Body>(std::move(result));
}

}  // namespace

Body block_behind(const Vec3& through, const Vec3& normal, const Box3& box) {
  Frame frame = frame_about(through, glm::normalize(normal));
  const double reach = 1.618 * std::max(box.diameter(), glm::length(box.center() - through));
  const Vec3 center = frame.to_local_point(box.center());
  const double depth = reach + 2 * std::abs(center.z);
  frame.origin = frame.point({center.x - reach, center.y - reach, -depth});
  return geometry::box(frame, {2 * reach, 2 * reach, depth});
}

bool has_boundary(const Shape& shape) {
  if (dynamic_cast<const BodyShape*>(&shape) || dynamic_cast<const HalfSpaceShape*>(&shape)) return true;
  if (const auto* moved = dynamic_cast<const TransformedShape*>(&shape)) return has_boundary(*moved->original());
  const auto* solid = dynamic_cast<const Csg*>(&shape);
  return solid && solid->bounds().bounded() &&
         std::all_of(solid->operands().begin(), solid->operands().end(),
                     [](const ShapePtr& operand) { return has_boundary(*operand); });
}

BodyPtr boundary_of(const ShapePtr& shape) { return body_of(shape, Affine(), shape->bounds()); }

std::vector<BodyPtr> operands_of(const ShapePtr& shape) {
  Affine map;
  const Shape* inner = shape.get();
  while (const auto* moved = dynamic_cast<const TransformedShape*>(inner)) {
    map = map * moved->map();
    inner = moved->original().get();
  }
  std::vector<BodyPtr> bodies;
  if (const auto* solid = dynamic_cast<const Csg*>(inner))
    for (const ShapePtr& operand : solid->operands())
      bodies.push_back(std::make_shared<Body>(transformed(*body_of(operand, Affine(), extent_of(*solid)), map)));
  return bodies;
}

bool makes_boundary(std::string_view type) { return type == "union" || type == "intersection" || type == "difference"; }

}  // namespace lekalo::geometry
