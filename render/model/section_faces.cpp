#include "render/model/section_faces.h"

#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "render/model/face_materials.h"

namespace lekalo::render {

using geometry::BodyPtr;
using geometry::BodyShape;
using geometry::Csg;
using geometry::ShapePtr;

namespace {

// What is left of an object that a section cut: its solid less the rest. Null: no section cut it.
const Csg* left_by_section(const Object& object) {
  const auto* shape = object.first_cut_leaf >= 0 ? std::get_if<ShapePtr>(&object.shape) : nullptr;
  return shape ? dynamic_cast<const Csg*>(shape->get()) : nullptr;
}

}  // namespace

Entity before_section(const Object& object) {
  const Csg* left = left_by_section(object);
  if (!left) return object.shape;
  const ShapePtr& solid = left->operands().front();
  const auto* body = dynamic_cast<const BodyShape*>(solid.get());
  return body ? Entity(body->body()) : Entity(solid);
}

int face_before_section(const Object& object, int face) {
  const Csg* left = left_by_section(object);
  if (!left) return face;
  const int count = left->leaf_count();
  return face % count >= object.first_cut_leaf ? -1 : face / count;
}

void renumber_face_materials(Object& object) {
  const FaceMaterials* faced = face_materials(object);
  const Csg* left = left_by_section(object);
  if (!faced || !left) return;
  // A crossing carries its leaf, of which the body is the first, and the leaf's face (csg.h).
  std::map<int, MaterialPtr> faces;
  for (const auto& [face, material] : faced->faces()) faces[face * left->leaf_count()] = material;
  object.material = std::make_shared<FaceMaterials>(faced->body(), std::move(faces));
}

Entity shape_as_written(const Object& object) {
  return object.as_written ? *object.as_written : before_section(object);
}

void put_before_section(Object& object, const BodyPtr& body) {
  object.as_written = shape_as_written(object);
  const Csg* left = left_by_section(object);
  if (!left) {
    object.shape = body;
    return;
  }
  std::vector<ShapePtr> operands = left->operands();
  operands.front() = std::make_shared<BodyShape>(body);
  object.first_cut_leaf = 1;
  object.shape = ShapePtr(std::make_shared<Csg>(Csg::Operation::subtract, operands));
}

}  // namespace lekalo::render
