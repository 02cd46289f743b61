// Joints made with a known jump of each order.
#include "geometry/queries/differential/continuity.h"

#include <gtest/gtest.h>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/splines/bezier_curve.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/bezier_surface.h"

namespace lekalo::geometry::continuity_test {
namespace {

// Bernstein coefficients of t^k / k! in degree 3.
double coefficient(int k, int i) {
  constexpr double kPower[4][4] = {{1, 1, 1, 1}, {0, 1 / 3.0, 2 / 3.0, 1}, {0, 0, 1 / 3.0, 1}, {0, 0, 0, 1}};
  constexpr double kFactorial[] = {1, 1, 2, 6};
  return kPower[k][i] / kFactorial[k];
}
// (t, b t^k / k!, 0), t from 0 to 1, beginning at the origin unless k = 0; or backwards.
NurbsCurve power_curve(int k, double b, bool backwards = false) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 3; ++i) points.emplace_back(i / 3.0, b * coefficient(k, i), 0);
  if (backwards) std::reverse(points.begin(), points.end());
  return bezier_curve(points);
}

TEST(CurveContinuity, EachOrderHasItsJump) {
  const Segment before({-1, 0, 0}, {0, 0, 0}), turned({0, 0, 0}, {-1, 0, 0});
  for (const Segment* a : {&before, &turned})
    for (const bool backwards : {false, true})
      for (int k = 0; k <= 3; ++k) {
        const NurbsCurve b = power_curve(k, 0.25, backwards);
        const CurveJoint found = joint(*a, b);
        EXPECT_EQ(found.a_end, a == &before);
        EXPECT_EQ(found.b_end, backwards);
        EXPECT_EQ(found.continuity.order, k - 1);
        const auto& jumps = found.continuity.jumps;
        for (int i = 0; i < k; ++i) EXPECT_NEAR(jumps[i].largest, 0, 1e-14) << k;
        EXPECT_NEAR(jumps[k].largest, k == 1 ? std::atan(0.25) : 0.25, 1e-14) << k;
      }
  const CurveJoint straight = joint(before, power_curve(1, 0));
  EXPECT_EQ(straight.continuity.order, 3);
}

TEST(CurveContinuity, ArcsOfCircles) {
  // Two quarters of one circle; a quarter and a tangent line; a quarter of another radius with the same tangent.
  const Circle first(Frame(), 2, {0, kPi / 2}), second(Frame(), 2, {kPi / 2, kPi});
  EXPECT_EQ(joint(first, second).continuity.order, 3);
  const Segment line({0, 2, 0}, {-3, 2, 0});
  const Continuity with_line = joint(first, line).continuity;
  EXPECT_EQ(with_line.order, 1);
  EXPECT_NEAR(with_line.jumps[2].largest, 0.5, 1e-15);
  // r_sss = -T / R^2 of a circle.
  EXPECT_NEAR(with_line.jumps[3].largest, 0.25, 1e-15);
  Frame lower;
  lower.origin = {0, 1, 0};
  const Circle smaller(lower, 1, {kPi / 2, kPi});
  EXPECT_NEAR(joint(first, smaller).continuity.jumps[2].largest, 0.5, 1e-15);
  EXPECT_NEAR(joint(first, smaller).continuity.jumps[2].relative, 0.5, 1e-15);
  // Back the same way: a fold.
  const Segment back({0, 2, 0}, {3, 2, 0});
  EXPECT_NEAR(joint(first, back).continuity.jumps[1].largest, kPi, 1e-15);
  EXPECT_THROW(joint(Circle(Frame(), 1), back), std::invalid_argument);
}

