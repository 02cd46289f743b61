// `let`: names for parts of formulas.
#include <gtest/gtest.h>

#include <cmath>

#include "render/lines/curve_helpers.h"
#include "render/scene/scene_text.h"

namespace lekalo::render::let_test {
namespace {

using geometry::CurvePtr;

CurvePtr curve_of(const std::string& fields) {
  const BuiltText result =
      build_text("parameters: { p: 3 }\ngeometry:\n  c: { type: formula_curve, " + fields + " }\nlights: {}\n");
  EXPECT_EQ(result.said, "") << fields;
  return std::get<CurvePtr>(result.model.geometry.at("c"));
}
std::string said_of(const std::string& fields) {
  return build_text("geometry:\n  c: { type: formula_curve, " + fields + " }\nlights: {}\n").said;
}

TEST(Let, names_stand_for_formulas) {
  const CurvePtr curve = curve_of("let: { w: sqrt(1 - t^2), q: 2*w + p }, point: [t, q], domain: [-0.9, 0.9]");
  const auto jet = curve->evaluate(0.6, 1);
  EXPECT_NEAR(jet.d[0].y, 2 * 0.8 + 3, 1e-15);
  EXPECT_NEAR(jet.d[1].y, -2 * 0.6 / 0.8, 1e-15);
  // What is not used may speak of other variables.
  EXPECT_NEAR(curve_of("let: { a: 2*x }, y: a, domain: [0, 1]")->point(0.25).y, 0.5, 1e-15);
}

TEST(Let, slips_are_named) {
  EXPECT_NE(said_of("let: { w: r^2 }, point: [t, w], domain: [0, 1]").find("unknown name 'r'"), std::string::npos);
  EXPECT_NE(said_of("let: { q: w, w: t }, point: [t, q], domain: [0, 1]").find("unknown name 'w'"), std::string::npos);
  EXPECT_NE(said_of("let: { sin: t }, point: [t, sin], domain: [0, 1]").find("'sin'"), std::string::npos);
  EXPECT_NE(said_of("let: 3, point: [t, t], domain: [0, 1]").find("map of names to formulas"), std::string::npos);
  EXPECT_NE(build_text("geometry:\n  c: { type: circle, radius: 1, let: { w: 1 } }\nlights: {}\n").said.find("'let'"),
            std::string::npos);
}

TEST(CurveJumps, values_and_limits) {
  const CurveJumps steps = curve_jumps(*curve_of("y: floor(x), domain: [-0.5, 2.5]"));
  ASSERT_EQ(steps.values.size(), 3u);
  ASSERT_EQ(steps.limits.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(steps.values[k], geometry::Vec3(k, k, 0));
    EXPECT_LT(glm::length(steps.limits[k] - geometry::Vec3(k, k - 1, 0)), 1e-12);
  }
  // A sign has a value of its own between its limits; a kink and a pole are no jumps.
  EXPECT_EQ(curve_jumps(*curve_of("y: sign(x), domain: [-1, 1]")).limits.size(), 2u);
  EXPECT_TRUE(curve_jumps(*curve_of("y: abs(x), domain: [-1, 1]")).values.empty());
  EXPECT_TRUE(curve_jumps(*curve_of("y: cbrt(x), domain: [-1, 1]")).values.empty());
}

}  // namespace
}  // namespace lekalo::render::let_test
