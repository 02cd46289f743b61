// Annotations of drawings: labels, marks, arrows, dimensions. Lengths and sides are those of the page; points may be
// given on it too ({ page: [5 mm, 8 mm] }).
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "geometry/body.h"
#include "geometry/describe.h"
#include "geometry/queries/differential/roundness.h"
#include "render/model/color_scale.h"
#include "render/model/page.h"
#include "render/scene/values/types.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// As TikZ calls them.
FieldType side() {
  return choice(
      {"above", "below", "left", "right", "above left", "above right", "below left", "below right", "center"});
}

TypeDeclaration annotation(const char* name, const char* description, const char* default_style) {
  return declare(Category::annotation, name, description)
      .field("style", reference({Category::style}), "of its lines and texts", default_style);
}

// Of annotations that stand in space.
TypeDeclaration& with_hidden(TypeDeclaration& type) {
  return type.field("hidden", hidden_lines(), "what becomes of what lies behind something", "show");
}

// Builds the annotation when `check` finds nothing wrong.
TypeDeclaration finish(TypeDeclaration type, void (*check)(const Fields&) = nullptr) {
  return type.built_by([name = type.name, check](const Fields& f) {
    if (check) check(f);
    Annotation result;
    result.type = name;
    result.style = style_of(f, "style");
    result.values = f;
    return result;
  });
}

TypeDeclaration& with_side(TypeDeclaration& type) {
  return type.optional("side", side(), "where the text stands; without it where there is room");
}

TypeDeclaration label_annotation() {
  TypeDeclaration type = annotation("label", "A text beside a point.", "label");
  type.field("at", anchor(), "what it speaks of").field("text", label(), "TeX in single quotes");
  with_side(type)
      .optional("distance", page_length().non_negative(), "from the point to the text")
      .field("leader", boolean(), "a line from the text to the point", "false");
  return finish(with_hidden(type));
}

TypeDeclaration point_annotation() {
  TypeDeclaration type = annotation("point", "A marked point, with a text or without.", "label");
  type.field("at", anchor(), "the point")
      .field("marker", choice({"dot", "circle", "ball", "cross", "plus", "square", "triangle", "diamond"}),
             "sign at the point", "dot")
      .optional("label", label(), "text beside it");
  return finish(with_hidden(with_side(type)));
}

TypeDeclaration arrow_annotation() {
  TypeDeclaration type = annotation("arrow", "A straight arrow: to a point, or along a direction.", "{ arrows: end }");
  type.example("from: [0, 0, 0], to: [1, 0, 0]")
      .field("from", anchor(), "where it begins")
      .optional("to", anchor(), "where it ends")
      .optional("along", direction(), "the way it goes, instead of `to`")
      .optional("length", length().positive(), "in scene units, with `along`")
      .optional("label", label(), "text at its end");
  return finish(with_hidden(with_side(type)), [](const Fields& f) {
    if (f.has("to") == f.has("along"))
      throw FieldError(f.has("to") ? "along" : "", "an arrow has either 'to' or 'along' and 'length'",
                       "to: where it ends; along: its direction");
    if (f.has("along") && !f.has("length"))
      throw FieldError("along", "'along' needs 'length'", "the length of the arrow in scene units");
    if (f.has("to") && f.has("length"))
      throw FieldError("length", "'length' goes with 'along'", "an arrow 'to' a point has its length from the points");
  });
}

TypeDeclaration frame_annotation() {
  TypeDeclaration type = annotation("frame", "A local frame: three arrows from its origin.", "{ arrows: end }");
  type.field("frame", frame(), "where it stands", "{}")
      .field("length", length().positive(), "of the arrows, in scene units", "1")
      .field("labels", labels().count(0, 3), "names of the axes", "['$x$', '$y$', '$z$']");
  return finish(with_hidden(type));
}

TypeDeclaration axes_annotation() {
  TypeDeclaration type = annotation("axes", "The directions of the world's axes.", "{ arrows: end }");
  type.field("at", anchor(), "where they meet: in the scene, or in a corner of the page", "[0, 0, 0]")
      .field("length", length().positive(), "of the axes, in scene units", "1")
      .field("labels", labels().count(0, 3), "names of the axes", "['$x$', '$y$', '$z$']");
  return finish(with_hidden(type));
}

