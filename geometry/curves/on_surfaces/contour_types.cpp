// Scene types of contours: curves given by surfaces rather than by points.
#include <fmt/format.h>

#include "geometry/curves/on_surfaces/branch_choice.h"
#include "geometry/queries/contours/isophote.h"
#include "geometry/queries/contours/plane_section.h"
#include "geometry/queries/contours/silhouette.h"
#include "geometry/queries/contours/surface_intersection.h"
#include "geometry/queries/intersections/self_intersections.h"

namespace lekalo::geometry {

namespace {

CurvePtr chosen(const Contours& found, const Fields& f, const std::string& none) {
  const size_t count = found.branches.size();
  if (!found.complete)
    throw FieldError("of", "not all is known here: surfaces nearly touch along a curve or nearly coincide",
                     "move one of them a little");
  if (count == 0 && found.coincident)
    throw FieldError("of", "the surfaces coincide, and where they do so has no border", "move one of them a little");
  if (count == 0) throw FieldError("of", found.points.empty() ? none : none + " but for single points of contact");
  return chosen_branch(found.branches, f, "of");
}

// What a wrong operand makes a query say belongs to the field `of`.
template <class Query>
Contours asked(Query&& query) {
  try {
    return query();
  } catch (const FieldError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw FieldError("of", error.what());
  }
}

TypeDeclaration& seen(TypeDeclaration& type) {
  return type.optional("along", direction(), "direction of sight of a parallel view")
      .optional("eye", point(), "where a central view looks from, instead");
}

ViewOf view_of(const Fields& f) {
  if (f.has("along") == f.has("eye"))
    throw FieldError(f.has("eye") ? "eye" : "along", "give either `along` (parallel view) or `eye` (central view)");
  if (f.has("eye")) return {true, f.vec3("eye")};
  return {false, f.vec3("along")};
}

}  // namespace

TypeDeclaration intersection_curve_type() {
  TypeDeclaration type = declare(Category::curve, "intersection_curve", "Where two surfaces meet.");
  type.field("of", references({Category::surface}).count(2, 2), "both surfaces")
      .example("of: [{ type: sphere_surface, radius: 2 }, { type: plane, origin: [0, 0, 1], size: [6, 6] }]");
  return choose_branch(type).built_by([](const Fields& f) {
    const auto& of = f.references("of");
    const auto a = std::any_cast<SurfacePtr>(of[0]), b = std::any_cast<SurfacePtr>(of[1]);
    return std::any(chosen(asked([&] { return intersect(a, b); }), f, "the surfaces do not meet"));
  });
}

TypeDeclaration self_intersection_curve_type() {
  TypeDeclaration type = declare(Category::curve, "self_intersection_curve", "Where a surface meets itself.");
  type.field("of", reference({Category::surface}), "the surface")
      .example("of: { type: formula_surface, point: [u*v, u, v^2], domain: { u: [-1, 1], v: [-1, 1] } }");
  return choose_branch(type).built_by([](const Fields& f) {
    const auto found = asked([&] { return self_intersection(f.surface("of")); });
    return std::any(chosen(found, f, "the surface does not meet itself"));
  });
}

TypeDeclaration section_curve_type() {
  TypeDeclaration type = declare(Category::curve, "section_curve", "Where a plane cuts a surface.");
  type.field("of", reference({Category::surface}), "the surface")
      .field("through", point(), "a point of the plane", "[0, 0, 0]")
      .field("normal", direction(), "normal of the plane")
      .example("of: { type: sphere_surface, radius: 2 }, normal: [1, 0, 1]");
  return choose_branch(type).built_by([](const Fields& f) {
    const auto found = asked([&] { return plane_section(f.surface("of"), f.vec3("through"), f.vec3("normal")); });
    return std::any(chosen(found, f, "the plane does not meet the surface"));
  });
}

TypeDeclaration silhouette_curve_type() {
  TypeDeclaration type =
      declare(Category::curve, "silhouette_curve", "Where the way of sight touches a surface: its outline as seen.");
  type.field("of", reference({Category::surface}), "the surface")
      .example("of: { type: sphere_surface, radius: 2 }, along: [1, 1, -1]");
  return choose_branch(seen(type)).built_by([](const Fields& f) {
    const ViewOf view = view_of(f);
    const auto found = asked([&] { return silhouette(f.surface("of"), view); });
    return std::any(chosen(found, f, "the surface has no silhouette in this view"));
  });
}

TypeDeclaration isophote_curve_type() {
  TypeDeclaration type =
      declare(Category::curve, "isophote_curve",
              "Where the normal of a surface stands at an angle to a direction: equally lit points.");
  type.field("of", reference({Category::surface}), "the surface")
      .field("direction", direction(), "towards the light")
      .field("angle", angle().between(0, kPi), "between the normal and the direction; 90 gives the silhouette")
      .example("of: { type: sphere_surface, radius: 2 }, direction: z, angle: 40");
  return choose_branch(type).built_by([](const Fields& f) {
    const auto found = asked([&] { return isophote(f.surface("of"), f.vec3("direction"), f.number("angle")); });
    return std::any(chosen(found, f, "no normal of the surface stands at that angle"));
  });
}

TypeDeclaration reflection_line_type() {
  TypeDeclaration type =
      declare(Category::curve, "reflection_line", "Where a straight lamp of any length is seen mirrored in a surface.");
  type.field("of", reference({Category::surface}), "the surface")
      .field("lamp", axis(), "the line of the lamp: a point and its direction")
      .example(
          "of: { type: sphere_surface, radius: 2 }, lamp: { through: [0, 0, 8], along: x }, eye: [0, -9, 3], branch: "
          "1");
  return choose_branch(seen(type)).built_by([](const Fields& f) {
    const ViewOf view = view_of(f);
    const Axis lamp = f.axis("lamp");
    const auto found = asked([&] { return reflection_line(f.surface("of"), view, {lamp.through, lamp.along}); });
    return std::any(chosen(found, f, "the lamp is not mirrored in the surface"));
  });
}

}  // namespace lekalo::geometry
