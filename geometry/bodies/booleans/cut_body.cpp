// Bodies cut by sheets and planes, turned inside out, and made symmetric (Golovanov 2016, 6.2, 6.4, 6.5).
//
// A sheet stands for the half of space on its inner side, which its normals look away from; the part of it inside the
// body becomes faces. A symmetric body is the half that the plane's normal looks into, united with its mirror image.
#include <fmt/format.h>

#include "geometry/bodies/booleans/boolean.h"
#include "geometry/bodies/booleans/solid_boundary.h"
#include "geometry/bodies/topology/sew.h"
#include "geometry/describe.h"
#include "geometry/surfaces/analytic/plane.h"

namespace lekalo::geometry {

namespace {

const Body& closed_body(const Fields& f, const char* field) {
  const Body& body = *f.body(field);
  if (!body.is_closed()) throw FieldError(field, "this body is not closed: it has no inside");
  return body;
}

template <class Work>
BodyPtr worked(const char* field, const char* hint, Work&& work) {
  try {
    return std::make_shared<Body>(work());
  } catch (const FieldError&) {
    throw;
  } catch (const BooleanError& error) {
    throw FieldError(field, error.what(), error.empty ? "move it, so that a part of the body stays" : hint);
  } catch (const std::invalid_argument& error) {
    throw FieldError(field, error.what());
  }
}

Body cut_by_plane(const Body& body, const Vec3& through, const Vec3& normal, bool keep_inner) {
  Body block = block_behind(through, normal, bounds(body));
  for (Face& face : block.faces) face.origin = {"", "cut"};
  return boolean(keep_inner ? BooleanOperation::intersect : BooleanOperation::subtract, body, block);
}

Body cut_by(const Fields& f) {
  const Body& body = closed_body(f, "of");
  const bool inner = f.text("keep") == "inner";
  if (f.holds<BodyPtr>("by")) return cut(body, *f.body("by"), inner);
  const SurfacePtr surface = f.surface("by");
  const auto* plane = dynamic_cast<const Plane*>(surface.get());
  if (plane && !plane->bounded()) return cut_by_plane(body, plane->frame().origin, plane->normal(0, 0), inner);
  Body sheet = sew(std::array{surface});
  for (Face& face : sheet.faces) face.origin = {"", "cut"};
  return cut(body, sheet, inner);
}

Body symmetric(const Fields& f) {
  const Body& body = closed_body(f, "of");
  const Vec3 through = f.vec3("through"), normal = f.vec3("normal");
  const Body half = cut_by_plane(body, through, -normal, true);
  Body image = transformed(half, Affine::mirror(normal, through));
  for (Face& face : image.faces)
    face.origin.feature = face.origin.feature.empty() ? "image" : "image." + face.origin.feature;
  return boolean(BooleanOperation::unite, half, image);
}

}  // namespace

TypeDeclaration cut_body_type() {
  return declare(Category::body, "cut_body",
                 "The part of a body on one side of a plane, surface or open shell that divides it. Faces: those of "
                 "the body, and cut, or those of the shell.")
      .example("of: { type: box, size: [6, 4, 3] }, by: { type: plane, center: [3, 0, 0], normal: x }")
      .field("of", reference({Category::body}), "a closed body")
      .field("by", reference({Category::surface, Category::body}),
             "a plane, a surface, or an open shell, whose border lies outside of the body")
      .field("keep", choice({"inner", "outer"}),
             "which part: the one that the sheet's normals look away from, or the one that they look into", "inner")
      .built_by([](const Fields& f) -> BodyPtr {
        return worked("by", "a sheet whose border lies outside of the body, and that nowhere only touches it",
                      [&] { return cut_by(f); });
      });
}

TypeDeclaration inverted_body_type() {
  return declare(Category::body, "inverted_body",
                 "A body turned inside out: its normals look into its material, its volume is negative.")
      .example("of: { type: box, size: [2, 2, 2] }")
      .field("of", reference({Category::body}), "the body")
      .built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(inverted(*f.body("of"))); });
}

TypeDeclaration symmetric_body_type() {
  return declare(Category::body, "symmetric_body",
                 "The half of a body on one side of a plane, united with its mirror image. Faces: those of the body, "
                 "and image.NAME for those of the image where they are not one with these.")
      .example("of: { type: box, corner: [-1, 0, 0], size: [3, 2, 1] }, through: [0, 0, 0], normal: x")
      .field("of", reference({Category::body}), "a closed body")
      .field("through", point(), "a point of the plane", "[0, 0, 0]")
      .field("normal", direction(), "of the plane, into the half that is kept", "x")
      .built_by([](const Fields& f) -> BodyPtr { return worked("of", "another plane", [&] { return symmetric(f); }); });
}

}  // namespace lekalo::geometry
