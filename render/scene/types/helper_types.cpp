// Helpers that geometry types offer to drawings (`show` of an object): their fields. Which type offers which says the
// type itself (TypeDeclaration::shows); combs, frames and normals belong to every curve or surface.
#include <cmath>

#include "geometry/curves/splines/bspline_basis.h"
#include "render/model/color_scale.h"
#include "render/model/look.h"
#include "render/scene/types/helper_types.h"
#include "render/scene/values/types.h"

namespace lekalo::render {

using namespace geometry;

namespace helpers {

constexpr const char* kMarkers[] = {"none", "dot", "circle", "ball", "cross", "plus", "square", "triangle", "diamond"};

FieldType marker() { return choice({std::begin(kMarkers), std::end(kMarkers)}); }

TypeDeclaration helper(const char* name, const char* description, const char* default_style) {
  return declare(Category::helper, name, description)
      .field("style", reference({Category::style}), "of its lines and texts", default_style)
      .field("hidden", hidden_lines(), "what becomes of what lies behind something", "drop");
}

TypeDeclaration& finish(TypeDeclaration& type) {
  return type.built_by([name = type.name](const Fields& f) {
    Helper result;
    result.type = name;
    result.style = style_of(f, "style");
    result.hidden = hidden_of(f);
    result.values = f;
    return result;
  });
}

}  // namespace helpers

using namespace helpers;

namespace {

const char* kBlossom = "text at each point of a curve: the arguments of the polar form whose value it is";

TypeDeclaration control_polygon() {
  TypeDeclaration type = helper("control_polygon", "The control points of a curve, joined.", "construction");
  type.field("marker", marker(), "sign at the points", "dot")
      .optional("label", label({"i"}), "text at each point; %i is its index")
      .field("label_points", choice({"all", "ends"}), "which points have the label", "all")
      .field("blossom", boolean(), kBlossom, "false");
  return finish(type);
}

TypeDeclaration control_net() {
  TypeDeclaration type = helper("control_net",
                                "The control points of a surface, joined in rows and columns; of a Bezier triangle in "
                                "three directions.",
                                "construction");
  type.field("marker", marker(), "sign at the points", "dot")
      .optional("label", label({"i", "j", "k"}),
                "text at each point; %i is its index along u, %j along v; of a triangle %i, %j, %k with the sum n")
      .field("label_points", choice({"all", "corners"}), "which points have the label", "all");
  return finish(type);
}

TypeDeclaration t_mesh_helper() {
  TypeDeclaration type = helper("t_mesh", "The mesh of a T-spline in the parameter plane, or on the surface.", "thin");
  type.field("where", choice({"plane", "surface"}), "plane: the vertices at (u, v, 0); surface: as far as it goes",
             "plane")
      .field("marker", marker(), "sign at the vertices", "dot")
      .optional("label", label({"i", "j"}), "text at each vertex; %i is its number");
  return finish(type);
}

// The points of de Casteljau's and de Boor's triangles; the levels count from 1.
TypeDeclaration triangle(const char* name, const char* description, bool of_surfaces_too) {
  TypeDeclaration type = helper(name, description, "construction");
  if (of_surfaces_too)
    type.example("t: 0.4")
        .optional("t", number(), "where a curve is divided")
        .optional("u", number(), "where a surface is divided; of a Bezier triangle a parameter of its triangle")
        .optional("v", number(), "where a surface is divided; of a Bezier triangle a parameter of its triangle");
  else
    type.field("t", number(), "parameter of the point");
  type.optional("levels", numbers().at_least(1), "which levels: 1..2, [1, 3]; all without it")
      .field("marker", marker(), "sign at the points", "circle")
      .optional("label", label({"i", "k"}), "text at each point; %i is its index, %k its level")
      .field("blossom", boolean(), kBlossom, "false");
  finish(type);
  return type.built_by([build = type.build](const Fields& f) -> std::any {
    if (f.has("levels"))
      for (const double level : f.numbers("levels"))
        if (level != std::nearbyint(level)) throw FieldError("levels", "levels are whole numbers", "for example 1..2");
    return build(f);
  });
}

TypeDeclaration comb() {
  TypeDeclaration type =
      helper("comb", "The curvature or torsion of a curve as teeth across it, or what of it lies along a surface.",
             "hairline");
  type.field("count", integer().between(2, 10000), "number of teeth", "60")
      .field(
          "by", choice({"curvature", "torsion", "geodesic_curvature", "normal_curvature"}),
          "torsion: along the binormal, backwards where it is negative; of a curve on a surface, what of its bending "
          "lies in the surface and what across it",
          "curvature")
      .field("scale", number(), "length of a tooth for curvature or torsion 1, in scene units", "1")
      .field("envelope", boolean(), "join the ends of the teeth", "true");
  return finish(type);
}

TypeDeclaration frames() {
  TypeDeclaration type = helper("frames", "Moving frames along a curve: tangent, normal, binormal.", "thin");
  type.field(
          "kind", choice({"frenet", "rotation_minimizing", "on_surfaces"}),
          "how the frame turns along the curve; on_surfaces: its normal is that of a surface, or between those of two",
          "frenet")
      .optional("surfaces", references({Category::surface}).count(1, 2),
                "for on_surfaces: those that the curve lies on")
      .field("share", number().between(0, 1), "of the first surface in the direction of the normal, of two", "0.5")
      .field("count", integer().between(1, 10000), "how many, evenly spaced in arc length", "9")
      .optional("at", numbers(), "at these parameters t instead")
      .field("length", length().positive(), "of the vectors, in scene units", "1")
      .field("label", choice({"none", "first", "last", "all"}), "which frames have names at their vectors", "none")
      .field("names", labels().count(3, 3), "of the tangent, the normal and the binormal",
             "['$\\mathbf{t}$', '$\\mathbf{n}$', '$\\mathbf{b}$']");
  finish(type);
  return type.built_by([build = type.build](const Fields& f) -> std::any {
    if ((f.text("kind") == "on_surfaces") != f.has("surfaces"))
      throw FieldError(f.has("surfaces") ? "surfaces" : "kind", "'kind: on_surfaces' and 'surfaces' belong together");
    if (f.given("count") && f.given("at")) throw FieldError("count", "'at' and 'count' say the same: leave one out");
    return build(f);
  });
}

TypeDeclaration normals() {
  TypeDeclaration type = helper("normals", "Unit normals of a surface.", "thin");
  type.field("at_u", counts(), "parameters u: how many, or where", "5")
      .field("at_v", counts(), "parameters v: how many, or where", "5")
      .field("length", length().positive(), "in scene units", "1")
      .field("frames", boolean(),
             "with the unit tangent t along u and t x n beside the normal n (not where r_u vanishes)", "false");
  return finish(type);
}

TypeDeclaration knots_helper() {
  TypeDeclaration type = helper("knots", "The knots of a curve as points on it, of a surface as lines on it.", "thin");
  type.field("marker", marker(), "sign at the points of a curve", "cross")
      .optional("label", label({"i"}), "text at each knot of a curve; %i is its index");
  return finish(type);
}

// Places along a curve: so many, or these.
void with_places(TypeDeclaration& type, const char* count) {
  type.field("count", integer().between(1, 10000), "how many, evenly spaced in arc length", count)
      .optional("at", numbers(), "at these parameters t instead");
}

TypeDeclaration finish_with_places(TypeDeclaration& type) {
  finish(type);
  return type.built_by([build = type.build](const Fields& f) -> std::any {
    if (f.given("count") && f.given("at")) throw FieldError("count", "'at' and 'count' say the same: leave one out");
    return build(f);
  });
}

TypeDeclaration osculating_circle() {
  TypeDeclaration type = helper(
      "osculating_circle", "The circles that touch a curve closest, with their radii (Golovanov 2016, 2.1).", "thin");
  with_places(type, "1");
  type.field("center", boolean(), "show the center and the radius to the curve's point", "true")
      .field("marker", marker(), "sign at both", "dot");
  return finish_with_places(type);
}

TypeDeclaration evolute_helper() {
  TypeDeclaration type = helper("evolute", "The centers of a curve's osculating circles.", "thin");
  type.optional("reach", length().positive(), "where the radius is larger it is left out; the curve's size by default");
  return finish(type);
}

TypeDeclaration rays(const char* name, const char* description) {
  TypeDeclaration type = helper(name, description, "thin");
  with_places(type, "9");
  type.field("length", length().positive(), "in scene units", "1")
      .field("both", boolean(), "a line to both sides instead of an arrow", "false")
      .field("marker", marker(), "sign at the points of the curve", "none");
  return finish_with_places(type);
}

TypeDeclaration features_helper() {
  TypeDeclaration type = helper("features", "Places where the shape of a curve changes (Golovanov 2016, 2.1).", "thin");
  type.field(
          "kinds", words({"inflection", "vertex", "cusp", "rest", "corner"}),
          "which: the curvature changes its sign, is largest or least; the curve stops and turns, stops; the tangent "
          "jumps",
          "[inflection, vertex, cusp, rest, corner]")
      .field("marker", marker(), "sign at them", "circle");
  return finish(type);
}

TypeDeclaration hodograph_helper() {
  TypeDeclaration type = helper("hodograph", "The tips of a curve's derivative vectors drawn from one point.", "thin");
  type.field("at", point(), "where the vectors begin", "[0, 0, 0]")
      .field("scale", number(), "length of a vector of speed 1, in scene units", "1");
  return finish(type);
}

TypeDeclaration direction_helper() {
  TypeDeclaration type = helper("direction", "Arrow heads on a curve in the direction of growing parameters.", "thin");
  with_places(type, "1");
  return finish_with_places(type);
}

TypeDeclaration colored_helper() {
  TypeDeclaration type =
      helper("colored",
             "A curve in colours that tell its curvature or another number, in place of the drawing's own line of it.",
             "thick");
  type.field("by", choice(curve_quantities()),
             "signed_curvature: of a plane curve, positive to the left; speed: |dr/dt|; geodesic_curvature, "
             "normal_curvature: "
             "of a curve on a surface",
             "curvature")
      .optional("range", range(),
                "the numbers of the first and last colour; least and largest by default, of both "
                "signs in blue_red as far from zero")
      .field("colors", choice(color_scales()), "scale of colours; blue_red for numbers with signs", "viridis")
      .field("count", integer().between(2, 2000), "parts of one colour each", "120");
  return finish(type);
}

TypeDeclaration cutters() {
  TypeDeclaration type =
      helper("cutters", "The cutter at places of its path: meridians and circles of its outline.", "thin");
  with_places(type, "3");
  type.field("meridians", integer().between(1, 64), "how many, the first through the contact", "4");
  return finish_with_places(type);
}

TypeDeclaration tool_arrows(const char* name, const char* description, const char* by_default) {
  TypeDeclaration type = helper(name, description, "thin");
  with_places(type, "9");
  type.optional("length", length().positive(), by_default).field("marker", marker(), "sign where they begin", "none");
  return finish_with_places(type);
}

TypeDeclaration tool_moves() {
  TypeDeclaration type = helper("tool_moves", "Some moves of the path of a cutter.", "thin");
  type.field("kinds", words({"cut", "link", "approach", "exit", "rapid"}),
             "which: rows and links between them on the part; down to it, up, and in the air",
             "[approach, exit, rapid]")
      .field("arrows", boolean(), "a head at the end of each", "false");
  return finish(type);
}

TypeDeclaration insertion() {
  TypeDeclaration type =
      helper("insertion", "The control polygon with more knots (Golovanov 2016, 2.11).", "construction");
  type.example("at: [0.4]")
      .field("at", numbers().count(1), "parameters of the new knots")
      .field("times", integer().between(1, kMaxDegree), "how often each is put in", "1")
      .field("marker", marker(), "sign at the points", "circle");
  return finish(type);
}

TypeDeclaration elevation() {
  TypeDeclaration type =
      helper("elevation", "The control polygon of a higher degree (Golovanov 2016, 2.6).", "construction");
  type.optional("degree", integer().between(1, kMaxDegree), "the degree; one more when left out")
      .field("marker", marker(), "sign at the points", "circle");
  return finish(type);
}

TypeDeclaration hulls() {
  return helper("hulls", "The convex hulls of the control points of each span, in which the curve lies.", "hairline");
}

TypeDeclaration moved_point() {
  TypeDeclaration type =
      helper("moved_point", "A control point moved, and the part of the curve that moves with it.", "thin");
  type.example("index: 1, by: [0, 1]")
      .field("index", integer().at_least(0), "of the control point, from 0")
      .field("by", vector(), "how far it is moved")
      .field("marker", marker(), "sign at the moved point", "dot");
  return finish(type);
}

TypeDeclaration crossings() {
  TypeDeclaration type =
      helper("crossings", "A line across a curve, and where it meets the curve or its control polygon.", "thin");
  type.example("line: { through: [0.5, 0], along: y }")
      .field("line", axis(), "the line, in the plane of the curve")
      .field("plane", direction(), "normal of the plane of the curve", "z")
      .field("of", choice({"curve", "polygon"}), "whose crossings have the sign", "curve")
      .field("marker", marker(), "sign at the crossings", "dot")
      .optional("label", label({"i", "j"}),
                "text at the line's end; %i is how often it meets the curve, %j how often the polygon");
  return finish(type);
}

TypeDeclaration jumps() {
  TypeDeclaration type = helper(
      "jumps", "Where a graph or curve jumps: a full dot at its value, open ones at the limits beside it.", "thin");
  return finish(type);
}

}  // namespace

std::vector<TypeDeclaration> helper_types() {
  TypeDeclaration hull_type = hulls();
  std::vector<TypeDeclaration> all = surface_helper_types();
  const std::vector<TypeDeclaration> routes = route_helper_types();
  all.insert(all.end(), routes.begin(), routes.end());
  const std::vector<TypeDeclaration> others = {
      control_polygon(),
      control_net(),
      t_mesh_helper(),
      triangle("de_casteljau", "De Casteljau's construction of a point (Golovanov 2016, 2.4).", true),
      triangle("de_boor", "De Boor's construction of a point (Golovanov 2016, 2.9).", false),
      comb(),
      frames(),
      normals(),
      knots_helper(),
      osculating_circle(),
      evolute_helper(),
      rays("tangents", "Unit tangents of a curve, or tangent lines."),
      rays("normal_lines", "Principal normals of a curve, towards the center of curvature, or normal lines."),
      features_helper(),
      hodograph_helper(),
      direction_helper(),
      colored_helper(),
      insertion(),
      elevation(),
      finish(hull_type),
      moved_point(),
      crossings(),
      cutters(),
      tool_arrows("tool_axes", "The axis of a cutter at places of its path, from the middle of its end.",
                  "in scene units; the cutter's when left out"),
      tool_arrows("contacts", "Where a cutter touches, with the normals there.",
                  "of the normals, in scene units; the cutter's radius when left out"),
      tool_moves(),
      jumps()};
  all.insert(all.begin(), others.begin(), others.end());
  return all;
}

}  // namespace lekalo::render
