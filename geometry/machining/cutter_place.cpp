#include "geometry/machining/cutter_place.h"

#include <fmt/format.h>

#include <cmath>

namespace lekalo::geometry {

namespace {

constexpr int kPlaces = 64;
// Sines of angles below this are 0; what is beyond a limit by this part lies on it.
constexpr double kNoAngle = 1e-9;

const char* field_of(const ToolAxis& axis) {
  return axis.kind == ToolAxis::Kind::fixed ? "axis" : axis.kind == ToolAxis::Kind::lead ? "lead" : "elevation";
}

template <class Check>
void at_places(const Interval& range, const Check& check) {
  for (int i = 0; i <= kPlaces; ++i) check(range.clamp(range.lo + range.width() * i / kPlaces));
}

double degrees(double angle) { return angle * 180 / kPi; }

}  // namespace

void declare_axis_of_tool(TypeDeclaration& type) {
  type.field("axis", direction(), "a fixed direction from the end to the spindle (three axes)", "z")
      .optional("lead", angle_formula({"t"}),
                "in place of a fixed axis (five axes): how far it leans from the normal along the path; a number, or a "
                "formula of the path's parameter")
      .optional("elevation", angle_formula({"t"}),
                "in place of a fixed axis (five axes): how far it stands up from the tangent plane, beside the path");
}

ToolAxis read_axis_of_tool(const Fields& f) {
  const bool leads = f.has("lead"), is_raised = f.has("elevation");
  if ((leads && is_raised) || ((leads || is_raised) && f.given("axis")))
    throw FieldError(leads ? "lead" : "elevation", "the axis is given in several ways",
                     "one of 'axis', 'lead' and 'elevation'");
  if (leads) return {ToolAxis::Kind::lead, Vec3(0), ScalarLaw(f.get<Expression>("lead"))};
  if (is_raised) return {ToolAxis::Kind::elevation, Vec3(0), ScalarLaw(f.get<Expression>("elevation"))};
  return {ToolAxis::Kind::fixed, f.vec3("axis"), ScalarLaw(0.0)};
}

void check_contact(const SurfaceContact& contact, const Interval& range) {
  const Cutter& cutter = contact.cutter;
  at_places(range, [&](double t) {
    const auto line = contact.line(t);
    const SurfaceJet jet = contact.line.of->evaluate(line.u, line.v, 1);
    const double area = glm::length(glm::cross(jet.du(), jet.dv()));
    if (!(area > 1e-12 * glm::length(jet.du()) * glm::length(jet.dv())))
      throw FieldError("of", fmt::format("the surface has no normal at u = {:.6g}, v = {:.6g}", line.u, line.v),
                       "a range without that place");
    if (!(glm::length(line.du * jet.du() + line.dv * jet.dv()) > 0))
      throw FieldError("of", fmt::format("the line rests at t = {:.6g}: the path has no direction there", t));
    const CutterPlace<double> place = contact.at(t);
    const Vec3 n = vec(place.normal), q = vec(place.axis);
    const double cosine = glm::dot(n, q), sine = glm::length(glm::cross(n, q));
    if (!cutter.has_ball_end() && sine < kNoAngle && cosine > 0)
      throw FieldError(
          field_of(contact.axis),
          fmt::format("the axis is along the normal at t = {:.6g}: the flat end touches at no one place", t),
          "a 'lead', another axis, or a ball end: the corner_radius as large as the radius");
    if (cosine < std::sin(cutter.angle) - kNoAngle)
      throw FieldError(
          field_of(contact.axis),
          fmt::format("at t = {:.6g} the axis is {:.6g} degrees from the normal: the corner ends at {:.6g}", t,
                      degrees(std::atan2(sine, cosine)), 90 - degrees(cutter.angle)),
          "another axis or side; where the flank cuts, a flank_path");
    if (!(cutter.ring_radius() + cutter.rounding() * sine > 0) && !cutter.has_ball_end())
      throw FieldError(field_of(contact.axis), fmt::format("at t = {:.6g} the cutter touches with its point", t),
                       "an axis that leans more");
  });
}

void check_contact(const FlankContact& contact, const Interval& range) {
  const Cutter& cutter = contact.cutter;
  const double c = std::cos(cutter.angle), low = cutter.flank_start().y / c, high = cutter.length / c;
  at_places(range, [&](double t) {
    const Vec3 way = contact.of->evaluate(t, 1).d[1], l = vec(contact.generatrix(t));
    const double speed = glm::length(way);
    if (!(speed > 0)) throw FieldError("of", fmt::format("the curve rests at t = {:.6g}", t));
    if (!(std::abs(glm::length(l) - 1) < 1e-6) || !(glm::length(glm::cross(l, way)) > kNoAngle * speed))
      throw FieldError(contact.directions ? "directions" : "direction",
                       fmt::format("the generatrix is along the curve, or nothing, at t = {:.6g}", t),
                       "a direction across the curve");
    if (contact.plane && !(std::abs(glm::dot(l, contact.plane->normal)) > kNoAngle))
      throw FieldError("plane", fmt::format("the generatrix is along the plane at t = {:.6g}", t));
    const CutterPlace<double> place = contact.at(t);
    const double h = contact.height_at(t, place.contact, place.normal, contact.generatrix(t)), room = 1e-9 * high;
    if (!(h >= low - room && h <= high + room))
      throw FieldError(contact.plane ? "plane" : "h",
                       fmt::format("at t = {:.6g} the curve is at {:.6g} of the flank, which is from {:.6g} to {:.6g}",
                                   t, h, low, high),
                       contact.plane ? "another plane, or a longer cutter" : "a height on the flank");
  });
}

}  // namespace lekalo::geometry