// x = t, y = s + shear t, z = b (1 + s) t^k / k!, turned so that the edge t = 0 is the u- or v-line `edge`.
NurbsSurface power_sheet(int k, double b, double shear, int edge) {
  const auto at = [&](int i, int j) { return Vec3(i / 3.0, j + shear * i / 3.0, b * (1 + j) * coefficient(k, i)); };
  Grid<Vec3> net;
  const bool along_u = edge >= 2;
  net.rows = along_u ? 2 : 4, net.columns = along_u ? 4 : 2;
  for (int row = 0; row < net.rows; ++row)
    for (int column = 0; column < net.columns; ++column) {
      const int i = along_u ? column : row, j = along_u ? row : column;
      net.values.push_back(at(edge % 2 ? 3 - i : i, j));
    }
  return bezier_surface(net);
}

// Two parabolas of curvatures 2 and 4 with a common vertex tangent: y = x^2 before x = 0, y = 2 x^2 behind; a corner;
// and a closed curve at its seam.
TEST(CurveContinuity, BetweenThePiecesOfACurve) {
  const std::vector<Vec3> points{{-1, 1, 0}, {-0.5, 0, 0}, {0, 0, 0}, {0.5, 0, 0}, {1, 2, 0}, {2, 2, 0}, {3, 2, 0}};
  const NurbsCurve curve(SplineAxis(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 3}, Extension::tangent), points);
  const std::vector<CurveOwnJoint> found = joints(curve);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].t, 1);
  EXPECT_EQ(found[0].continuity.order, 1);
  EXPECT_NEAR(found[0].continuity.jumps[2].largest, 2, 1e-12);
  EXPECT_EQ(found[1].continuity.order, 0);
  EXPECT_NEAR(found[1].continuity.jumps[1].largest, std::atan(4.0), 1e-12);
  const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<CurveOwnJoint> corners = joints(polyline(square, true));
  ASSERT_EQ(corners.size(), 4u);
  EXPECT_EQ(corners[0].t, 0);
  for (const CurveOwnJoint& corner : corners) EXPECT_NEAR(corner.continuity.jumps[1].largest, kPi / 2, 1e-12);
}

TEST(SurfaceContinuity, EachOrderHasItsJumpAtItsWorstPlace) {
  const NurbsSurface floor = bezier_surface(Grid<Vec3>{2, 2, {{-1, 0, 0}, {-1, 1, 0}, {0, 0, 0}, {0, 1, 0}}});
  for (int edge = 0; edge < 4; ++edge)
    for (const double shear : {0.0, 0.4})
      for (int k = 1; k <= 3; ++k) {
        const NurbsSurface sheet = power_sheet(k, 0.25, shear, edge);
        const std::vector<SurfaceJoint> found = joints(floor, sheet);
        ASSERT_EQ(found.size(), 1u) << edge;
        EXPECT_EQ(found[0].a.held, IsoDirection::u);
        EXPECT_EQ(found[0].a.at, 1);
        EXPECT_EQ(found[0].b.held, edge < 2 ? IsoDirection::u : IsoDirection::v);
        EXPECT_EQ(found[0].b.at, edge % 2);
        const Continuity& joint = found[0].continuity;
        EXPECT_EQ(joint.order, k - 1);
        for (int i = 0; i < k; ++i) EXPECT_NEAR(joint.jumps[i].largest, 0, 1e-13);
        // 0.25 (1 + y) is largest at y = 1.
        EXPECT_NEAR(joint.jumps[k].largest, k == 1 ? std::atan(0.5) : 0.5, 1e-13) << k << " " << edge << " " << shear;
        EXPECT_NEAR(joint.jumps[k].t, 1, 1e-9);
        EXPECT_NEAR(joint.jumps[k].point.y, 1, 1e-9);
      }
}

