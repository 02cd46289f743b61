#include "geometry/machining/contact_fields.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/machining/strip.h"

namespace lekalo::geometry {

namespace {

// Of the largest order that enclosures and derivatives of the surface and the line's image leave.
CurveProperties properties_on(const SurfaceContact& contact, const Curve& on) {
  CurveProperties properties = properties_of(on);
  // An axis that turns by a formula need not be back after a period.
  if (!contact.axis.angle.is_constant()) properties.period = 0;
  const Surface& surface = *contact.line.of;
  properties.max_order = std::min(kMaxSurfaceOrder, surface.max_order()) - 1;
  properties.enclosure_order = std::min(kMaxCurveEnclosureOrder, surface.enclosure_order()) - 1;
  if (const CurvePtr& image = contact.line.image) {
    properties.max_order = std::min(properties.max_order, image->max_order() - 1);
    properties.enclosure_order = std::min(properties.enclosure_order, image->enclosure_order() - 1);
  }
  return properties;
}

}  // namespace

FieldType cutter_field() { return group(cutter_fields()); }

void declare_contact(TypeDeclaration& type) {
  type.field("cutter", cutter_field(), "the milling cutter: radius, corner_radius, length, angle")
      .field("allowance", length(), "what is left on the surface", "0")
      .field("side", choice({"front", "back"}), "where the cutter is: on the side of the surface's normal, or opposite",
             "front")
      .field("gouging", choice({"refuse", "allow"}),
             "a cutter that is less curved than the part somewhere, and cuts into it: an error, or a number of "
             "'lekalo measure'",
             "refuse");
  declare_axis_of_tool(type);
}

SurfaceContact read_contact(const Fields& f) {
  SurfaceContact contact;
  contact.line.of = f.surface("of");
  contact.cutter = read_cutter(f.group("cutter"), "cutter.");
  contact.axis = read_axis_of_tool(f);
  contact.allowance = f.number("allowance");
  contact.side = contact.line.of->normal_sign() * (f.text("side") == "front" ? 1 : -1);
  return contact;
}

void check_gouging(const Fields& f, const ToolPathFacts::Bend& bend) {
  if (f.text("gouging") == "allow" || !(bend.min_difference < 0)) return;
  throw FieldError("cutter",
                   fmt::format("the cutter cuts into the part at u = {:.6g}, v = {:.6g}: there its curvature is {:.6g} "
                               "less than that of the surface",
                               bend.u, bend.v, -bend.min_difference),
                   "a smaller corner_radius or radius, the other side, or gouging: allow");
}

void check_joints(const Curve& on, const std::function<CutterPose(double)>& pose, const Cutter& cutter,
                  CurveProperties& properties) {
  const auto end = [&](double t) { return pose(t).reference; };
  const auto top = [&](double t) { return pose(t).reference + cutter.length * pose(t).axis; };
  check_jumps(on, properties.breaks, end);
  check_jumps(on, properties.breaks, top);
  if (properties.period > 0 && !(is_closed_path(on, end) && is_closed_path(on, top))) properties.period = 0;
}

CoverageBand band_of(const SurfaceContact& contact, const CurvePtr& image, double height) {
  return {image, [contact, height](double t) {
            const ContactBend bend = contact_bend(contact, t);
            return bend.width(height) * glm::length(bend.across);
          }};
}

ToolMove contact_move(const SurfaceContact& contact, const Curve& on, ToolMove::Kind kind, PathPoint point) {
  check_contact(contact, on.domain());
  const auto pose = [contact](double t) {
    const CutterPlace<double> place = contact.at(t);
    return CutterPose{vec(place.reference), vec(place.axis),
                      CutterPose::Contact{vec(place.contact), vec(place.normal)}};
  };
  CurveProperties properties = properties_on(contact, on);
  check_joints(on, pose, contact.cutter, properties);
  using Path = ContactPath<SurfaceContact>;
  return {kind, std::make_shared<ComposedCurve<Path>>(Path{contact, point}, properties), pose};
}

}  // namespace lekalo::geometry
