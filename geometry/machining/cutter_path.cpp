// The path of a cutter whose corner touches a surface along a line of it (Zavyalov, Leus, Skorospelov 1985, V.1): three
// axes with a fixed axis, five with one that leans by an angle. The formulas are in geometry/machining/cutter_place.h.
#include <fmt/format.h>

#include <cmath>

#include "geometry/curves/operations/surface_curve.h"
#include "geometry/machining/contact_fields.h"
#include "geometry/machining/strip.h"

namespace lekalo::geometry {

TypeDeclaration parameter_line_type();
TypeDeclaration surface_curve_type();

namespace {

// The line on the surface, read as by the types of such curves.
CurvePtr line_on_surface(const Fields& f) {
  static const TypeDeclaration parameter_line = parameter_line_type(), surface_curve = surface_curve_type();
  if (!f.has("image")) return std::any_cast<CurvePtr>(parameter_line.build(f));
  for (const char* field : {"u", "v", "range"})
    if (f.has(field)) throw FieldError(field, "the line is given by its image", "leave out 'image', or this");
  const CurvePtr line = std::any_cast<CurvePtr>(surface_curve.build(f));
  const Box3 box = bounds(*f.curve("image"));
  const Rectangle domain = f.surface("of")->domain();
  const auto leaves = [](const Interval& range, double lo, double hi) {
    const double room = 1e-9 * range.width();
    return lo < range.lo - room || hi > range.hi + room;
  };
  if (leaves(domain.u, box.lo.x, box.hi.x) || leaves(domain.v, box.lo.y, box.hi.y))
    throw FieldError("image", "the image goes on beyond the surface's domain", "parts of it, each inside");
  return line;
}

SurfaceContact contact_along(const Fields& f) {
  SurfaceContact contact = read_contact(f);
  if (f.has("image")) {
    contact.line.image = f.curve("image");
  } else {
    contact.line.held = f.has("u") ? IsoDirection::u : IsoDirection::v;
    contact.line.at = f.number(f.has("u") ? "u" : "v");
  }
  return contact;
}

PathPoint point_of(const std::string& word) {
  return word == "contact" ? PathPoint::contact : word == "center" ? PathPoint::center : PathPoint::reference;
}

// The line in the parameter plane.
struct ImageOfLine {
  LineOfSurface line;

  template <class T>
  Triple<T> operator()(const T& t) const {
    const auto place = line(t);
    return {place.u, place.v, T(0)};
  }
};

CurvePtr image_of(const SurfaceContact& contact, const Curve& line) {
  if (contact.line.image) return contact.line.image;
  CurveProperties properties;
  properties.domain = line.domain();
  properties.breaks = properties_of(line).breaks;
  return std::make_shared<ComposedCurve<ImageOfLine>>(ImageOfLine{contact.line}, properties);
}

ToolPathFacts facts_of(const SurfaceContact& contact, const Interval& range, double height) {
  ToolPathFacts facts;
  facts.part = contact.line.of;
  const StripReport report = strip_report(contact, range, height);
  facts.bend = {report.min_difference, report.u, report.v};
  if (height > 0 && std::isfinite(report.max_width))
    facts.strip = {height, report.min_width, report.max_width, report.min_band, report.max_band};
  return facts;
}

ToolPath cutter_path(const Fields& f) {
  const CurvePtr line = line_on_surface(f);
  const SurfaceContact contact = contact_along(f);
  const ToolMove move = contact_move(contact, *line, ToolMove::Kind::cut, point_of(f.text("point")));
  const double height = f.has("scallop") ? f.number("scallop") : 0;
  const ToolPathFacts facts = facts_of(contact, line->domain(), height);
  check_gouging(f, *facts.bend);
  ToolPath path(contact.cutter, {move}, std::nullopt, facts);
  if (facts.strip) path.set_bands({band_of(contact, image_of(contact, *line), height)});
  return path;
}

}  // namespace

TypeDeclaration cutter_path_type() {
  TypeDeclaration type = declare(Category::curve, "cutter_path",
                                 "Path of a milling cutter whose corner touches a surface along a line of it. Its "
                                 "parameter is the line's.");
  type.example(
          "of: { type: sphere_surface, radius: 4, domain: { u: [0, 2], v: [0.3, 1.2] } }, v: 0.7, cutter: { radius: 1, "
          "corner_radius: 0.3, length: 3 }")
      .field("of", reference({Category::surface}), "the surface; with a normal all along the line")
      .optional("u", number(), "where u is held; the line's parameter is v")
      .optional("v", number(), "where v is held; the line's parameter is u")
      .optional("range", range(), "of the parameter of such a line; the surface's domain if it is left out")
      .optional("image", reference({Category::curve}),
                "the line as a curve of the parameter plane, in place of u or v; inside of the domain");
  declare_contact(type);
  return type
      .field("point", choice({"reference", "contact", "center"}),
             "what follows the path: the middle of the cutter's end, the point that touches, the middle of the ball or "
             "of the circle of corner centers",
             "reference")
      .optional("scallop", length().positive(), "height for which 'lekalo measure' tells the width of the strip")
      .shows({"cutters", "tool_axes", "contacts", "tool_moves"})
      .built_by(cutter_path);
}

}  // namespace lekalo::geometry
