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

#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/describe.h"
#include "geometry/expression/scalar_law.h"
#include "geometry/surfaces/named/vintoid_presets.h"
#include "geometry/surfaces/swept/moved_sections.h"
#include "geometry/transformed.h"

namespace lekalo::geometry {

namespace {

using Constants = std::vector<Expression::Constant>;

struct Laws {
  CurvePtr around;  // null: the unit circle
  ScalarLaw distance, height, turn, scale_x, scale_y;
};

// Of the sum of three products that a vintoid is: what x(v) (k = 0), y(v) (1) and 1 (2) are multiplied by.
struct VintoidAxis {
  Laws laws;
  int k;

  template <class T>
  Triple<T> operator()(const T& u) const {
    using std::cos;
    using std::sin;
    if (k == 2) return placed(u, laws.distance(u), laws.height(u));
    const T a = laws.turn(u), c = cos(a), s = sin(a), scale = k == 0 ? laws.scale_x(u) : laws.scale_y(u);
    return k == 0 ? placed(u, scale * c, -(scale * s)) : placed(u, scale * s, scale * c);
  }

 private:
  template <class T>
  Triple<T> placed(const T& u, const T& far, const T& high) const {
    using std::cos;
    using std::sin;
    if (!laws.around) return {far * cos(u), far * sin(u), high};
    const Triple<T> q = curve_at(*laws.around, u);
    return {far * q.x, far * q.y, high};
  }
};

CurvePtr axis_of(const Laws& laws, const Interval& range, int k) {
  CurveProperties properties;
  properties.domain = range;
  properties.breaks = {range.lo, range.hi};
  if (laws.around) add_operand(properties, *laws.around);
  return std::make_shared<ComposedCurve<VintoidAxis>>(VintoidAxis{laws, k}, properties);
}

// Without a z.
CurvePtr flat(const CurvePtr& curve) { return transformed(curve, Affine::scaling({1, 1, 0})); }

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
  const Laws laws{around,
                  law("distance", preset ? preset->distance : "", "0"),
                  law("height", preset ? preset->height : "", "0"),
                  law("turn", preset ? preset->turn : "", "0"),
                  scale(false),
                  scale(true)};
  const CurvePtr base = axis_of(laws, range, 2);
  BooleanSum sum;
  sum.along_u = moved_sections(base, {axis_of(laws, range, 0), axis_of(laws, range, 1), base}, {{flat(profile)}, {}});
  const Rectangle domain{range, profile->domain()};
  auto surface = std::make_shared<BlendedSurface>(blended_surface(std::move(sum), domain, {0, profile->period()}));
  if (is_closed_along(*surface, Along::u)) surface->close(Along::u, range.width());
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
