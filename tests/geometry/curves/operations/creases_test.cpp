// Creases of surfaces that are smooth in pieces, and silhouettes that end there.
#include "geometry/curves/operations/creases.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/contour.h"
#include "geometry/curves/analytic/polyline.h"
#include "geometry/curves/splines/nurbs_curve.h"
#include "geometry/queries/contours/silhouette.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/splines/nurbs_surface.h"
#include "geometry/surfaces/swept/extrusion.h"
#include "geometry/surfaces/swept/revolution.h"

namespace lekalo::geometry::creases_test {
namespace {

CurvePtr corners(const std::vector<Vec3>& points, bool closed = false) {
  return std::make_shared<NurbsCurve>(polyline(points, closed));
}

Axis z_axis() { return {{0, 0, 0}, {0, 0, 1}}; }

TEST(Creases, RingsOfTurnedPolylines) {
  const std::vector<Vec3> points{{1, 0, 0}, {2, 0, 1}, {1, 0, 2}, {0, 0, 2.5}};
  const auto surface = std::make_shared<RevolutionSurface>(corners(points), z_axis(), kTwoPi);
  const std::vector<Crease> found = creases(*surface);
  ASSERT_EQ(found.size(), 2u);
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(found[k].held, IsoDirection::u);
    EXPECT_EQ(found[k].along.lo, 0);
    EXPECT_EQ(found[k].along.hi, kTwoPi);
    EXPECT_LT(glm::length(surface->point(found[k].at, 0) - points[k + 1]), 1e-12);
  }
  // Both generators of each of the lower cones, from ring to ring; the cap is seen from above.
  const Vec3 sight = glm::normalize(Vec3(-1, 0, -0.6));
  const Contours outline = silhouette(surface, {false, sight});
  EXPECT_TRUE(outline.complete);
  ASSERT_EQ(outline.branches.size(), 4u);
  for (const Contour& branch : outline.branches) {
    const Interval t = branch.curve->domain();
    const Vec3 a = branch.curve->point(t.lo), b = branch.curve->point(t.hi);
    EXPECT_NEAR(std::abs(b.z - a.z), 1, 1e-9);
    EXPECT_NEAR(std::abs(std::hypot(b.x, b.y) - std::hypot(a.x, a.y)), 1, 1e-9);
  }
}

TEST(Creases, SeamOfAClosedProfile) {
  const auto ring =
      std::make_shared<RevolutionSurface>(corners({{1, 0, 0}, {2, 0, 0}, {2, 0, 1}}, true), z_axis(), kTwoPi);
  const std::vector<Crease> found = creases(*ring);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(std::count_if(found.begin(), found.end(), [](const Crease& crease) { return crease.seam; }), 1);
  EXPECT_TRUE(silhouette(ring, {false, glm::normalize(Vec3(1, 2, -1))}).complete);
}

TEST(Creases, OnlyWhereKnotsFold) {
  // A full knot in the middle: the first and last rows go straight on, the one between does not.
  NurbsSurfaceForm form;
  form.degree_u = 2, form.degree_v = 1;
  form.knots_u = {0, 0, 0, 1, 1, 2, 2, 2};
  form.knots_v = {0, 0, 1, 2, 3, 3};
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 4; ++j) form.points.push_back({i, j, j < 2 ? 0.0 : std::abs(i - 2.0), 1});
  const NurbsSurface sheet(form);
  std::vector<Crease> across;
  for (const Crease& crease : creases(sheet))
    if (crease.held == IsoDirection::u) across.push_back(crease);
  ASSERT_EQ(across.size(), 1u);
  EXPECT_EQ(across[0].at, 1);
  EXPECT_EQ(across[0].along.lo, 1);
  EXPECT_EQ(across[0].along.hi, 3);
}

TEST(Creases, SmoothSurfacesHaveNone) {
  EXPECT_TRUE(creases(SphereSurface(Frame(), 1)).empty());
  const std::vector<Vec3> straight{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  EXPECT_TRUE(creases(ExtrusionSurface(corners(straight), {0, 1, 0})).empty());
}

}  // namespace
}  // namespace lekalo::geometry::creases_test
