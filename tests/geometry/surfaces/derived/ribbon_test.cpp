// Ribbons: the general checks of surfaces, their directions by closed forms, and lines against those of them that are
// parts of other surfaces.
#include "geometry/surfaces/derived/ribbon.h"

#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/formula_curve.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/describe.h"
#include "geometry/queries/rays/line_intersections.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/surface_checks.h"
#include "support/tier.h"

namespace lekalo::geometry::ribbon_test {
namespace {

constexpr double kRadius = 2, kPitch = 0.5;  // of a helix: rise for each radian

CurvePtr helix(double turns = 3) {
  return std::make_shared<FormulaCurve>(
      point_formulas({"2*cos(t)", "2*sin(t)", "0.5*t"}, {"t"}, Coordinates::cartesian), Interval(0, turns * kTwoPi),
      false);
}
CurvePtr knot() {
  return std::make_shared<FormulaCurve>(
      point_formulas({"sin(t) + 2*sin(2*t)", "cos(t) - 2*cos(2*t)", "-sin(3*t)"}, {"t"}, Coordinates::cartesian),
      Interval(0, kTwoPi), true);
}
CurvePtr cubic() {
  const std::vector<Vec3> points{{-1, -1, -1}, {1, -1, 0}, {1, 1, 0.5}, {-1, 1, 1}};
  return std::make_shared<NurbsCurve>(bezier_curve(points));
}

// w(u) = r_v and its derivatives.
CurveJet direction(const Ribbon& ribbon, double u, int order) {
  const SurfaceJet jet = ribbon.evaluate(u, 0, order + 1);
  CurveJet w;
  w.order = order;
  for (int k = 0; k <= order; ++k) w.d[k] = jet.d(k, 1);
  return w;
}

TEST(Ribbon, MeetsTheGeneralChecks) {
  for (const CurvePtr& curve : {helix(), knot(), cubic()})
    for (const FrameKind kind : {FrameKind::rotation_minimizing, FrameKind::normal, FrameKind::binormal}) {
      const Ribbon ribbon(curve, 0.6, {kind});
      // In steps that suit the windings; those of the third order would show that the parts of w agree to 1e-13 only.
      for (const double begin : {0.0, 0.3, 0.8}) {
        Rectangle part = ribbon.domain();
        part.u = {part.u.lo + begin * part.u.width(), part.u.lo + (begin + 0.2) * part.u.width()};
        checks::check_differences(ribbon, part, 2);
      }
      checks::check_normals(ribbon, ribbon.domain());
      checks::check_enclosures(ribbon, ribbon.domain());
      checks::check_pieces(ribbon);
    }
}

TEST(Ribbon, IsAsWideAsSaidAndAcrossTheCurve) {
  for (const CurvePtr& curve : {helix(), knot(), cubic()})
    for (const FrameLaw& law : {FrameLaw{}, FrameLaw{.twist = 2}, FrameLaw{FrameKind::normal},
                                FrameLaw{FrameKind::binormal}, FrameLaw{FrameKind::fixed, {1, 2, 9}}}) {
      if (law.kind == FrameKind::fixed && curve->is_closed()) continue;
      const Ribbon ribbon(curve, 0.6, law);
      const Interval t = curve->domain();
      for (int i = 0; i <= 100; ++i) {
        const double u = t.lo + t.width() * i / 100;
        const CurveJet at = curve->evaluate(u, 1);
        const Vec3 w = direction(ribbon, u, 0).d[0];
        EXPECT_NEAR(glm::length(w), 1, 2e-13);
        EXPECT_NEAR(glm::dot(w, at.d[1]), 0, 1e-12 * glm::length(at.d[1]));
        EXPECT_LE(glm::length(ribbon.point(u, 0) - at.d[0]), 1e-15);
      }
    }
}

// w' has no part across the tangent but that of the twist.
TEST(Ribbon, TurnsNoMoreThanItMust) {
  for (const CurvePtr& curve : {helix(), cubic()}) {
    const Ribbon ribbon(curve, 1, {});
    const Interval t = curve->domain();
    for (int i = 1; i < 100; ++i) {
      const double u = t.lo + t.width() * i / 100;
      const CurveJet w = direction(ribbon, u, 1);
      const Vec3 tangent = glm::normalize(curve->evaluate(u, 1).d[1]);
      EXPECT_NEAR(glm::dot(glm::cross(tangent, w.d[0]), w.d[1]), 0, 1e-10);
    }
  }
}

// Against the normal of a helix of torsion tau it turns by -tau for each length: tau L = turns 2 pi c / sqrt(r^2 +
// c^2).
TEST(Ribbon, OnAHelixItTurnsByTheTorsion) {
  const double turns = 3;
  const Ribbon ribbon(helix(turns), 1, {.start = {-1, 0, 0}});  // the normal where the curve begins
  const double angle = turns * kTwoPi * kPitch / std::hypot(kRadius, kPitch);
  const double end = turns * kTwoPi;
  const Vec3 tangent = glm::normalize(Vec3(0, kRadius, kPitch)), normal(-1, 0, 0);
  const Vec3 expected = std::cos(angle) * normal - std::sin(angle) * glm::cross(tangent, normal);
  EXPECT_LE(glm::length(direction(ribbon, end, 0).d[0] - expected), 1e-11);
}

TEST(Ribbon, ClosesWithItsCurve) {
  const Ribbon closed(knot(), 1, {}), turned(knot(), 1, {.twist = kPi});
  EXPECT_LE(glm::length(direction(closed, 0, 0).d[0] - direction(closed, kTwoPi, 0).d[0]), 1e-11);
  EXPECT_LE(glm::length(direction(turned, 0, 0).d[0] + direction(turned, kTwoPi, 0).d[0]), 1e-11);
}

TEST(Ribbon, NormalsAreThoseOfTheCurve) {
  const Ribbon normal(helix(), 1, {FrameKind::normal}), binormal(helix(), 1, {FrameKind::binormal});
  for (const double t : {0.0, 1.0, 7.3}) {
    const Vec3 n(-std::cos(t), -std::sin(t), 0);
    const Vec3 tangent = Vec3(-kRadius * std::sin(t), kRadius * std::cos(t), kPitch) / std::hypot(kRadius, kPitch);
    EXPECT_LE(glm::length(direction(normal, t, 0).d[0] - n), 1e-12);
    EXPECT_LE(glm::length(direction(binormal, t, 0).d[0] - glm::cross(tangent, n)), 1e-12);
  }
}

// A circle of latitude on a sphere, and a helix on its cylinder: the ribbon's normal is that of the surface.
TEST(Ribbon, LiesFlatOnASurface) {
  Frame raised;
  raised.origin.z = 3 * std::sin(0.6);
  const auto circle = std::make_shared<Circle>(raised, 3 * std::cos(0.6));
  const Ribbon on_sphere(circle, 0.4,
                         {.kind = FrameKind::on_surface, .on = std::make_shared<SphereSurface>(Frame(), 3)});
  const Ribbon on_cylinder(helix(), 0.4,
                           {.kind = FrameKind::on_surface, .on = std::make_shared<CylinderSurface>(Frame(), 2, 12)});
  for (const double u : {0.0, 0.7, 2.9, 6.2}) {
    EXPECT_LE(glm::length(on_sphere.normal(u, 0) - glm::normalize(circle->point(u))), 1e-12);
    EXPECT_LE(glm::length(on_cylinder.normal(u, 0) - Vec3(std::cos(u), std::sin(u), 0)), 1e-12);
  }
  checks::check_enclosures(on_sphere, on_sphere.domain());
}

// About a circle, along its axis: a cylinder.
TEST(Ribbon, LinesMeetThoseOfACircleWhereClosedFormsSay) {
  const auto circle = std::make_shared<Circle>(Frame(), 2);
  Frame below;
  below.origin.z = -0.4;
  const CylinderSurface cylinder(below, 2, 0.8);
  const LineIntersector ribbon(std::make_shared<Ribbon>(circle, 0.8, FrameLaw{FrameKind::fixed, {0, 0, 1}}));
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  int hits = 0;
  const int count = static_cast<int>(tests::tier_count(30000));
  for (int i = 0; i < count; ++i) {
    const Vec3 direction = checks::random_direction(random);
    const Line line{Vec3(2.2 * unit(random), 2.2 * unit(random), 0.5 * unit(random)) - 5.0 * direction, direction};
    LineHits expected;
    cylinder.line_hits(line, Interval::entire(), expected);
    std::vector<double> t;
    for (int k = 0; k < expected.size(); ++k) t.push_back(expected[k].t);
    std::sort(t.begin(), t.end());
    const auto found = ribbon.all_hits(line);
    ASSERT_EQ(found.size(), t.size()) << i;
    for (size_t k = 0; k < t.size(); ++k) EXPECT_NEAR(found[k].t, t[k], 1e-11);
    hits += static_cast<int>(t.size());
  }
  EXPECT_GT(hits, count / 3);
}

TEST(Ribbon, RefusesCurvesWithoutDirections) {
  const auto field_of = [](const CurvePtr& curve, double width, const FrameLaw& direction) -> std::string {
    try {
      Ribbon(curve, width, direction);
    } catch (const FieldError& error) {
      return error.field + ": " + error.what();
    }
    return "";
  };
  const auto segment = std::make_shared<Segment>(Vec3(0), Vec3(0, 0, 2));
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  const auto wave = std::make_shared<FormulaCurve>(point_formulas({"t", "t^3", "0"}, {"t"}, Coordinates::cartesian),
                                                   Interval(-1, 1), false);
  const auto cusp = std::make_shared<FormulaCurve>(point_formulas({"t^2", "t^3", "0"}, {"t"}, Coordinates::cartesian),
                                                   Interval(0, 1), false);
  EXPECT_EQ(field_of(segment, 1, {}), "");
  EXPECT_EQ(field_of(segment, 0, {}).substr(0, 6), "width:");
  EXPECT_EQ(field_of(segment, 1, {FrameKind::normal}).substr(0, 50),
            "across: the curve is straight and has no normal at");
  EXPECT_EQ(field_of(segment, 1, {FrameKind::fixed, {0, 0, 1}}).substr(0, 46),
            "across: the curve runs along this direction at");
  // A circle in the plane of the direction runs along it where its tangent, (-sin t, cos t), is (1, 0.3) or against it.
  EXPECT_EQ(field_of(std::make_shared<Circle>(Frame(), 1), 1, {FrameKind::fixed, {1, 0.3, 0}}),
            "across: the curve runs along this direction at t = 1.86225");
  EXPECT_EQ(field_of(std::make_shared<NurbsCurve>(polyline(corners)), 1, {}), "of: the curve has a corner at t = 1");
  EXPECT_EQ(field_of(wave, 1, {FrameKind::normal}), "across: the curve's normal jumps at t = 0");
  EXPECT_EQ(field_of(wave, 1, {}), "");
  EXPECT_EQ(field_of(segment, 1, {.kind = FrameKind::on_surface, .on = std::make_shared<SphereSurface>(Frame(), 3)})
                .substr(0, 41),
            "on: the curve does not lie on the surface");
  EXPECT_EQ(field_of(cusp, 1, {}), "of: the curve rests at t = 0");
}

}  // namespace
}  // namespace lekalo::geometry::ribbon_test
