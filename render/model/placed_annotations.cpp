#include "render/model/placed_annotations.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "geometry/transformed.h"
#include "render/model/objects.h"
#include "render/model/placed_objects.h"
#include "render/model/section_faces.h"
#include "render/scene/values/source.h"

namespace lekalo::render {

using namespace geometry;

namespace {

constexpr double kMaxVisited = 1000;  // placements of one shape that are looked at
constexpr double kSimilar = 1e-9;     // of the square of the scale

// Whether circles stay circles.
bool is_similarity(const Mat3& a) {
  const double square = glm::dot(a[0], a[0]);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k <= i; ++k)
      if (std::abs(glm::dot(a[i], a[k]) - (i == k ? square : 0)) > kSimilar * square) return false;
  return true;
}

std::any transformed_thing(const std::any& thing, const Affine& map) {
  if (const auto* curve = std::any_cast<CurvePtr>(&thing)) return transformed(*curve, map);
  if (const auto* surface = std::any_cast<SurfacePtr>(&thing)) return transformed(*surface, map);
  if (const auto* body = std::any_cast<BodyPtr>(&thing))
    return BodyPtr(std::make_shared<const Body>(transformed(**body, map)));
  return thing;
}

void place(Fields& values, const std::string& field, const Affine& map, bool is_normal) {
  const std::string spots = field + ".spots";
  if (values.holds<Anchor>(field)) {
    Anchor anchor = values.get<Anchor>(field);
    anchor.point = map.point(anchor.point);
    values.set(field, anchor);
    if (!values.has(spots)) return;
    std::vector<Vec3> points = values.get<std::vector<Vec3>>(spots);
    for (Vec3& point : points) point = map.point(point);
    values.set(spots, points);
  } else if (values.holds<Frame>(field)) {
    const Frame& frame = values.get<Frame>(field);
    const Vec3 z = is_normal ? map.normal(frame.z) : map.direction(frame.z);
    values.set(field, frame_from(map.point(frame.origin), z, map.direction(frame.x)));
  } else if (values.holds<Vec3>(field) && field != "along") {
    values.set(field, map.point(values.vec3(field)));
  } else if (values.holds<Vec3>(field)) {
    const Vec3 way = values.vec3(field);
    values.set(field, glm::normalize(is_normal ? map.normal(way) : map.direction(way)));
  } else if (values.holds<std::vector<std::any>>(field)) {
    std::vector<std::any> things = values.references(field);
    for (std::any& thing : things) thing = transformed_thing(thing, map);
    values.set(field, things);
  }
}

// Where an operand stands in a solid that is put together; none in what is not made of it.
std::optional<Affine> place_of_operand(const Shape& shape, const void* operand) {
  if (&shape == operand) return Affine();
  if (const auto* body = dynamic_cast<const BodyShape*>(&shape))
    return body->body().get() == operand ? std::optional(Affine()) : std::nullopt;
  if (const auto* moved = dynamic_cast<const TransformedShape*>(&shape)) {
    const auto inside = place_of_operand(*moved->original(), operand);
    return inside ? std::optional(moved->map() * *inside) : std::nullopt;
  }
  if (const auto* solid = dynamic_cast<const Csg*>(&shape))
    for (const ShapePtr& one : solid->operands())
      if (auto place = place_of_operand(*one, operand)) return place;
  return std::nullopt;
}
std::optional<Affine> place_of_operand(const Entity& entity, const void* operand) {
  const auto* shape = std::get_if<ShapePtr>(&entity);
  return shape ? place_of_operand(**shape, operand) : std::nullopt;
}

}  // namespace

Annotation placed(const Annotation& annotation, const std::vector<Object>& objects, std::vector<std::string>& notes) {
  Annotation result = annotation;
  const auto note = [&](const char* field, const char* why) {
    notes.push_back(fmt::format("{} where its '{}' is shown, but as it is written: {} ({})", annotation.type, field,
                                why, where(annotation.place)));
  };
  for (const char* field : {"at", "from", "to", "of", "along", "frame"}) {
    if (!annotation.values.holds<ShapeSpokenOf>(shape_field(field))) continue;
    const auto& spoken = annotation.values.get<ShapeSpokenOf>(shape_field(field));
    const PlacedObjects itself(
        objects, [&](const Object& object) { return identity(shape_as_written(object)) == spoken.shape; });
    const PlacedObjects solids(objects, [&](const Object& object) {
      return place_of_operand(shape_as_written(object), spoken.operand).has_value();
    });
    const bool in_solid = itself.count() == 0;
    const PlacedObjects& shown = in_solid ? solids : itself;
    if (shown.count() == 0 || shown.count() > kMaxVisited) continue;
    Affine to_world;
    bool as_written = false;
    shown.visit([&](const Object& object, const Affine& map, int) {
      to_world = in_solid ? map * *place_of_operand(shape_as_written(object), spoken.operand) : map;
      as_written = as_written || to_world.is_identity();
    });
    if (as_written) continue;
    if (shown.count() > 1)
      note(field, "several objects show it");
    else if (annotation.values.holds<std::vector<std::any>>(field) && !is_similarity(to_world.linear))
      note(field, "its object shows it out of round");
    else
      place(result.values, field, to_world, spoken.is_normal);
  }
  return result;
}

}  // namespace lekalo::render