TEST(SurfaceContinuity, APartOfAnEdge) {
  const NurbsSurface wide = bezier_surface(Grid<Vec3>{2, 2, {{-1, -1, 0}, {-1, 3, 0}, {0, -1, 0}, {0, 3, 0}}});
  const NurbsSurface sheet = power_sheet(2, 0.25, 0, 0), apart = power_sheet(0, 0.02, 0, 0);
  const std::vector<SurfaceJoint> found = joints(wide, sheet);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].a.range.lo, 0.25, 1e-12);
  EXPECT_NEAR(found[0].a.range.hi, 0.5, 1e-12);
  EXPECT_NEAR(found[0].b.range.hi, 1, 1e-12);
  EXPECT_EQ(found[0].continuity.order, 1);
  EXPECT_TRUE(joints(wide, apart).empty());
  // With a wide gap allowed they join, and the gap is told.
  const std::vector<SurfaceJoint> gaping = joints(wide, apart, {}, 0.01);
  ASSERT_EQ(gaping.size(), 1u);
  EXPECT_EQ(gaping[0].continuity.order, -1);
  // From (0, 1, 0) across to the other edge, z = 0.02 (1 + y).
  EXPECT_NEAR(gaping[0].continuity.jumps[0].largest, 0.04 / std::hypot(1, 0.02), 1e-15);
}

TEST(SurfaceContinuity, ATorusAndASphereRoundIt) {
  // Half of a tube joins its other half smoothly; a half sphere continues a tube of the same radius with the same
  // tangent and curvature 1 / r, but not one of another radius.
  const TorusSurface outer(Frame(), 3, 1, {{0, kTwoPi}, {-kPi / 2, kPi / 2}}),
      inner(Frame(), 3, 1, {{0, kTwoPi}, {kPi / 2, 3 * kPi / 2}});
  const std::vector<SurfaceJoint> halves = joints(outer, inner);
  ASSERT_EQ(halves.size(), 2u);
  for (const SurfaceJoint& one : halves) EXPECT_EQ(one.continuity.order, 3);
  const SphereSurface upper(Frame(), 2, {{0, kTwoPi}, {0, kPi / 2}}), lower(Frame(), 2, {{0, kTwoPi}, {-kPi / 2, 0}});
  const std::vector<SurfaceJoint> spheres = joints(upper, lower);
  ASSERT_EQ(spheres.size(), 1u);
  EXPECT_EQ(spheres[0].continuity.order, 3);
  // A tube about the sphere's equator: tangent there, curvatures 1 / 2 and 1 / 0.5.
  const TorusSurface rim(Frame(), 1.5, 0.5, {{0, kTwoPi}, {-kPi / 2, 0}});
  const std::vector<SurfaceJoint> rims = joints(upper, rim);
  ASSERT_EQ(rims.size(), 1u);
  EXPECT_EQ(rims[0].continuity.order, 1);
  EXPECT_NEAR(rims[0].continuity.jumps[2].largest, 1.5, 1e-13);
}

TEST(BodyContinuity, OfPrimitives) {
  const Body block = box(Frame(), {1, 2, 3}), round = cylinder_body(Frame(), 1, 2), ring = torus_body(Frame(), 3, 1);
  for (int edge = 0; edge < static_cast<int>(block.edges.size()); ++edge) {
    const Continuity found = continuity(block, edge);
    EXPECT_EQ(found.order, 0);
    EXPECT_NEAR(found.jumps[1].largest, kPi / 2, 1e-14);
  }
  for (int edge = 0; edge < static_cast<int>(round.edges.size()); ++edge) {
    const Continuity found = continuity(round, edge);
    if (round.edges[edge].kind == EdgeKind::seam) {
      EXPECT_EQ(found.order, 3);
    } else {
      EXPECT_NEAR(found.jumps[1].largest, kPi / 2, 1e-14);
    }
  }
  for (int edge = 0; edge < static_cast<int>(ring.edges.size()); ++edge) EXPECT_EQ(continuity(ring, edge).order, 3);
  const Body tip = frustum(Frame(), 1, 0, 2);
  for (int edge = 0; edge < static_cast<int>(tip.edges.size()); ++edge) {
    if (tip.edges[edge].kind == EdgeKind::pole) {
      EXPECT_THROW(continuity(tip, edge), std::invalid_argument);
    }
  }
}

}  // namespace
}  // namespace lekalo::geometry::continuity_test
