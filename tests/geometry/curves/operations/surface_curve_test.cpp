// Curves on surfaces against their formulas with the parameters put in (113 bits), over seams and knots, and the types
// of scene files that build them.
#include "geometry/curves/operations/surface_curve.h"

#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/curve_checks.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/describe.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/surfaces/swept/extrusion.h"

namespace lekalo::geometry {

TypeDeclaration surface_curve_type();
TypeDeclaration parameter_line_type();
TypeDeclaration geodesic_curve_type();
TypeDeclaration curvature_line_type();

}  // namespace lekalo::geometry

namespace lekalo::geometry::surface_curve_test {

namespace {

using checks::distance;
using Values = std::vector<std::pair<std::string, std::any>>;

CurvePtr built(const TypeDeclaration& type, const Values& values) {
  Fields fields;
  for (const auto& [name, value] : values) fields.set(name, value);
  return std::any_cast<CurvePtr>(type.build(fields));
}

std::string refusal(const TypeDeclaration& type, const Values& values) {
  try {
    built(type, values);
  } catch (const FieldError& error) {
    return error.field + ": " + error.what();
  }
  return "none";
}

CurvePtr plane_curve(const std::string& u, const std::string& v, const Interval& t, bool closed = false) {
  return std::make_shared<FormulaCurve>(point_formulas({u, v, "0"}, {"t"}), t, closed);
}

const SurfacePtr kTorus = std::make_shared<TorusSurface>(Frame{}, 3, 1);

TEST(SurfaceCurve, DerivativesEqualThoseOfTheFormulaIn113Bits) {
  const SurfaceCurve curve(kTorus, plane_curve("1 + 0.3*t + 0.2*t^2", "sin(2*t) - t^3/5", {-1, 1}));
  const auto formula = [](auto t) {
    const auto u = Quad(1) + Quad(0.3) * t + Quad(0.2) * t * t, v = sin(Quad(2) * t) - t * t * t / Quad(5);
    const auto ring = Quad(3) + cos(v);
    return Triple<decltype(u)>{ring * cos(u), ring * sin(u), sin(v)};
  };
  for (double t = -1; t <= 1; t += 0.05) {
    const auto exact = formula(Jet<Quad, 4>::variable(Quad(t)));
    const CurveJet jet = curve.evaluate(t, 4);
    for (int k = 0; k <= 4; ++k) {
      const Vec3 d(static_cast<double>(exact.x.derivative(k)), static_cast<double>(exact.y.derivative(k)),
                   static_cast<double>(exact.z.derivative(k)));
      EXPECT_LE(distance(jet.d[k], d), 3e-14 * std::max(4.0, glm::length(d))) << k << " at " << t;
    }
  }
  EXPECT_THROW(curve.evaluate(0, 5), std::invalid_argument);
}

// Golovanov 2016, (4.6.2) to (4.6.4), with the numbers of the check there: an arc on a sphere.
TEST(SurfaceCurve, MeetsTheGeneralChecks) {
  const auto ball = std::make_shared<SphereSurface>(Frame{}, 2);
  const SurfaceCurve loop(ball, plane_curve("3 + cos(t)", "0.8*sin(t)", {0, kTwoPi}, true));
  const SurfaceCurve open(kTorus, plane_curve("t", "2*t", {-1, 2}));
  for (const SurfaceCurve* curve : {&loop, &open}) {
    checks::check_differences(*curve, curve->domain());
    checks::check_enclosures(*curve, curve->domain());
    checks::check_pieces(*curve);
    checks::check_period(*curve);
  }
  EXPECT_TRUE(loop.is_closed());
}

TEST(SurfaceCurve, GoesOnOverSeams) {
  // Twice round the axis while three times round the tube.
  const SurfaceCurve knot(kTorus, std::make_shared<Segment>(Vec3(1, -2, 0), Vec3(1 + 2 * kTwoPi, -2 + 3 * kTwoPi, 0)));
  EXPECT_EQ(knot.period(), 1);
  EXPECT_TRUE(knot.is_closed());
  checks::check_enclosures(knot, knot.domain());
  checks::check_period(knot);
  for (double t = 0; t <= 1; t += 0.01) {
    const double u = 1 + 2 * kTwoPi * t, v = -2 + 3 * kTwoPi * t;
    EXPECT_LE(distance(knot.point(t), {(3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u), std::sin(v)}),
              1e-13);
  }
  const SurfaceCurve most(kTorus, std::make_shared<Segment>(Vec3(1, 0, 0), Vec3(1 + 0.9 * kTwoPi, 0, 0)));
  EXPECT_EQ(most.period(), 0);
  EXPECT_FALSE(most.is_closed());
}

TEST(SurfaceCurve, HasPiecesWhereDerivativesOfTheSurfaceJump) {
  const auto profile =
      std::make_shared<NurbsCurve>(polyline(std::vector<Vec3>{{0, 0, 0}, {1, 0, 1}, {2, 0, 0}, {4, 0, 1}}, false));
  const auto roof = std::make_shared<ExtrusionSurface>(profile, Vec3(0, 1, 0));
  const bool u_profile = roof->domain().u.width() == 3;
  const Vec3 from(0.5, 0.1, 0), to(2.5, 0.9, 0);
  const auto turned = [&](const Vec3& p) { return u_profile ? p : Vec3(p.y, p.x, 0); };
  const SurfaceCurve curve(roof, std::make_shared<Segment>(turned(from), turned(to)));
  const std::vector<CurvePiece> pieces = curve.pieces();
  ASSERT_EQ(pieces.size(), 3u);
  EXPECT_NEAR(pieces[0].domain.hi, 0.25, 1e-12);
  EXPECT_NEAR(pieces[1].domain.hi, 0.75, 1e-12);
  // A sphere's pieces join smoothly.
  const auto ball = std::make_shared<SphereSurface>(Frame{}, 2);
  EXPECT_EQ(SurfaceCurve(ball, std::make_shared<Segment>(Vec3(0.2, -1, 0), Vec3(6, 1, 0))).pieces().size(), 1u);
}

TEST(SurfaceCurveType, RefusesImagesThatLeaveTheSurface) {
  const SurfacePtr sheet = std::make_shared<Plane>(Frame{}, Rectangle{{0, 1}, {0, 1}});
  const CurvePtr across = std::make_shared<Segment>(Vec3(0.5, 0.5, 0), Vec3(1.5, 0.5, 0));
  EXPECT_EQ(refusal(surface_curve_type(), {{"of", sheet}, {"image", across}}),
            "image: the image leaves the surface at t = 0.505: u = 1.005 is outside of [0, 1]");
  const CurvePtr above = std::make_shared<Segment>(Vec3(0.5, 0.5, 0), Vec3(0.6, 0.5, 1));
  EXPECT_EQ(refusal(surface_curve_type(), {{"of", sheet}, {"image", above}}),
            "image: the image does not lie in the parameter plane");
  EXPECT_EQ(refusal(surface_curve_type(), {{"of", kTorus}, {"image", across}}), "none");
}

TEST(ParameterLineType, HoldsOneParameter) {
  const CurvePtr meridian = built(parameter_line_type(), {{"of", kTorus}, {"u", 0.5}});
  EXPECT_EQ(meridian->domain(), Interval(-kPi, kPi));
  EXPECT_TRUE(meridian->is_closed());
  const CurvePtr part = built(parameter_line_type(), {{"of", kTorus}, {"v", 1.0}, {"range", Interval(1, 2)}});
  EXPECT_EQ(part->domain(), Interval(1, 2));
  EXPECT_FALSE(part->is_closed());
  EXPECT_EQ(part->point(1.5), kTorus->point(1.5, 1));
  checks::check_enclosures(*part, part->domain());
  checks::check_pieces(*part);
  EXPECT_EQ(refusal(parameter_line_type(), {{"of", kTorus}}), "of: a parameter line holds one of u and v");
  EXPECT_EQ(refusal(parameter_line_type(), {{"of", kTorus}, {"u", 7.0}}), "u: the surface has u in [0, 6.28319]");
  EXPECT_EQ(refusal(parameter_line_type(), {{"of", kTorus}, {"v", 1.0}, {"range", Interval(1, 7)}}),
            "range: the surface's domain is [0, 6.28319]");
}

TEST(LineTypes, BuildTheLinesTheyDescribe) {
  using List = std::vector<double>;
  const CurvePtr line =
      built(geodesic_curve_type(), {{"of", kTorus}, {"from", List{0, 0}}, {"direction", 0.5 * kPi}, {"length", 3.0}});
  EXPECT_LE(distance(line->point(3), {3 + std::cos(3.0), 0, std::sin(3.0)}), 1e-13);
  const CurvePtr shortest = built(geodesic_curve_type(), {{"of", kTorus}, {"from", List{0, 0}}, {"to", List{0, 3}}});
  EXPECT_NEAR(shortest->domain().hi, 3, 1e-13);
  EXPECT_LE(dynamic_cast<const SurfaceCurve&>(*shortest).error(), 1e-12);
  EXPECT_EQ(refusal(geodesic_curve_type(), {{"of", kTorus}, {"from", List{0, 0}}}),
            "from: a geodesic has either a direction or an end");
  EXPECT_EQ(refusal(geodesic_curve_type(), {{"of", kTorus}, {"from", List{0, 0}}, {"direction", 1.0}}),
            "direction: the length of the geodesic is missing");
  EXPECT_EQ(refusal(geodesic_curve_type(), {{"of", kTorus}, {"from", List{0, 0}}, {"to", List{1, 1}}, {"length", 1.0}}),
            "length: a geodesic between two points has its own length");
  const CurvePtr round =
      built(curvature_line_type(), {{"of", kTorus}, {"through", List{0, 1}}, {"family", std::string("maximum")}});
  EXPECT_TRUE(round->is_closed());
  checks::check_period(*round);
}

}  // namespace
}  // namespace lekalo::geometry::surface_curve_test