TypeDeclaration angle_annotation() {
  TypeDeclaration type = annotation(
      "angle", "The arc of an angle, with a text. One of 180 degrees is seen from the front, counterclockwise.",
      "thin");
  type.field("at", anchor(), "the apex")
      .field("from", anchor(), "a point on the first side")
      .field("to", anchor(), "a point on the second side")
      .field("radius", page_length().positive(), "of the arc", "6 mm")
      .optional("label", label(), "text at the arc");
  return finish(with_hidden(with_side(type)));
}

TypeDeclaration leader_annotation() {
  TypeDeclaration type = annotation("leader", "A text with a line that points at something.", "thin");
  type.field("at", anchor(), "what it points at")
      .field("to", anchor(), "where the text stands")
      .field("text", label(), "TeX in single quotes")
      .field("head", choice({"arrow", "dot", "none"}), "end of the line", "arrow");
  return finish(with_side(type));
}

TypeDeclaration balloon_annotation() {
  TypeDeclaration type = annotation("balloon", "The number of a part in a circle, with a line to the part.", "thin");
  type.example("at: [0, 0, 0], to: [1, 1, 0], text: '1'")
      .field("at", anchor(), "the part")
      .field("to", anchor(), "the middle of the circle")
      .field("text", label(), "its number; TeX in single quotes")
      .field("radius", page_length().positive(), "of the circle; a longer text has a larger one", "3 mm")
      .field("head", choice({"arrow", "dot", "none"}), "end of the line", "dot");
  return finish(type);
}

TypeDeclaration brace_annotation() {
  TypeDeclaration type = annotation("brace", "A brace along a distance, with a text at its tip.", "thin");
  type.field("from", anchor(), "where it begins")
      .field("to", anchor(), "where it ends")
      .field("offset", page_length(), "from the two points; negative: on the other side", "1 mm")
      .field("depth", page_length().positive(), "of the brace", "2 mm")
      .optional("label", label(), "text at the tip");
  return finish(type);
}

// Text of a dimension: the measured number between prefix and suffix, or `text` instead of all.
TypeDeclaration dimension(const char* name, const char* description) {
  TypeDeclaration type = annotation(name, description, "dimension");
  type.optional("text", label(), "instead of the measured number")
      .optional("prefix", label(), "before the number")
      .optional("suffix", label(), "behind the number")
      .field("decimals", integer().between(0, 9), "of the number, zeros at its end left out", "2");
  return type;
}

void one_text(const Fields& f) {
  for (const char* field : {"prefix", "suffix", "decimals"})
    if (f.has("text") && f.given(field))
      throw FieldError(field, "'text' stands instead of the number: there is nothing for '" + std::string(field) + "'");
}

void check_in_space(const Fields& f, std::initializer_list<const char*> anchors) {
  for (const char* field : anchors)
    if (f.get<Anchor>(field).on_page)
      throw FieldError(field, "a dimension measures the model, not the page", "give a point of the scene");
}

TypeDeclaration linear_dimension() {
  TypeDeclaration type = dimension("linear_dimension", "A distance between two points, or a component of it.");
  type.field("from", anchor(), "the first point")
      .field("to", anchor(), "the second point")
      .optional("along", direction(), "measure along this direction only")
      .field("offset", page_length(), "of the dimension line from the points; negative: on the other side", "8 mm");
  return finish(type, [](const Fields& f) {
    one_text(f);
    check_in_space(f, {"from", "to"});
  });
}

TypeDeclaration round_dimension(const char* name, const char* description) {
  TypeDeclaration type = dimension(name, description);
  type.field("of", references({Category::curve, Category::surface, Category::body}),
             "a circle, an arc, or a surface or body of revolution, of which the largest circle is measured: of a cone "
             "that of its wider end, uncut if it is named by a face; of several the one that is seen best")
      .field("leader", angle(), "direction of the dimension line on the page, from the right upwards", "45");
  return finish(type, [](const Fields& f) {
    one_text(f);
    bool round = false;
    for (const std::any& one : f.references("of")) {
      if (const auto* curve = std::any_cast<CurvePtr>(&one)) round = round || is_round(**curve);
      if (const auto* surface = std::any_cast<SurfacePtr>(&one)) round = round || is_round(**surface);
      if (const auto* body = std::any_cast<BodyPtr>(&one))
        for (const Face& face : (*body)->faces) round = round || is_round(*face.surface);
    }
    if (!round)
      throw FieldError("of", "this is not round: it has no radius",
                       "name a circle, an arc, or a sphere, cylinder, torus or other surface of revolution; a distance "
                       "is a linear_dimension");
  });
}

