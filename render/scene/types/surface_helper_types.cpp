// Helpers of surfaces and triangulations (render/lines/surface_figures.h, mesh_figures.h): their fields.
#include <fmt/format.h>

#include "geometry/describe.h"
#include "render/integrators/quantities.h"
#include "render/scene/types/helper_types.h"

namespace lekalo::render {

using namespace geometry;
using namespace helpers;

namespace {

TypeDeclaration& with_beginnings(TypeDeclaration& type) {
  return type.field("at_u", counts(), "lines begin in the middles of so many ranges of u, or at these u", "4")
      .field("at_v", counts(), "and of v; where one comes near to another it is left out", "4")
      .optional("length", length().positive(), "of a line, half of it to each side of where it begins");
}

TypeDeclaration curvature_lines() {
  TypeDeclaration type = helper("curvature_lines", "Lines of curvature of a surface (Golovanov 2016, 3.1).", "thin");
  type.field("family", choice({"both", "maximum", "minimum"}), "along the larger or the smaller principal curvature",
             "both");
  return finish(with_beginnings(type));
}

TypeDeclaration asymptotic_lines() {
  TypeDeclaration type =
      helper("asymptotic_lines", "Lines along which a surface has no normal curvature (Golovanov 2016, 3.1).", "thin");
  type.field("family", choice({"both", "first", "second"}),
             "turned from the direction of the larger curvature to the left or to the right", "both");
  return finish(with_beginnings(type));
}

TypeDeclaration contour_lines() {
  TypeDeclaration type =
      helper("contour_lines", "Lines of equal curvature, angle or another quantity on a surface.", "thin");
  add_quantity_of_place(type);
  type.field("levels", counts(), "about how many round numbers, or which", "10")
      .field("labels", boolean(), "in drawings, the number beside each line", "false");
  finish(type);
  return type.built_by([build = type.build](const Fields& f) -> std::any {
    quantity_of(f);  // throws where it is none
    return build(f);
  });
}

TypeDeclaration isophotes() {
  TypeDeclaration type = helper(
      "isophotes", "Where the normal of a surface stands at an angle to a direction: equally lit points.", "thin");
  type.field("direction", direction(), "towards the light", "z")
      .field("angles", counts(), "so many between 0 and 180 degrees, or these, in degrees", "17");
  finish(type);
  return type.built_by([build = type.build](const Fields& f) -> std::any {
    for (const double angle : f.get<ParameterValues>("angles").values)
      if (!(angle > 0 && angle < 180))
        throw FieldError("angles", fmt::format("the angle {:g} is not between 0 and 180 degrees", angle));
    return build(f);
  });
}

TypeDeclaration reflections() {
  TypeDeclaration type =
      helper("reflections", "Where parallel lamps are seen mirrored in a surface: how stylists judge it.", "thin");
  type.example("eye: [0, -9, 4]")
      .field("lamp", axis(), "the lamp in the middle", "{ through: [0, 0, 10], along: x }")
      .field("ceiling", direction(), "normal of the plane in which the lamps lie", "z")
      .field("spacing", length().positive(), "from one lamp to the next", "1")
      .field("count", integer().between(1, 200), "of lamps", "9")
      .optional("along", direction(), "direction of sight of a parallel view")
      .optional("eye", point(), "where a central view looks from, instead");
  finish(type);
  return type.built_by([build = type.build](const Fields& f) -> std::any {
    if (f.has("along") == f.has("eye"))
      throw FieldError(f.has("eye") ? "eye" : "along", "give either `along` (parallel view) or `eye` (central view)");
    if (!(glm::length(glm::cross(f.vec3("ceiling"), f.axis("lamp").along)) > 1e-9))
      throw FieldError("ceiling", "the lamps would stand upright on their plane",
                       "the normal of the plane of the lamps is across them");
    return build(f);
  });
}

TypeDeclaration principal_directions() {
  TypeDeclaration type = helper("principal_directions", "Crosses along the principal directions of a surface.", "thin");
  type.field("at_u", counts(), "parameters u: how many, or where", "7")
      .field("at_v", counts(), "parameters v: how many, or where", "7")
      .field("length", length().positive(), "of a line, in scene units", "0.2");
  return finish(type);
}

TypeDeclaration hedgehog() {
  TypeDeclaration type =
      helper("hedgehog", "Needles along the normals of a surface, as long as a curvature or another quantity says.",
             "hairline");
  add_quantity_of_place(type);
  type.field("at_u", counts(), "parameters u: how many, or where", "20")
      .field("at_v", counts(), "parameters v: how many, or where", "20")
      .field("scale", number(), "length of a needle for the quantity 1, in scene units", "1")
      .field("envelope", boolean(), "join the tips of each row", "true");
  finish(type);
  return type.built_by([build = type.build](const Fields& f) -> std::any {
    quantity_of(f);  // throws where it is none
    return build(f);
  });
}

TypeDeclaration tool_axis_field() {
  TypeDeclaration type = helper("tool_axis_field",
                                "Axes of a milling tool along rows of a surface, across the row and tilted from the "
                                "tangent plane (Zavyalov et al. 1985, VII.4).",
                                "hairline");
  type.field("rows", choice({"u", "v"}), "rows run with u or with v", "u")
      .field("tilt", angle_formula({"u", "v"}), "angle between the axis and the tangent plane, towards the normal",
             "90")
      .field("at_u", counts(), "parameters u: how many, or where", "12")
      .field("at_v", counts(), "parameters v: how many, or where", "5")
      .field("length", length().positive(), "of an arrow, in scene units", "0.2");
  return finish(type);
}

TypeDeclaration umbilics_helper() {
  TypeDeclaration type =
      helper("umbilics", "Single places of a surface where it curves alike in all directions.", "thin");
  type.field("marker", marker(), "sign at them", "ball");
  return finish(type);
}

TypeDeclaration& at_place(TypeDeclaration& type) {
  return type.example("u: 0.3, v: 0.4")
      .field("u", number(), "parameters of the place")
      .field("v", number(), "parameters of the place")
      .field("marker", marker(), "sign at it", "dot");
}

TypeDeclaration principal_circles() {
  TypeDeclaration type = helper(
      "principal_circles", "The osculating circles of a surface's two principal normal sections at a place.", "thin");
  at_place(type).field("center", boolean(), "show the centers and the radii", "true");
  return finish(type);
}

TypeDeclaration dupin_indicatrix() {
  TypeDeclaration type = helper(
      "dupin_indicatrix", "k1 x^2 + k2 y^2 = +-1 in the tangent plane: an ellipse, two hyperbolas, two lines.", "thin");
  at_place(type).field("scale", number().positive(), "it is so many times larger", "0.2");
  return finish(type);
}

TypeDeclaration tangent_plane() {
  TypeDeclaration type = helper("tangent_plane", "A square of the tangent plane of a surface at a place.", "thin");
  at_place(type)
      .field("size", length().positive(), "side of the square, in scene units", "1")
      .field("vectors", boolean(), "with the normal and the directions of the parameter lines", "false");
  return finish(type);
}

TypeDeclaration circumcircles() {
  TypeDeclaration type =
      helper("circumcircles", "The circles through the corners of triangles (Golovanov 2016, 8.6).", "hairline");
  type.optional("of", numbers().at_least(0), "numbers of the triangles, from 0; all without it")
      .field("marker", marker(), "sign at the centers", "none");
  return finish(type);
}

TypeDeclaration voronoi() {
  TypeDeclaration type =
      helper("voronoi",
             "The borders of Voronoi's cells: what is nearer to a point of the triangulation than to "
             "all others. Of one by Delaunay's condition.",
             "thin");
  type.optional("reach", length().positive(), "of the lines that have no end; half the size of the points by default")
      .field("marker", marker(), "sign at the corners of the cells", "none");
  return finish(type);
}

TypeDeclaration greedy_edges() {
  TypeDeclaration type = helper("greedy_edges",
                                "The edges of the greedy triangulation of a plane mesh's points: the shortest first, "
                                "each that crosses none kept before (Golovanov 2016, 8.6).",
                                "thin");
  type.optional("steps", integer().at_least(0), "only so many; all without it")
      .field("marker", marker(), "sign at the points", "none");
  return finish(type);
}

}  // namespace

std::vector<TypeDeclaration> surface_helper_types() {
  return {curvature_lines(), asymptotic_lines(),     contour_lines(),     isophotes(),        reflections(),
          umbilics_helper(), principal_directions(), principal_circles(), dupin_indicatrix(), tangent_plane(),
          hedgehog(),        tool_axis_field(),      circumcircles(),     voronoi(),          greedy_edges()};
}

}  // namespace lekalo::render
