#include <gtest/gtest.h>

#include <map>
#include <set>

#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/operations/nurbs_of.h"
#include "geometry/describe.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"
#include "tests/geometry/curves/curve_checks.h"
#include "tests/geometry/surfaces/surface_checks.h"

namespace lekalo::geometry::named_curve_test {
namespace {

const TypeDeclaration& named() {
  for (const TypeDeclaration& type : geometry_types())
    if (type.name == "named_curve") return type;
  throw std::logic_error("no named_curve");
}

Fields fields_of(const std::string& preset, std::initializer_list<std::pair<std::string, double>> numbers = {}) {
  Fields fields;
  fields.set("preset", preset);
  for (const auto& [name, value] : numbers) fields.set(name, value);
  return fields;
}

CurvePtr built(const Fields& fields) { return std::any_cast<CurvePtr>(named().build(fields)); }

TEST(NamedCurve, every_preset_has_derivatives_and_enclosures) {
  const std::vector<std::string>& names = named().fields[0].type.choices;
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_GE(names.size(), 45u);
  // Roots at kinks: derivatives are no numbers there.
  const std::set<std::string> kinked{"lame_curve"};
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const CurvePtr curve = built(fields_of(name));
    EXPECT_NE(named().description.find(name), std::string::npos);
    const Interval domain = curve->domain();
    if (kinked.count(name)) continue;
    const double inset = name == "sinusoidal_spiral" ? 0.05 * domain.width() : 0;
    checks::check_differences(*curve, {domain.lo + inset, domain.hi - inset}, 3, 1e-6);
    checks::check_enclosures(*curve, {domain.lo + inset, domain.hi - inset});
  }
}

// Points of the exact form, at the parameters that its maps tell, are those of the formulas.
void check_rational(const CurvePtr& curve, int degree) {
  const auto& found = dynamic_cast<const FormulaCurve&>(*curve).rational();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->form.degree, degree);
  EXPECT_TRUE(nurbs_of(*curve, curve->domain(), 0).exact);
  double size = 0, farthest = 0;
  for (const CurvePiece& piece : bezier_pieces(found->form, found->form.domain())) {
    for (int k = 0; k <= 16; ++k) {
      const double t = piece.map.natural_of_bezier(k / 16.) / found->speed;
      std::vector<Vec4> p = piece.points;
      for (size_t n = p.size() - 1; n > 0; --n)
        for (size_t i = 0; i < n; ++i) p[i] = (1 - k / 16.) * p[i] + k / 16. * p[i + 1];
      size = std::max(size, glm::length(curve->point(t)));
      farthest = std::max(farthest, glm::length(Vec3(p[0]) / p[0].w - curve->point(t)));
    }
  }
  EXPECT_LE(farthest, 1e-13 * size);
}

// The degrees are those of the algebraic curves, or as many again where angles are the parameter: a cubic with a node
// has a rational cubic form, a cardioid a quartic one, a deltoid, an astroid, a nephroid twice their frequencies.
TEST(NamedCurve, rational_ones_are_nurbs_curves) {
  const std::map<std::string, int> degrees{{"witch_of_agnesi", 3},
                                           {"folium_of_descartes", 6},
                                           {"cissoid_of_diocles", 3},
                                           {"cubic_parabola", 3},
                                           {"trisectrix_of_maclaurin", 3},
                                           {"ophiuride", 3},
                                           {"semicubical_parabola", 3},
                                           {"strophoid", 3},
                                           {"trident", 3},
                                           {"lemniscate_of_bernoulli", 4},
                                           {"kappa", 4},
                                           {"cardioid", 4},
                                           {"conchoid_of_nicomedes", 4},
                                           {"limacon_of_pascal", 4},
                                           {"deltoid", 4},
                                           {"lissajous", 6},
                                           {"sinusoidal_spiral", 4},
                                           {"epicycloid", 8},
                                           {"epitrochoid", 8},
                                           {"hypocycloid", 8},
                                           {"hypotrochoid", 6},
                                           {"astroid", 6},
                                           {"nephroid", 6},
                                           {"rose", 4}};
  for (const std::string& name : named().fields[0].type.choices) {
    SCOPED_TRACE(name);
    const CurvePtr curve = built(fields_of(name));
    if (degrees.count(name)) {
      check_rational(curve, degrees.at(name));
      checks::check_pieces(*curve);
    } else {
      EXPECT_FALSE(dynamic_cast<const FormulaCurve&>(*curve).rational());
    }
  }
  check_rational(built(fields_of("rose", {{"p", 2}})), 6);
  check_rational(built(fields_of("rose", {{"p", 2}, {"q", 3}})), 10);
  check_rational(built(fields_of("sinusoidal_spiral", {{"m", 1. / 3}})), 6);
  check_rational(built(fields_of("cassini_oval", {{"a", 1.2}, {"c", 1.2}})), 4);
  check_rational(built(fields_of("trident", {{"a", 2}, {"b", -1}, {"c", 0.3}, {"d", -1}})), 3);
  EXPECT_FALSE(dynamic_cast<const FormulaCurve&>(*built(fields_of("sinusoidal_spiral", {{"m", 0.4}}))).rational());
}

// Surfaces of them are made of exact rational pieces, whose hits are those of the oracle.
TEST(NamedCurve, surfaces_of_rational_ones_meet_the_general_checks) {
  for (const char* name : {"strophoid", "lemniscate_of_bernoulli", "kappa", "lissajous", "limacon_of_pascal"}) {
    SCOPED_TRACE(name);
    const ExtrusionSurface wall(built(fields_of(name)), {0.3, 0.2, 2});
    EXPECT_TRUE(wall.as_nurbs());
    checks::check_surface(wall);
  }
  checks::check_surface(RevolutionSurface(built(fields_of("witch_of_agnesi")), {Vec3(0), {1, 0, 0}}, 2));
}

TEST(NamedCurve, wrong_parameters_are_told) {
  const auto message = [](const Fields& fields) -> std::string {
    try {
      built(fields);
    } catch (const FieldError& error) {
      return error.field + ": " + error.what() + " / " + error.hint;
    }
    return "";
  };
  EXPECT_EQ(message(fields_of("cycloid", {{"h", 1}})), "h: 'cycloid' has no parameter 'h' / it has a = 1");
  EXPECT_EQ(message(fields_of("cycloid", {{"a", 0}})), "a: the size of the curve is zero / ");
  EXPECT_EQ(message(fields_of("spiric_of_perseus", {{"p", 2}})).substr(0, 8), "preset: ");
  EXPECT_EQ(message(fields_of("epicycloid", {{"b", std::sqrt(2.0)}})),
            "domain: the curve never closes: b/a is no fraction of small numbers / give a domain of t");
}

}  // namespace
}  // namespace lekalo::geometry::named_curve_test