TypeDeclaration angle_dimension() {
  TypeDeclaration type = dimension("angle_dimension", "The angle between two directions from a point.");
  type.field("at", anchor(), "the apex")
      .field("from", anchor(), "a point on the first side")
      .field("to", anchor(), "a point on the second side")
      .field("offset", page_length().non_negative(),
             "of the arc, beyond the nearer of the two points; foreshortened as the plane of the angle is", "8 mm");
  return finish(type, [](const Fields& f) {
    one_text(f);
    check_in_space(f, {"at", "from", "to"});
  });
}

TypeDeclaration knots_annotation() {
  TypeDeclaration type = annotation("knots", "Marks at the knots of a spline on the axis of a graph.", "thin");
  type.field("of", reference({Category::curve}), "the curve whose knots they are")
      .field("marker", choice({"cross", "plus", "dot", "circle", "square", "triangle", "diamond"}), "sign at the knots",
             "cross")
      .optional("label", label({"i"}), "text at each; %i is the index of the knot")
      .field("multiplicity", choice({"stacked", "once"}), "a multiple knot: marks on one another, or one mark",
             "stacked");
  return finish(with_side(type));
}

TypeDeclaration light_path() {
  TypeDeclaration type = annotation("light_path", "A ray followed through the scene: refracted and reflected.", "ray");
  type.example("from: [0, -3, 0], along: y")
      .field("from", point(), "where it begins")
      .optional("to", point(), "a point that it is sent to")
      .optional("along", direction(), "the way that it is sent, instead of `to`")
      .field("wavelength", wavelength().between(360, 830), "in nanometres: 589 nm", "589 nm")
      .field("bounces", integer().between(0, 1000), "surfaces met before it ends", "16")
      .field("follow", choice({"refraction", "reflection"}), "which ray goes on at a surface of glass", "refraction")
      .optional("length", length().positive(), "of its last part, in scene units");
  return finish(type, [](const Fields& f) {
    if (f.has("to") == f.has("along"))
      throw FieldError(f.has("to") ? "along" : "", "a light path has either 'to' or 'along'",
                       "to: a point; along: a direction");
  });
}

TypeDeclaration color_bar() {
  TypeDeclaration type = annotation(
      "color_bar",
      "A scale of colours with numbers beside it: of lines that are `colored`, or of the integrator `analysis`.",
      "thin");
  type.example("at: { page: [5 mm, 5 mm] }, range: [0, 1]")
      .field("at", anchor(), "its lower left corner")
      .optional("of", reference({Category::curve}), "the curve whose least and largest numbers are its ends")
      .field("by", choice(curve_quantities()), "what is told of the curve", "curvature")
      .optional("range", range(), "the numbers at its ends; without these or a curve it is that of the integrator")
      .field("colors", choice(color_scales()),
             "scale of colours; of a curve's numbers of both signs blue_red has zero white", "viridis")
      .field("width", page_length().positive(), "on the page", "3 mm")
      .field("height", page_length().positive(), "on the page; a bar that is wider than high lies", "30 mm")
      .field("ticks", counts(), "about how many round numbers, or which", "5")
      .optional("label", label(), "text at its end");
  return finish(type, [](const Fields& f) {
    if (f.has("range") && f.has("of"))
      throw FieldError("range", "a colour bar has either the 'range' of its numbers or a curve 'of'",
                       "of: the curve that is coloured; range: as its helper 'colored' has it");
    if (!f.has("range") && !f.has("of")) {
      for (const char* field : {"by", "colors"})
        if (f.given(field))
          throw FieldError(
              field, fmt::format("a colour bar with '{}' has either the 'range' of its numbers or a curve 'of'", field),
              "without all of these it is that of the integrator 'analysis'");
      return;
    }
    const Interval ends =
        f.has("range") ? f.range("range") : curve_range(*f.curve("of"), f.text("by"), f.text("colors"));
    for (const double tick : f.get<ParameterValues>("ticks").values)
      if (!ends.contains(tick))
        throw FieldError("ticks", "the number " + std::to_string(tick) + " is beyond the ends of the bar");
  });
}

