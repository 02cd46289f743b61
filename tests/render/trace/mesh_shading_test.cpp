// Shading of facets: interpolated normals (Golovanov 2016, 8.5 B, numbers worked out by hand), and true normals of
// meshes that were made from surfaces.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/bodies/trims/trimmed_surface.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/tessellation/tessellate.h"
#include "render/trace/world.h"
#include "support/worst.h"

namespace lekalo::render::mesh_shading_test {
namespace {

using namespace geometry;

std::shared_ptr<Model> model_of(Entity shape, Representation representation = Representation::direct, double sag = 0) {
  auto model = std::make_shared<Model>();
  Object object;
  object.shape = std::move(shape);
  object.representation = representation;
  object.sag = sag;
  model->objects.push_back(std::move(object));
  return model;
}

// The surface point that a ray from `origin` toward `target` meets first.
std::optional<SurfacePoint> seen(const World& world, const Vec3& origin, const Vec3& target, Hit* hit = nullptr) {
  Ray ray;
  ray.origin = origin;
  ray.direction = glm::normalize(target - origin);
  Hit nearest;
  if (!world.nearest(ray, nearest)) return std::nullopt;
  if (hit) *hit = nearest;
  return world.surface_point(ray, nearest);
}

MeshPtr triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  auto mesh = std::make_shared<Mesh>();
  mesh->points = {a, b, c};
  mesh->normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh->parameters = {{0, 0}, {12, 0}, {0, 24}};
  mesh->triangles.push_back({{0, 1, 2}, {0, 1, 2}, {0, 1, 2}});
  return mesh;
}

TEST(MeshShading, NormalsAndParametersFollowTheBarycentricCoordinates) {
  const World world(model_of(triangle({0, 0, 0}, {4, 0, 0}, {0, 3, 0})));
  Hit hit;
  const auto point = seen(world, {1, 1, 5}, {1, 1, 0}, &hit);
  ASSERT_TRUE(point);
  EXPECT_NEAR(hit.b, 1.0 / 4, 1e-15);
  EXPECT_NEAR(hit.c, 1.0 / 3, 1e-15);
  const Vec3 sum(5.0 / 12, 1.0 / 4, 1.0 / 3);
  EXPECT_LT(glm::length(point->normal - glm::normalize(sum)), 1e-15);
  EXPECT_NEAR(point->u, 12.0 / 4, 1e-14);
  EXPECT_NEAR(point->v, 24.0 / 3, 1e-14);
  // At the centroid the mean of the corners' normals has the length 1/sqrt(3).
  const auto middle = seen(world, {4.0 / 3, 1, 5}, {4.0 / 3, 1, 0});
  ASSERT_TRUE(middle);
  EXPECT_LT(glm::length(middle->normal - Vec3(1 / std::sqrt(3.0))), 1e-15);
}

// A triangle far from parallel to the picture: its centroid (0, 0, -4) is seen through the picture's middle, where
// picture coordinates would give the weights 0.185, 0.556, 0.259 and the depth -6.07.
TEST(MeshShading, WeightsAreThoseOfSpaceNotOfThePicture) {
  const World world(model_of(triangle({-1, -1, 0}, {2, -1, -10}, {-1, 2, -2})));
  Hit hit;
  const auto point = seen(world, {0, 0, 5}, {0, 0, 0}, &hit);
  ASSERT_TRUE(point);
  EXPECT_NEAR(hit.b, 1.0 / 3, 1e-15);
  EXPECT_NEAR(hit.c, 1.0 / 3, 1e-15);
  EXPECT_LT(glm::length(point->position - Vec3(0, 0, -4)), 1e-14);
}

TEST(MeshShading, FlatAndSmoothPlanesAreTheSame) {
  const auto plane =
      std::make_shared<Plane>(frame_about({0, 0, 1}, glm::normalize(Vec3(0.2, 0.1, 1))), Rectangle{{-2, 2}, {-1, 1}});
  auto flat_model = model_of(SurfacePtr(plane), Representation::mesh, 0.01);
  flat_model->objects[0].flat_shading = true;
  const World smooth(model_of(SurfacePtr(plane), Representation::mesh, 0.01)), flat(flat_model);
  for (double x = -1.5; x < 1.6; x += 0.25) {
    const auto a = seen(smooth, {x, 0.3, 8}, {x, 0.3, 0}), b = seen(flat, {x, 0.3, 8}, {x, 0.3, 0});
    ASSERT_TRUE(a && b);
    EXPECT_LT(glm::length(a->normal - b->normal), 1e-15);
    EXPECT_LT(glm::length(a->position - b->position), 1e-15);
  }
}

// Largest angle between the shading normal of a mesh of the surface, whose surface is forgotten, and the true normal.
double interpolation_error(const TorusSurface& torus, double sag) {
  const World world(model_of(MeshPtr(std::make_shared<Mesh>(tessellate(torus, {sag, kPi, {}})))));
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  double worst = 0;
  for (int k = 0; k < 4000; ++k) {
    const double u = kTwoPi * unit(random), v = kPi * (2 * unit(random) - 1);
    const Vec3 n = torus.normal(u, v), x = torus.point(u, v);
    const auto point = seen(world, x + 0.3 * n, x);
    if (point) worst = tests::worse(worst, glm::length(point->normal - n));
  }
  return worst;
}

// The sag falls with the square of the step between neighbours, the error of an interpolated normal as well.
TEST(MeshShading, InterpolatedNormalsConvergeQuadratically) {
  const TorusSurface torus(Frame(), 3, 1);
  const double coarse = interpolation_error(torus, 1e-2), fine = interpolation_error(torus, 1e-3);
  EXPECT_NEAR(coarse / fine, 10, 3) << coarse << " " << fine;
}

// A foot point beyond the facet's own parameters is moved to their border. So every normal is the surface's own where
// the facet's point stands on it: to 2e-4 for facets of 0.06, whose corners' normals differ by 0.09.
void expect_true_normals(const SurfacePtr& surface, const Entity& shape, double offset) {
  const World world(model_of(shape, Representation::mesh, 1e-3));
  const Rectangle d = surface->domain();
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < 4000; ++k) {
    const double u = d.u.lo + unit(random) * d.u.width();
    // Half of the points crowd at the upper end, where a cone has its tip and a sphere a pole.
    const double share = k % 2 ? 1 - 0.03 * unit(random) : unit(random), v = d.v.lo + share * d.v.width();
    const Vec3 n = surface->normal(u, v), x = surface->point(u, v);
    const auto point = seen(world, x + offset * n, x);
    if (!point) continue;  // outside the silhouette of a facet at a border
    ASSERT_LT(glm::length(point->normal - n), 2e-4) << "at " << u << ", " << v;
    const Vec3 across =
        (surface->point(point->u, point->v) - x) - glm::dot(surface->point(point->u, point->v) - x, n) * n;
    ASSERT_LT(glm::length(across), 2e-4);
  }
}

