#include <gtest/gtest.h>

#include "geometry/describe.h"
#include "geometry/point_formulas.h"
#include "tests/geometry/curves/curve_checks.h"

namespace lekalo::geometry::implicit_curve_test {
namespace {

Fields fields_of(const char* formula, double reach) {
  Fields box, fields;
  box.set("min", Vec3(-reach, -reach, 0)), box.set("max", Vec3(reach, reach, 0));
  fields.set("formula", formula_of(formula, {"x", "y"}));
  fields.set("level", 0.0);
  fields.set("box", box);
  return fields;
}
CurvePtr built(const Fields& fields) {
  for (const TypeDeclaration& type : geometry_types())
    if (type.name == "implicit_curve") return std::any_cast<CurvePtr>(type.build(fields));
  return nullptr;
}

TEST(ImplicitCurve, solves_its_equation) {
  const char* formula = "x^4 + y^4 - x*y - 1";
  const CurvePtr curve = built(fields_of(formula, 2));
  EXPECT_TRUE(curve->is_closed());
  const Expression value = formula_of(formula, {"x", "y"});
  for (int k = 0; k < 500; ++k) {
    const Vec3 p = curve->point(curve->domain().width() * k / 500);
    EXPECT_LT(std::abs(value(p.x, p.y)), 1e-9);
    EXPECT_EQ(p.z, 0);
  }
  checks::check_enclosures(*curve, curve->domain());
}

TEST(ImplicitCurve, ends_at_its_node) {
  Fields fields = fields_of("y^2*(1 - x) - x^2*(1 + x)", 1.5);  // the strophoid: two wings and a loop
  EXPECT_THROW(built(fields), FieldError);
  fields.set("near", Vec3(-0.9, 0.1, 0));
  const CurvePtr loop = built(fields);
  EXPECT_LT(glm::length(loop->point(loop->domain().lo)), 1e-12);
  EXPECT_LT(glm::length(loop->point(loop->domain().hi)), 1e-12);
  fields.set("branch", 7);
  EXPECT_THROW(built(fields), FieldError);
  EXPECT_THROW(built(fields_of("x^2 + y^2 + 1", 1)), FieldError);
}

}  // namespace
}  // namespace lekalo::geometry::implicit_curve_test