TypeDeclaration cutting_plane() {
  TypeDeclaration type = annotation(
      "cutting_plane",
      "Where the section of another panel cuts: its line with thick ends, the arrows of the viewer, and its letter.",
      "thick");
  type.field("of", text(), "name of the panel that has the section");
  return finish(type);
}

TypeDeclaration detail_circle() {
  TypeDeclaration type =
      annotation("detail_circle",
                 "What the detail of another panel shows: its circle and its letter, in a view the same way.", "thin");
  type.field("of", text(), "name of the panel that has the detail")
      .field("leader", angle(), "direction of the letter from the middle, from the right upwards", "45");
  return finish(type);
}

constexpr double kNothing = 1e-12;  // of the lengths from which a size is computed
constexpr double kNoAngle = 1e-9;   // radians

}  // namespace

bool tells_scale_of_ground(const Annotation& annotation) {
  return annotation.type == "color_bar" && !annotation.values.has("range") && !annotation.values.has("of");
}

std::optional<FieldError> lack_of_size(const std::string& type, const Fields& f) {
  const auto meets = [&](const char* one, const char* other) {
    if (!f.holds<Anchor>(one) || !f.holds<Anchor>(other)) return false;
    const Anchor &a = f.get<Anchor>(one), &b = f.get<Anchor>(other);
    return a.on_page == b.on_page && a.point == b.point;
  };
  if (type == "arrow" || type == "brace" || type == "linear_dimension") {
    const std::string what = type == "arrow" ? "an arrow" : type == "brace" ? "a brace" : "a dimension";
    if (meets("from", "to"))
      return FieldError("to", what + " ends where it begins: it has no length", "give two different points");
    if (type != "linear_dimension" || !f.has("along") || f.get<Anchor>("from").on_page || f.get<Anchor>("to").on_page)
      return std::nullopt;
    const Vec3 way = f.get<Anchor>("to").point - f.get<Anchor>("from").point;
    if (std::abs(glm::dot(way, f.vec3("along"))) > kNothing * glm::length(way)) return std::nullopt;
    return FieldError("along", "the two points lie side by side in this direction: there is nothing to measure",
                      "leave 'along' out to measure their distance");
  }
  if (type != "angle" && type != "angle_dimension") return std::nullopt;
  for (const char* side : {"from", "to"})
    if (meets("at", side))
      return FieldError(side, "this side of the angle has no length: the point is the apex", "give another point");
  const Anchor &at = f.get<Anchor>("at"), &from = f.get<Anchor>("from"), &to = f.get<Anchor>("to");
  if (at.on_page != from.on_page || at.on_page != to.on_page) return std::nullopt;
  const Vec3 x = from.point - at.point, y = to.point - at.point;
  if (glm::dot(x, y) < 0 || glm::length(glm::cross(x, y)) > kNoAngle * glm::length(x) * glm::length(y))
    return std::nullopt;
  return FieldError("to", "both sides of the angle go the same way: it is 0", "give a point in another direction");
}

std::vector<TypeDeclaration> annotation_types() {
  return {label_annotation(),
          point_annotation(),
          arrow_annotation(),
          frame_annotation(),
          axes_annotation(),
          angle_annotation(),
          leader_annotation(),
          balloon_annotation(),
          brace_annotation(),
          linear_dimension(),
          round_dimension("radius_dimension", "The radius of a circle, an arc, or a round surface."),
          round_dimension("diameter_dimension", "The diameter of a circle, an arc, or a round surface."),
          angle_dimension(),
          knots_annotation(),
          light_path(),
          cutting_plane(),
          detail_circle(),
          color_bar()};
}

}  // namespace lekalo::render
