// Vintoids: a plane curve L turns about the axis z while it moves, turns and grows in its own half plane (Grezdov,
// Filippenko 2010, "Vintoids"):
//
//   (X, Z) = (x_h, y_h)(u) + R(-a(u)) (s_x(u) x(v), s_y(u) y(v)),   r(u, v) = (c_x(u) X, c_y(u) X, Z),
//
// (x, y)(v) the points of L, distance from the axis and height, R(-a) the clockwise turn by a, c the unit circle, or a
// closed curve about the origin in its place, which makes stars and prisms. The normal r_u x r_v points outward where L
// runs counterclockwise and X > 0.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/composition.h"
#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/describe.h"
#include "geometry/expression/scalar_law.h"
#include "geometry/surfaces/named/vintoid_presets.h"

namespace lekalo::geometry {

namespace {

using Constants = std::vector<Expression::Constant>;

struct Vintoid {
  CurvePtr profile;
  CurvePtr around;  // null: the unit circle
  ScalarLaw distance, height, turn, scale_x, scale_y;

  template <class T>
  Triple<T> operator()(const T& u, const T& v) const {
    using std::cos;
    using std::sin;
    const Triple<T> p = curve_at(*profile, v);
    const T x = scale_x(u) * p.x, y = scale_y(u) * p.y, a = turn(u), c = cos(a), s = sin(a);
    const T far = distance(u) + c * x + s * y, high = height(u) - s * x + c * y;
    if (!around) return {far * cos(u), far * sin(u), high};
    const Triple<T> q = curve_at(*around, u);
    return {far * q.x, far * q.y, high};
  }
};

CurvePtr profile_of(const Fields& f, const VintoidPreset* preset, const Constants& constants) {
  if (f.has("of")) return f.curve("of");
  if (!preset) throw FieldError("of", "a vintoid turns a curve", "give 'of: CURVE', or a preset");
  const Interval domain(preset_value(preset->from, constants), preset_value(preset->until, constants));
  if (!(domain.width() > 0)) throw FieldError("a", "the size of the surface is not positive");
  const auto of_t = [&](std::string_view text) { return formula_of(std::string(text), {"t"}, constants); };
  return std::make_shared<FormulaCurve>(
      PointFormulas({of_t(preset->x), of_t(preset->y), of_t("0")}, Coordinates::cartesian, {"t"}), domain,
      preset->is_profile_closed);
}

Interval range_of(const Fields& f, const VintoidPreset* preset, const Constants& constants) {
  const double to = preset ? preset_value(preset->to, constants) : kTwoPi;
  if (!f.has("range") && !(to > 0)) throw FieldError("range", "the surface makes no turn", "give positive turns");
  return f.has("range") ? f.range("range") : Interval(0, to);
}

std::any vintoid(const Fields& f) {
  const VintoidPreset* preset = chosen_preset(f, vintoid_presets());
  const Constants constants = preset_constants(f, preset, vintoid_presets());
  const Interval range = range_of(f, preset, constants);
  CurvePtr around;
  if (f.has("around")) {
    if (!f.curve("around")->is_closed())
      throw FieldError("around", "the curve in place of the circle is not closed", "close it");
    if (range.lo != 0 || std::abs(range.hi - kTwoPi) > 1e-12)
      throw FieldError("around", "with a curve in place of the circle there is one turn", "leave out range and turns");
    around = with_domain(f.curve("around"), range);
  }
  const auto law = [&](const char* field, std::string_view of_preset, const char* otherwise) {
    if (f.has(field)) return ScalarLaw(f.get<Expression>(field));
    return ScalarLaw(formula_of(preset ? std::string(of_preset) : otherwise, {"u"}, constants));
  };
  const auto scale = [&](bool along_y) {
    if (!f.has("scale")) return law("scale", preset ? (along_y ? preset->scale_y : preset->scale_x) : "", "1");
    const auto& given = f.get<std::vector<Expression>>("scale");
    return ScalarLaw(along_y ? given.back() : given.front());
  };
  const CurvePtr profile = profile_of(f, preset, constants);
  Vintoid formula{profile,
                  around,
                  law("distance", preset ? preset->distance : "", "0"),
                  law("height", preset ? preset->height : "", "0"),
                  law("turn", preset ? preset->turn : "", "0"),
                  scale(false),
                  scale(true)};
  SurfaceProperties properties;
  properties.domain = {range, profile->domain()};
  properties.periods.v = profile->period();
  properties.breaks_u = {range.lo, range.hi};
  properties.breaks_v = {properties.domain.v.lo, properties.domain.v.hi};
  add_operand(properties, *profile, Along::v);
  if (around) add_operand(properties, *around, Along::u);
  auto surface = std::make_shared<ComposedSurface<Vintoid>>(formula, properties);
  if (is_closed_along(*surface, Along::u)) {
    properties.periods.u = range.width();
    surface = std::make_shared<ComposedSurface<Vintoid>>(std::move(formula), std::move(properties));
  }
  return std::any(SurfacePtr(surface));
}

}  // namespace

TypeDeclaration vintoid_type() {
  TypeDeclaration type = declare(
      Category::surface, "vintoid",
      fmt::format("Surface of a plane curve that turns about the axis z while it moves, turns and grows in its half "
                  "plane; u is the angle, v the curve's parameter. Presets, and their parameters when left out: {}.",
                  list_of_presets(vintoid_presets())));
  type.optional("preset", choice(preset_names(vintoid_presets())),
                "gives curve, laws and range, as far as they are not given");
  for (const std::string& name : parameter_names(vintoid_presets()))
    type.optional(name, number(), "of those presets that have it");
  return type.optional("of", reference({Category::curve}), "the curve: x is the distance from the axis, y the height")
      .optional("distance", formula({"u"}), "by which it moves away from the axis, as a formula of u")
      .optional("height", formula({"u"}), "by which it rises, as a formula of u")
      .optional("turn", angle_formula({"u"}), "by which it turns clockwise in its plane, as a formula of u")
      .optional("scale", formulas({"u"}, 1, 2), "of its x and y, as a formula of u, or one for each")
      .optional("range", range(), "of u, in radians; one turn when left out")
      .optional("around", reference({Category::curve}),
                "a closed curve about the origin in place of the unit circle, in x and y; one turn of it is u in 0..2 "
                "pi")
      .example("preset: knot")
      .built_by(vintoid);
}

}  // namespace lekalo::geometry