TEST(MeshShading, MeshesOfSurfacesHaveTrueNormals) {
  const auto sphere = std::make_shared<SphereSurface>(Frame(), 1);
  expect_true_normals(sphere, SurfacePtr(sphere), 0.1);
  const auto torus = std::make_shared<TorusSurface>(Frame(), 3, 1);
  expect_true_normals(torus, SurfacePtr(torus), 0.1);
}

// The fan of facets at a cone's tip, whose corners there have one normal each.
TEST(MeshShading, ConesHaveTrueNormalsUpToTheTip) {
  const auto side = std::make_shared<ConeSurface>(Frame(), 1, 0, 2);
  expect_true_normals(side, SurfacePtr(side), 0.1);
  expect_true_normals(side, BodyPtr(std::make_shared<Body>(frustum(Frame(), 1, 0, 2))), 0.1);
}

CurvePtr hole(double u, double v) { return std::make_shared<Circle>(Frame{{u, v, 0}}, 0.2); }

// Closed surfaces that a trim cuts open where no hole lies, away from u = 0 (and v = -pi): hits show the angles of the
// domain all the same, smooth and flat. `angles` are those of a point in space, by the arc tangent; where a facet's
// point stands off the surface a flat one may be off by what its interpolation is, 1/8 of the step's square.
void expect_own_parameters(const SurfacePtr& surface, const std::vector<CurvePtr>& holes,
                           const std::function<Vec2(const Vec3&)>& angles) {
  const auto body = std::make_shared<Body>(trimmed_surface(surface, holes, true));
  const Rectangle d = surface->domain();
  bool beyond = false;
  for (const Vec2& uv : tessellate(*body, {1e-4, kPi, {}}).parameters)
    beyond = beyond || uv.x > d.u.hi + 0.1 || uv.y > d.v.hi + 0.1;
  EXPECT_TRUE(beyond) << "the trim does not move the seam: nothing is tested";
  auto flat_model = model_of(BodyPtr(body), Representation::mesh, 1e-4);
  flat_model->objects[0].flat_shading = true;
  const World smooth(model_of(BodyPtr(body), Representation::mesh, 1e-4)), flat(flat_model),
      direct(model_of(BodyPtr(body)));
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.002, 0.998);  // at the seam itself 0 is as good as 2 pi
  int found = 0;
  for (int k = 0; k < 4000; ++k) {
    const double u = d.u.lo + unit(random) * d.u.width(), v = d.v.lo + unit(random) * d.v.width();
    const Vec3 n = surface->normal(u, v), x = surface->point(u, v);
    for (const auto& [world, error] : {std::pair{&smooth, 1e-4}, {&flat, 3e-3}, {&direct, 1e-12}}) {
      const auto point = seen(*world, x + 0.1 * n, x);
      if (!point || glm::length(point->position - x) > 1e-3) continue;  // through a hole
      const Vec2 expected = angles(point->position);
      ASSERT_NEAR(point->u, expected.x, error) << "at " << u << ", " << v;
      ASSERT_NEAR(point->v, expected.y, error) << "at " << u << ", " << v;
      ++found;
    }
  }
  EXPECT_GT(found, 9000);
}

double turn_from(double start, double angle) { return angle < start ? angle + kTwoPi : angle; }

TEST(MeshShading, TrimmedClosedSurfacesKeepTheirOwnParameters) {
  const auto cylinder = std::make_shared<CylinderSurface>(Frame{}, 1, 3);
  std::vector<CurvePtr> holes;
  for (int k = 0; k < 6; ++k) holes.push_back(hole(k * kPi / 3, 0.6));
  expect_own_parameters(cylinder, holes,
                        [](const Vec3& p) { return Vec2(turn_from(0, std::atan2(p.y, p.x)), p.z / 3); });

  const auto torus = std::make_shared<TorusSurface>(Frame{}, 3, 1);
  holes.clear();
  for (int k = 0; k < 6; ++k) holes.push_back(hole(k * kPi / 3, k % 2 == 0 ? kPi : 0));
  expect_own_parameters(torus, holes, [start = torus->domain().v.lo](const Vec3& p) {
    return Vec2(turn_from(0, std::atan2(p.y, p.x)), turn_from(start, std::atan2(p.z, std::hypot(p.x, p.y) - 3)));
  });
}

}  // namespace
}  // namespace lekalo::render::mesh_shading_test
