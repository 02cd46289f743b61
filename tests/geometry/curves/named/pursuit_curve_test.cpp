#include <gtest/gtest.h>

#include "geometry/curves/analytic/ellipse.h"
#include "geometry/describe.h"
#include "tests/geometry/curves/curve_checks.h"

namespace lekalo::geometry::pursuit_curve_test {
namespace {

CurvePtr chase(const CurvePtr& prey, const Vec3& start, double ratio) {
  Fields fields;
  fields.set("of", prey), fields.set("start", start), fields.set("ratio", ratio);
  for (const TypeDeclaration& type : geometry_types())
    if (type.name == "pursuit_curve") return std::any_cast<CurvePtr>(type.build(fields));
  return nullptr;
}

// It runs towards the prey, at its speed, also in space.
TEST(PursuitCurve, runs_towards_its_prey) {
  const auto prey = std::make_shared<Ellipse>(frame_from({1, 2, 3}, {1, 1, 2}, {1, 0, 0}), 3, 2, Interval(0, 5));
  const CurvePtr path = chase(prey, {0, 0, 0}, 1.25);
  EXPECT_EQ(path->domain(), Interval(0, 5));
  for (const double t : {0.1, 0.9, 2.2, 4.9}) {
    const CurveJet at = path->evaluate(t, 1), to = prey->evaluate(t, 1);
    const Vec3 way = glm::normalize(to.d[0] - at.d[0]);
    EXPECT_LT(glm::length(at.d[1] - glm::length(to.d[1]) / 1.25 * way), 1e-7);
  }
  checks::check_enclosures(*path, path->domain());
}

TEST(PursuitCurve, ends_where_the_prey_is_caught) {
  const auto prey = std::make_shared<Ellipse>(Frame(), 1, 1, Interval(0, 5));
  const CurvePtr path = chase(prey, {0, 0, 0}, 0.5);
  const double end = path->domain().hi;
  EXPECT_LT(end, 5);
  EXPECT_LT(glm::length(path->point(end) - prey->point(end)), 1e-8);
  EXPECT_THROW(chase(prey, {1, 0, 0}, 0.5), FieldError);
}

}  // namespace
}  // namespace lekalo::geometry::pursuit_curve_test
