#include <gtest/gtest.h>

#include "geometry/describe.h"
#include "geometry/point_formulas.h"
#include "tests/geometry/curves/curve_checks.h"

namespace lekalo::geometry::helix_test {
namespace {

Fields helix_fields(const char* radius, const Axis& axis) {
  Fields fields;
  fields.set("axis", axis);
  fields.set("radius", formula_of(radius, {"s"}));
  fields.set("start", 0.25);
  fields.set("hand", std::string("right"));
  return fields;
}

CurvePtr built(const Fields& fields) {
  for (const TypeDeclaration& type : geometry_types())
    if (type.name == "helix") return std::any_cast<CurvePtr>(type.build(fields));
  return nullptr;
}

TEST(Helix, follows_its_formula) {
  Fields fields = helix_fields("2 - s^2", {});
  fields.set("pitch", formula_of("0.75", {"s"})), fields.set("turns", 3.0);
  const CurvePtr helix = built(fields);
  EXPECT_EQ(helix->domain(), Interval(0, 3 * kTwoPi));
  const auto formula = [](const auto& t) {
    using T = std::decay_t<decltype(t)>;
    const T s = t / (3 * kTwoPi), r = 2.0 - s * s, a = t + 0.25;
    return Triple<T>{r * cos(a), r * sin(a), t * (0.75 / kTwoPi)};
  };
  checks::check_derivatives(*helix, formula, helix->domain(), 1e-13);
  checks::check_enclosures(*helix, helix->domain());
}

// The rise by the pitch 1 + 3 s^2 over four turns is 4 (s + s^3).
TEST(Helix, rises_by_a_law) {
  Fields fields = helix_fields("1", {});
  fields.set("pitch", formula_of("1 + 3*s^2", {"s"})), fields.set("turns", 4.0);
  const CurvePtr helix = built(fields);
  for (const double s : {0.0, 0.3, 0.7, 1.0}) EXPECT_NEAR(helix->point(8 * kPi * s).z, 4 * (s + s * s * s), 1e-14);
  checks::check_differences(*helix, helix->domain(), 3, 1e-6);
  checks::check_enclosures(*helix, helix->domain());
  Fields by_height = helix_fields("1", {});
  by_height.set("pitch", formula_of("1 + 3*s^2", {"s"})), by_height.set("height", 8.0);
  EXPECT_NEAR(built(by_height)->domain().hi, 8 * kPi, 1e-13);
}

TEST(Helix, stands_on_its_axis) {
  Fields fields = helix_fields("2", {{1, 2, 3}, glm::normalize(Vec3(1, 2, 2))});
  fields.set("height", 6.0), fields.set("turns", 4.0);
  const CurvePtr helix = built(fields);
  const Vec3 along = glm::normalize(Vec3(1, 2, 2));
  for (const double t : {0.0, 1.0, 11.0, 8 * kPi}) {
    const Vec3 off = helix->point(t) - Vec3(1, 2, 3);
    EXPECT_NEAR(glm::dot(off, along), 6 * t / (8 * kPi), 1e-14);
    EXPECT_NEAR(glm::length(glm::cross(off, along)), 2, 1e-14);
  }
}

TEST(Helix, two_of_three_are_given) {
  Fields fields = helix_fields("2", {});
  fields.set("pitch", formula_of("1", {"s"}));
  EXPECT_THROW(built(fields), FieldError);
  fields.set("height", -2.0);
  EXPECT_THROW(built(fields), FieldError);
  fields.set("height", 2.0);
  EXPECT_EQ(built(fields)->domain(), Interval(0, 2 * kTwoPi));
}

}  // namespace
}  // namespace lekalo::geometry::helix_test
