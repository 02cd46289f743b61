// Osculating circles and spheres: their contact with the curve, which needs no formula of curvature.
#include "geometry/queries/differential/osculation.h"

#include <gtest/gtest.h>

namespace lekalo::geometry::osculation_test {
namespace {

CurveJet jet(const std::vector<Vec3>& derivatives) {
  CurveJet result;
  result.order = static_cast<int>(derivatives.size()) - 1;
  std::copy(derivatives.begin(), derivatives.end(), result.d.begin());
  return result;
}

// With f = |r - c|^2: f', f'' vanish at a circle's centre, f''' too at a sphere's.
TEST(Osculation, CentresOfContact) {
  for (const Vec3& third : {Vec3(0.3, 1, -2), Vec3(-1, 0.1, 0.7)}) {
    const CurveJet r = jet({{1, 2, 3}, {0.5, -1, 0.3}, {0.2, 0.9, 1.1}, third});
    const Osculation o = osculation(r, curvature(r));
    ASSERT_TRUE(o.circle && o.sphere && o.darboux);
    for (const Osculation::Round& round : {*o.circle, *o.sphere}) {
      const Vec3 w = r.d[0] - round.center;
      EXPECT_NEAR(glm::length(w), round.radius, 1e-13 * round.radius);
      EXPECT_NEAR(glm::dot(w, r.d[1]), 0, 1e-13 * round.radius);
      EXPECT_NEAR(glm::dot(w, r.d[2]) + glm::dot(r.d[1], r.d[1]), 0, 1e-12 * round.radius);
    }
    const Vec3 w = r.d[0] - o.sphere->center;
    EXPECT_NEAR(glm::dot(w, r.d[3]) + 3 * glm::dot(r.d[1], r.d[2]), 0, 1e-12 * o.sphere->radius);
    const CurveCurvature frame = curvature(r);
    EXPECT_NEAR(glm::length(glm::cross(*o.darboux, frame.tangent) - frame.curvature * frame.normal), 0, 1e-14);
  }
}

TEST(Osculation, NoneWhereThereIsNone) {
  const CurveJet plane = jet({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 0, 0}});
  EXPECT_TRUE(osculation(plane, curvature(plane)).circle);
  EXPECT_FALSE(osculation(plane, curvature(plane)).sphere);
  const CurveJet flex = jet({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}});
  EXPECT_FALSE(osculation(flex, curvature(flex)).circle);
  EXPECT_FALSE(osculation(flex, curvature(flex)).darboux);
  const CurveJet rest = jet({{0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {0, 1, 0}});
  EXPECT_FALSE(osculation(rest, curvature(rest)).circle);
}

}  // namespace
}  // namespace lekalo::geometry::osculation_test
