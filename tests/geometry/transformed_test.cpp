#include "geometry/transformed.h"

#include "geometry/curves/analytic/ellipse.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/analytic_formulas.h"

namespace lekalo::geometry::transformed_test {
namespace {

using checks::distance;
using checks::kSkewFrame;

SurfacePtr image(const SurfacePtr& surface, const Affine& map) { return transformed(surface, map); }

// Shear, unequal scaling and a mirror.
const Affine kMirrored = Affine::translation({3, -1, 2}) * Affine::mirror({1, 2, 0.5}) *
                         Affine::scaling({2, 0.5, 1.25}) * Affine::rotation(0.7, {1, 1, 0.2}, {1, 0, 0});
const Affine kUpright = Affine::scaling({0.1, 3, 1}) * Affine::rotation(2, {0, 1, 0.2}, {0, 5, 0});

// Rodrigues' formula about an oblique axis through a point, and its invariants.
TEST(AffineMaps, TurnAboutAnObliqueAxis) {
  const Vec3 axis = glm::normalize(Vec3(1, -2, 3)), through(4, 1, -2);
  for (const double angle : {0.3, 2.0, -1.1}) {
    const Affine turn = Affine::rotation(angle, Vec3(1, -2, 3), through);
    for (const Vec3& p : {Vec3(0), Vec3(5, 6, 7), Vec3(-1, 0.5, 2)}) {
      const Vec3 r = p - through;
      const Vec3 expected = through + std::cos(angle) * r + std::sin(angle) * glm::cross(axis, r) +
                            (1 - std::cos(angle)) * glm::dot(axis, r) * axis;
      EXPECT_LE(distance(turn.point(p), expected), 4e-15) << angle;
    }
    EXPECT_LE(distance(turn.point(through + 7.0 * axis), through + 7.0 * axis), 2e-15);
  }
  // A third of a turn about the diagonal exchanges the axes.
  const Affine third = Affine::rotation(kTwoPi / 3, {1, 1, 1}, {2, 2, 2});
  EXPECT_LE(distance(third.point({5, 3, 1}), {1, 5, 3}), 4e-15);
}

// r = p + S (r' - p) along axes of its own: turn the triad upright, stretch about the point, turn back (1.3d).
TEST(AffineMaps, ScaleAboutAPoint) {
  const Affine scale = Affine::scaling({2, 0.5, 3}, {1, 2, 4});
  EXPECT_EQ(scale.point({1, 2, 4}), Vec3(1, 2, 4));
  EXPECT_EQ(scale.point({3, 6, 5}), Vec3(5, 4, 7));
  EXPECT_EQ(scale.direction({1, 1, 1}), Vec3(2, 0.5, 3));
  const Vec3 center(1, 2, 4), along = glm::normalize(Vec3(1, 1, 0));
  const Affine oblique = Affine::rotation(kPi / 4, {0, 0, 1}, center) * Affine::scaling({3, 1, 1}, center) *
                         Affine::rotation(-kPi / 4, {0, 0, 1}, center);
  for (const Vec3& p : {Vec3(0), Vec3(3, 6, 5)})
    EXPECT_LE(distance(oblique.point(p), p + 2.0 * glm::dot(p - center, along) * along), 4e-15);
}

TEST(TransformedCurve, MeetsTheGeneralChecks) {
  for (const Affine& map : {kMirrored, kUpright}) {
    const auto curve = transformed(CurvePtr(std::make_shared<Ellipse>(kSkewFrame, 3, 2, Interval(0.5, 4))), map);
    checks::check_differences(*curve, curve->domain());
    checks::check_enclosures(*curve, curve->domain());
    checks::check_nurbs(*curve);
    checks::check_pieces(*curve);
    checks::check_period(*curve);
  }
}

TEST(TransformedSurface, MeetsTheGeneralChecks) {
  for (const Affine& map : {kMirrored, kUpright}) {
    checks::check_surface(*image(std::make_shared<SphereSurface>(kSkewFrame, 2.0), map), {.closed = true});
    checks::check_surface(*image(std::make_shared<ConeSurface>(kSkewFrame, 0, 2, 1), map));
    checks::check_surface(*image(std::make_shared<TorusSurface>(kSkewFrame, 1, 0.25), map), {.closed = true});
  }
  // The sphere moved to a place a million sizes away.
  checks::check_surface(*image(std::make_shared<SphereSurface>(Frame(), 1.0), Affine::translation({1e6, -1e6, 5e5})),
                        {.closed = true});
}

// The image of the sphere under a scaling is an ellipsoid with known points; its normal is outward because the
// parametrisation turns with it, and stays r_u x r_v under a mirror.
TEST(TransformedSurface, NormalFollowsTheParametrisation) {
  const auto sphere = std::make_shared<SphereSurface>(Frame(), 1.0);
  const auto stretched = image(sphere, Affine::scaling({3, 2, 1}));
  EXPECT_LE(distance(stretched->normal(0.5, 0.3), {0.598713656212757, 0.490618141638763, 0.633115942746097}), 2e-15);
  const auto mirrored = image(sphere, Affine::mirror({1, 0, 0}));
  EXPECT_LE(distance(mirrored->normal(0, 0), {1, 0, 0}), 1e-15);  // inward at (-1, 0, 0)
}

TEST(TransformedSurface, KeepsReversedAndFoldsMaps) {
  auto sphere = std::make_shared<SphereSurface>(Frame(), 1.0);
  sphere->set_reversed(true);
  const auto moved = image(sphere, kUpright);
  EXPECT_TRUE(moved->reversed());
  EXPECT_EQ(image(sphere, Affine()), sphere);
  const auto twice = image(moved, kMirrored);
  const auto once = image(sphere, kMirrored * kUpright);
  EXPECT_TRUE(twice->reversed());
  EXPECT_EQ(twice->point(1, 0.5), once->point(1, 0.5));
  EXPECT_EQ(twice->normal(1, 0.5), once->normal(1, 0.5));
}

TEST(TransformedSurface, RefusesMapsThatFlatten) {
  const auto sphere = std::make_shared<SphereSurface>(Frame(), 1.0);
  EXPECT_THROW(image(sphere, Affine::scaling({1, 0, 1})), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::geometry::transformed_test
