// Curves built on curves (Golovanov 2016, 2.15, 2.16) against their definitions, evaluated on the base curve.
#include <random>

#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/derived/composite_curve.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/derived/transition_curve.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/describe.h"
#include "geometry/queries/differential/curvature.h"
#include "geometry/queries/measures/mass_properties.h"
#include "tests/geometry/curves/curve_checks.h"

namespace lekalo::geometry {
namespace {

CurvePtr oval() { return std::make_shared<Ellipse>(Frame{}, 3, 2, Interval(0, kTwoPi)); }

CurvePtr spline() {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 2, 1}, {3, 2, -1}, {4, 0, 0}, {6, 1, 2}};
  const std::vector<double> weights{1, 2, 0.5, 1, 1};
  return std::make_shared<NurbsCurve>(SplineAxis(3, {0, 0, 0, 0, 0.4, 1, 1, 1, 1}, Extension::tangent), points,
                                      weights);
}

// r(w) against base(t(w)), t = begin + slope w, derivatives slope^k.
void check_affine(const Curve& curve, const Curve& base, double begin, double slope) {
  const Interval domain = curve.domain();
  for (int i = 0; i <= 50; ++i) {
    const double w = domain.lo + domain.width() * (i + 0.3) / 50.7;
    const CurveJet found = curve.evaluate(w, 4), expected = base.evaluate(begin + slope * (w - domain.lo), 4);
    double power = 1;
    for (int k = 0; k <= 4; ++k, power *= slope) {
      ASSERT_LE(glm::length(found.d[k] - power * expected.d[k]),
                1e-12 * (1 + glm::length(expected.d[k]) * std::abs(power)))
          << k << " at " << w;
    }
  }
  checks::check_enclosures(curve, domain);
}

TEST(DerivedCurves, Reversed) {
  for (const CurvePtr& base : {oval(), spline()}) {
    const CurvePtr curve = reversed_curve(base);
    check_affine(*curve, *base, base->domain().hi, -1);
    checks::check_nurbs(*curve);
    checks::check_pieces(*curve);
  }
}

TEST(DerivedCurves, OverAnotherDomain) {
  const CurvePtr curve = with_domain(spline(), {2, 5});
  check_affine(*curve, *spline(), 0, 1.0 / 3);
  checks::check_nurbs(*curve);
}

TEST(DerivedCurves, TrimmedOverTheSeam) {
  const CurvePtr curve = trimmed_curve(oval(), 5, 1, false);
  EXPECT_NEAR(curve->domain().width(), 2.28318530717959, 1e-14);
  for (const double w : {0.1, 1.2, 1.3, 2.2}) {
    EXPECT_LE(glm::length(curve->point(w) - oval()->point(5 + w)), 1e-14);
  }
  const CurvePtr back = trimmed_curve(oval(), 1, 5, true);
  for (const double w : {0.1, 0.9, 1.1, 2.2}) {
    EXPECT_LE(glm::length(back->point(w) - oval()->point(1 - w)), 1e-14);
  }
  const CurvePtr seam = trimmed_curve(oval(), 2, 2, false);
  EXPECT_TRUE(seam->is_closed());
  EXPECT_DOUBLE_EQ(seam->period(), kTwoPi);
  EXPECT_LE(glm::length(seam->point(kTwoPi + 0.5) - oval()->point(2.5)), 1e-14);
}

TEST(DerivedCurves, ByArcLength) {
  for (const CurvePtr& base : {oval(), spline()}) {
    const CurvePtr curve = by_arc_length(base);
    const double length = curve->domain().hi;
    EXPECT_NEAR(length, arc_length(*base, base->domain().lo, base->domain().hi).value, 1e-12 * length);
    for (int i = 0; i <= 20; ++i) {
      EXPECT_NEAR(glm::length(curve->evaluate(length * i / 20, 1).d[1]), 1, 1e-10);
    }
    for (const double share : {0.21, 0.5, 0.83}) {
      const double s = share * length;
      const CurvePtr part = trimmed_curve(curve, 0, s, false);
      EXPECT_NEAR(arc_length(*part, part->domain().lo, part->domain().hi).value, s, 1e-12 * length);
    }
    checks::check_enclosures(*curve, curve->domain());
  }
}

TEST(DerivedCurves, Composite) {
  const auto line = std::make_shared<Segment>(Vec3(0, 0, 0), Vec3(1, 0, 0));
  const auto arc =
      std::make_shared<Ellipse>(Frame{{1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1, 1, Interval(-kTwoPi / 4, 0));
  // The arc turned round, and again by the composite.
  const CompositeCurve curve(turned_to_follow({line, reversed_curve(arc)}, 1e-7), false, 1e-7);
  EXPECT_NEAR(curve.domain().hi, 1 + kTwoPi / 4, 1e-15);
  EXPECT_LE(glm::length(curve.evaluate(1, 2).d[2] - Vec3(0, 1, 0)), 1e-14);  // of the second segment
  EXPECT_LE(glm::length(curve.point(curve.domain().hi) - Vec3(2, 1, 0)), 1e-15);
  checks::check_nurbs(curve);
  checks::check_pieces(curve);
  checks::check_enclosures(curve, {0, 1});
  checks::check_enclosures(curve, {1, curve.domain().hi});
  EXPECT_THROW(CompositeCurve({line, std::make_shared<Segment>(Vec3(1.1, 0, 0), Vec3(2, 0, 0))}, false, 1e-7),
               FieldError);
  EXPECT_THROW(CompositeCurve({line}, true, 1e-7), FieldError);
}

TEST(DerivedCurves, TransitionsJoinAsSmoothlyAsAsked) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  for (int sample = 0; sample < 20; ++sample) {
    const auto curve = [&] {
      std::vector<Vec3> points;
      for (int i = 0; i < 5; ++i) points.push_back(vector());
      return CurvePtr(
          std::make_shared<NurbsCurve>(SplineAxis(4, {0, 0, 0, 0, 0, 1, 1, 1, 1, 1}, Extension::tangent), points));
    };
    const CurvePtr a = curve(), b = curve();
    for (int continuity = 1; continuity <= 3; ++continuity) {
      const NurbsCurve between(transition({a, false, false}, {b, false, true}, continuity, 1, 0.7));
      const auto compare = [&](double t, const Curve& other, double s, double sign) {
        const CurveCurvature here = curvature(between.evaluate(t, 3)), there = curvature(other.evaluate(s, 3));
        const double size = glm::length(between.point(1) - between.point(0));
        EXPECT_LE(glm::length(here.tangent - sign * there.tangent), 1e-10);
        if (continuity >= 2) {
          EXPECT_LE(size * glm::length(here.curvature * here.normal - there.curvature * there.normal), 1e-8);
        }
        if (continuity >= 3) {
          EXPECT_NEAR(here.torsion, there.torsion, 1e-6 * (1 + std::abs(there.torsion)));
        }
      };
      compare(0, *a, 1, 1);
      compare(1, *b, 1, -1);
    }
  }
}

}  // namespace
}  // namespace lekalo::geometry
