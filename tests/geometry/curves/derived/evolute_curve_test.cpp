#include <gtest/gtest.h>

#include "geometry/composition.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/ellipse.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/describe.h"
#include "geometry/queries/closest/closest_point.h"
#include "tests/geometry/curves/curve_checks.h"

namespace lekalo::geometry::evolute_curve_test {
namespace {

CurvePtr built(const std::string& name, const Fields& fields) {
  for (const TypeDeclaration& type : geometry_types())
    if (type.name == name) return std::any_cast<CurvePtr>(type.build(fields));
  return nullptr;
}

const CurvePtr kEllipse = std::make_shared<Ellipse>(Frame(), 3, 2, Interval(0, kTwoPi));

Fields of(const CurvePtr& curve) {
  Fields fields;
  fields.set("of", curve);
  fields.set("normal", Vec3(0, 0, 1));
  fields.set("pole", Vec3(0));
  fields.set("start", 0.0);
  fields.set("backward", false);
  fields.set("turns", 1.0);
  return fields;
}

void check(const CurvePtr& curve) {
  checks::check_differences(*curve, curve->domain(), 3, 1e-6);
  checks::check_enclosures(*curve, curve->domain());
}

TEST(EvoluteCurve, of_an_ellipse) {
  const CurvePtr evolute = built("evolute_curve", of(kEllipse));
  const auto formula = [](const auto& t) {
    using T = std::decay_t<decltype(t)>;
    const T c = cos(t), s = sin(t);
    return Triple<T>{5.0 / 3.0 * c * c * c, -2.5 * s * s * s, T(0.0)};
  };
  for (const double t : {0.3, 1.0, 2.5, 5.0}) {
    const auto exact = formula(Jet<double, 4>::variable(t));
    const CurveJet jet = evolute->evaluate(t, 4);
    for (int k = 0; k <= 4; ++k) {
      EXPECT_NEAR(jet.d[k].x, exact.x.derivative(k), 1e-12);
      EXPECT_NEAR(jet.d[k].y, exact.y.derivative(k), 1e-12);
    }
  }
  checks::check_enclosures(*evolute, evolute->domain());
}

// The curve is the evolute of its involute.
TEST(EvoluteCurve, undoes_the_involute) {
  const CurvePtr involute = built("involute_curve", of(kEllipse));
  const double length = involute->domain().hi;
  Fields fields = of(std::make_shared<Ellipse>(Frame(), 3, 2, Interval(0, 3)));
  for (const double share : {0.1, 0.4, 0.9}) {
    const CurveJet jet = involute->evaluate(share * length, 2);
    const Vec3 n(0, 0, 1), across = glm::cross(n, jet.d[1]);
    const Vec3 center = jet.d[0] + glm::dot(jet.d[1], jet.d[1]) / glm::dot(n, glm::cross(jet.d[1], jet.d[2])) * across;
    EXPECT_LT(project(center, *kEllipse).foot_points.front().distance, 1e-9);
  }
  checks::check_enclosures(*involute, involute->domain());
}

TEST(PedalCurve, stands_at_right_angles) {
  const CurvePtr pedal = built("pedal_curve", of(kEllipse));
  for (const double t : {0.2, 1.7, 4.0}) {
    const Vec3 foot = pedal->point(t), along = kEllipse->evaluate(t, 1).d[1];
    EXPECT_NEAR(glm::dot(foot, along), 0, 1e-13);
    EXPECT_NEAR(glm::length(glm::cross(foot - kEllipse->point(t), along)), 0, 1e-13);
  }
  check(pedal);
}

TEST(ConchoidCurve, keeps_its_distance) {
  Fields fields = of(kEllipse);
  fields.set("distance", -0.75);
  const CurvePtr conchoid = built("conchoid_curve", fields);
  for (const double t : {0.2, 1.7, 4.0}) {
    EXPECT_NEAR(glm::length(conchoid->point(t)), glm::length(kEllipse->point(t)) - 0.75, 1e-14);
    EXPECT_NEAR(glm::length(glm::cross(conchoid->point(t), kEllipse->point(t))), 0, 1e-13);
  }
  check(conchoid);
}

// Rolling without slipping: the carried point moves across the line from the point of contact.
TEST(RouletteCurve, turns_about_the_point_of_contact) {
  Fields fields = of(std::make_shared<Circle>(Frame(), 0.6));
  fields.set("base", kEllipse);
  fields.set("point", Vec3(0.3, 0.1, 0));
  fields.set("turns", 2.0);
  const CurvePtr roulette = built("roulette_curve", fields);
  const double length = 0.5 * roulette->domain().hi;
  EXPECT_NEAR(length, 15.8654395892906, 1e-11);
  const CurvePtr by_length = by_arc_length(kEllipse);
  for (const double share : {0.05, 0.31, 0.77, 1.4, 1.9}) {
    const CurveJet jet = roulette->evaluate(share * length, 1);
    const Vec3 off = jet.d[0] - by_length->point(length * (share - std::floor(share)));
    EXPECT_NEAR(glm::dot(jet.d[1], off), 0, 1e-11);
    EXPECT_LE(glm::length(off), 1.2 + std::hypot(0.3, 0.1));
  }
  checks::check_differences(*roulette, {1, 6}, 2, 1e-6);
  checks::check_enclosures(*roulette, roulette->domain());
  // Against arc length by hand: on a line of length 2 pi a circle's start draws a cycloid.
  Fields on_line = of(std::make_shared<Circle>(Frame(), 1));
  on_line.set("base", CurvePtr(std::make_shared<Segment>(Vec3(0), Vec3(6, 0, 0))));
  const CurvePtr cycloid = built("roulette_curve", on_line);
  for (const double s : {0.0, 1.0, 2.5, 6.0})
    EXPECT_LT(glm::length(cycloid->point(s) - Vec3(s - std::sin(s), 1 - std::cos(s), 0)), 1e-11);
}

TEST(DerivedByTangents, errors) {
  const auto wave = std::make_shared<Segment>(Vec3(-1, 0, 0), Vec3(1, 0, 0));
  EXPECT_THROW(built("evolute_curve", of(wave)), FieldError);
  Fields through = of(wave);
  through.set("distance", 1.0);
  EXPECT_THROW(built("conchoid_curve", through), FieldError);
  Fields too_short = of(wave);
  too_short.set("base", kEllipse);
  EXPECT_THROW(built("roulette_curve", too_short), FieldError);
  Fields to_the_pole = of(std::make_shared<Circle>(Frame(), 2));
  to_the_pole.set("distance", -2.0);
  EXPECT_THROW(built("conchoid_curve", to_the_pole), FieldError);
  EXPECT_THROW(built("evolute_curve", of(std::make_shared<Circle>(Frame(), 2))), FieldError);
  const auto bent =
      std::make_shared<NurbsCurve>(NurbsCurveForm{1, {0, 0, 1, 2, 2}, {{0, 0, 0, 1}, {9, 0, 0, 1}, {9, 9, 0, 1}}, {}});
  EXPECT_THROW(built("involute_curve", of(bent)), FieldError);
  Fields around_a_corner = of(std::make_shared<Circle>(Frame(), 2));
  around_a_corner.set("base", CurvePtr(bent));
  EXPECT_THROW(built("roulette_curve", around_a_corner), FieldError);
  Fields turns = of(kEllipse);
  turns.set("base", CurvePtr(wave)), turns.set("turns", 2.0);
  EXPECT_THROW(built("roulette_curve", turns), FieldError);
}

}  // namespace
}  // namespace lekalo::geometry::evolute_curve_test
