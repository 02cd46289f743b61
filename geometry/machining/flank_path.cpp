// The path of a cutter whose flank touches a curve along its generatrix (Zavyalov, Leus, Skorospelov 1985, V.1), as in
// milling round a contour. The formulas are in geometry/machining/cutter_place.h.
#include <fmt/format.h>

#include <cmath>

#include "geometry/machining/contact_fields.h"

namespace lekalo::geometry {

namespace {

// Where the axis runs through the curve it is the generatrix.
double side_of(const Fields& f, const Cutter& cutter) {
  const std::string& side = f.text("side");
  if (side != "on") return side == "left" ? 1 : -1;
  if (cutter.angle != 0)
    throw FieldError("side", "a conical flank has no place with its axis on the curve", "left or right");
  if (f.given("allowance")) throw FieldError("allowance", "the axis runs through the curve: nothing is left on it");
  return 0;
}

FlankContact read_flank(const Fields& f) {
  FlankContact contact;
  contact.of = f.curve("of");
  contact.cutter = read_cutter(f.group("cutter"), "cutter.");
  contact.side = side_of(f, contact.cutter);
  contact.allowance = f.number("allowance");
  if (f.has("directions") && f.given("direction"))
    throw FieldError("directions", "the generatrix is given twice", "'direction' or 'directions'");
  if (f.has("directions"))
    contact.directions = f.curve("directions");
  else
    contact.direction = f.vec3("direction");
  if (f.has("h") == f.has("plane"))
    throw FieldError(f.has("h") ? "plane" : "of", "the height of the contact on the flank is given by one of two",
                     "'h', or a 'plane' in which the middle of the end stays");
  if (f.has("h")) contact.height = ScalarLaw(f.get<Expression>("h"));
  if (f.has("plane")) contact.plane = {f.group("plane").vec3("through"), f.group("plane").vec3("normal")};
  return contact;
}

CurveProperties properties_along(const FlankContact& contact) {
  CurveProperties properties = properties_of(*contact.of, 1);
  if (!contact.height.is_constant() || contact.directions) properties.period = 0;
  if (contact.directions) {
    const Interval own = contact.directions->domain(), range = contact.of->domain();
    if (std::abs(own.lo - range.lo) + std::abs(own.hi - range.hi) > 1e-9 * range.width())
      throw FieldError("directions", "the curve of directions has another domain", "the same parameters as the curve");
    add_operand(properties, *contact.directions);
  }
  return properties;
}

// The middle of the circle that fits the flank across the generatrix where it touches.
struct MiddleOfFlank {
  FlankContact contact;

  template <class T>
  Triple<T> operator()(const T& t) const {
    const CutterPlace<T> place = contact.at(t);
    if (contact.side == 0) return place.contact;
    const Cutter& cutter = contact.cutter;
    const T h = contact.height_at(t, place.contact, place.normal, contact.generatrix(t));
    const T radius = T(1 / std::cos(cutter.angle)) * (T(cutter.flank_radius()) + T(std::sin(cutter.angle)) * h);
    return place.contact + (T(contact.allowance) + radius) * place.normal;
  }
};

void check_hollows(const FlankContact& contact) {
  const ComposedCurve<MiddleOfFlank> middle({contact}, properties_along(contact));
  const auto way = [&](double t) {
    const Vec3 l = vec(contact.generatrix(t)), along = contact.of->evaluate(t, 1).d[1];
    return along - glm::dot(along, l) * l;
  };
  if (const auto t = where_it_runs_back(middle, way))
    throw FieldError("cutter", fmt::format("at t = {:.6g} the curve is hollower than the cutter", *t),
                     "a smaller radius, or the other side");
}

ToolPath flank_path(const Fields& f) {
  const FlankContact contact = read_flank(f);
  const Interval range = contact.of->domain();
  if (!(range.width() < kInfinity)) throw FieldError("of", "the curve is unbounded", "give it a domain");
  check_contact(contact, range);
  const auto pose = [contact](double t) {
    const CutterPlace<double> place = contact.at(t);
    return CutterPose{vec(place.reference), vec(place.axis),
                      CutterPose::Contact{vec(place.contact), vec(place.normal)}};
  };
  CurveProperties properties = properties_along(contact);
  check_joints(*contact.of, pose, contact.cutter, properties);
  check_hollows(contact);
  using Path = ContactPath<FlankContact>;
  const ToolMove move{ToolMove::Kind::cut, std::make_shared<ComposedCurve<Path>>(Path{contact}, properties), pose};
  return ToolPath(contact.cutter, {move}, std::nullopt, {});
}

}  // namespace

TypeDeclaration flank_path_type() {
  return declare(Category::curve, "flank_path",
                 "Path of the middle of the end of a milling cutter whose flank touches a curve. Its parameter is the "
                 "curve's.")
      .example("of: { type: ellipse, semi_axes: [3, 2] }, cutter: { radius: 0.5, length: 2 }, side: right, h: 1")
      .field("of", reference({Category::curve}), "the curve")
      .field("cutter", cutter_field(), "the milling cutter: radius, corner_radius, length, angle")
      .field("direction", direction(), "of the flank's generatrix that touches, from the end to the top", "z")
      .optional("directions", reference({Category::curve}),
                "in place of one direction: a curve over the same parameters whose points are the directions")
      .field("side", choice({"left", "right", "on"}),
             "where the cutter is as one goes along the curve, seen against the generatrix; on: its axis is on the "
             "curve",
             "left")
      .field("allowance", length(), "what is left on the part", "0")
      .optional("h", formula({"t"}),
                "where the curve touches, along the generatrix from the end; a number, or a formula of the parameter")
      .optional("plane",
                group({{"through", point(), "a point of it", false, "[0, 0, 0]"},
                       {"normal", direction(), "its normal", false, "z"}}),
                "in which the middle of the end stays, in place of h")
      .shows({"cutters", "tool_axes", "contacts", "tool_moves"})
      .built_by(flank_path);
}

}  // namespace lekalo::geometry
