// Points of surfaces that know their foot points, in a World that keeps no parameters: the same points and normals as
// with parameters, but for rounding, and parameters where a material asks for them.
#include <gtest/gtest.h>

#include <random>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/ellipsoid.h"
#include "geometry/surfaces/analytic/hyperboloid.h"
#include "geometry/surfaces/analytic/paraboloid.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "render/materials/materials.h"
#include "render/materials/textures.h"
#include "render/trace/world.h"

namespace lekalo::render::bare_hits_test {
namespace {

using namespace geometry;

std::shared_ptr<Model> model_of(const std::vector<SurfacePtr>& surfaces, const MaterialPtr& material,
                                const Affine& map) {
  auto model = std::make_shared<Model>();
  for (const SurfacePtr& surface : surfaces) {
    Object object;
    object.shape = surface;
    object.material = material;
    object.transform = map;
    model->objects.push_back(object);
  }
  return model;
}

std::vector<SurfacePtr> surfaces() {
  const Frame frame = frame_about({0.3, -0.2, 0.4}, glm::normalize(Vec3(1, 2, 3)));
  auto inside_out = std::make_shared<SphereSurface>(Frame{Vec3(-2, 1, 0)}, 0.9);
  inside_out->set_reversed(true);
  return {std::make_shared<SphereSurface>(frame, 1.2), inside_out,
          std::make_shared<SphereSurface>(Frame{Vec3(2, 1, 0)}, 0.8, Rectangle{{0, 4}, {-1, 1}}),
          std::make_shared<TorusSurface>(frame, 2.5, 0.3), std::make_shared<Plane>(Frame{Vec3(0, 0, -1.5)})};
}

// Parts of quadrics between two heights, on which the height alone tells what belongs to them; and a rectangle.
std::vector<SurfacePtr> parts() {
  const auto frame = [](const Vec3& origin) { return frame_about(origin, glm::normalize(Vec3(1, 2, 3))); };
  const Interval turn = SphereSurface::kFull.u;
  auto inside_out = std::make_shared<ConeSurface>(frame({-2, 2, 0}), 0.8, 0.3, -1.5);
  inside_out->set_reversed(true);
  return {
      std::make_shared<SphereSurface>(frame({2, 1, 0}), 0.8, Rectangle{turn, {-0.7, 1}}),
      std::make_shared<Ellipsoid>(frame({-2, -1, 1}), Vec3(0.9, 0.7, 0.8)),
      std::make_shared<Ellipsoid>(Frame{Vec3(0, 3, 0)}, Vec3(0.9, 0.7, 0.8), Rectangle{turn, {-1.2, 0.4}}),
      std::make_shared<HyperboloidOneSheet>(frame({0, 0, 0}), Vec3(0.5, 0.7, 0.8), Rectangle{turn, {-1, 1.2}}),
      std::make_shared<HyperboloidTwoSheets>(frame({3, -2, 0}), Vec3(0.5, 0.7, 0.4), Rectangle{turn, {0, 1.5}}),
      std::make_shared<HyperboloidTwoSheets>(Frame{Vec3(3, 3, 1)}, Vec3(0.7, 0.5, -0.4), Rectangle{turn, {0.3, 1.5}}),
      std::make_shared<EllipticParaboloid>(frame({-3, -3, 0}), 0.8, 0.6, Rectangle{turn, {0, 1.2}}),
      std::make_shared<EllipticParaboloid>(Frame{Vec3(0, -3, 0)}, 0.8, 0.6, Rectangle{turn, {0.4, 1.2}}),
      std::make_shared<ConeSurface>(frame({0, 2, -2}), 0.9, 0, 1.3),
      std::make_shared<ConeSurface>(frame({0, -2, -2}), 0.9, -0.9, 2),  // both nappes
      inside_out,
      std::make_shared<ConeSurface>(frame({2, -1, -2}), -0.4, -0.9, 1),
      std::make_shared<CylinderSurface>(frame({-1, 0, -3}), 0.4, 2),
      std::make_shared<Plane>(frame({1, 1, 3}), Rectangle{{-1, 1}, {-1, 2}})};
}

TEST(BareHits, PointsAndNormalsAreTheSame) {
  const MaterialPtr plain = make_material(Diffuse{});
  Affine placed;
  placed.linear = Mat3(Vec3(1.5, 0.2, 0), Vec3(0, 0.5, 0.1), Vec3(0.3, 0, -2));
  placed.offset = {3, -1, 0.5};
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  const auto any = [&](double scale) {
    const double x = scale * normal(random), y = scale * normal(random);
    return Vec3(x, y, scale * normal(random));
  };
  std::vector<SurfacePtr> all = surfaces();
  for (const SurfacePtr& part : parts()) all.push_back(part);
  for (const Affine& map : {Affine(), placed}) {
    const auto model = model_of(all, plain, map);
    const World bare(model, false), full(model);
    int met = 0;
    for (int k = 0; k < 20000; ++k) {
      Ray ray;
      ray.origin = any(k % 2 ? 4 : 400);
      ray.direction = glm::normalize(any(2) - ray.origin);
      Hit a, b;
      const bool found = full.nearest(ray, a);
      ASSERT_EQ(bare.nearest(ray, b), found);
      if (!found) continue;
      ++met;
      EXPECT_EQ(a.t, b.t);
      EXPECT_EQ(a.instance, b.instance);
      const SurfacePoint p = full.surface_point(ray, a), q = bare.surface_point(ray, b);
      EXPECT_LE(glm::length(p.position - q.position), p.error);
      EXPECT_LE(glm::length(p.normal - q.normal), 10 * p.error);
      EXPECT_LE(glm::length(p.geometric_normal - q.geometric_normal), 10 * p.error);
      EXPECT_NEAR(p.error, q.error, 1e-9 * p.error);
      EXPECT_EQ(p.convex_sides.front, q.convex_sides.front);
      EXPECT_EQ(p.convex_sides.back, q.convex_sides.back);
      if (!all[a.instance]->has_closest_point()) {
        EXPECT_EQ(p.u, q.u);
        EXPECT_EQ(p.v, q.v);
      } else {
        EXPECT_EQ(q.u, 0);
        EXPECT_EQ(q.v, 0);
      }
      Ray shadow = ray;
      shadow.kind = RayKind::shadow;
      EXPECT_TRUE(bare.occluded(shadow));
      shadow.t_max = a.t * (1 - 1e-9);
      EXPECT_FALSE(bare.occluded(shadow));
    }
    EXPECT_GT(met, 5000);
  }
}

TEST(BareHits, ATextureKeepsTheParameters) {
  Diffuse checkered;
  checkered.color = make_texture(Checker{});
  const auto model = model_of(surfaces(), make_material(checkered), Affine());
  const World bare(model, false), full(model);
  Ray ray;
  ray.origin = {0.4, -5, 0.6};
  ray.direction = {0, 1, 0};
  Hit a, b;
  ASSERT_TRUE(full.nearest(ray, a));
  ASSERT_TRUE(bare.nearest(ray, b));
  EXPECT_NE(a.u, 0);
  EXPECT_EQ(a.u, b.u);
  EXPECT_EQ(a.v, b.v);
}

// At the borders of parts the height does not decide alone.
TEST(BareHits, PartsEndWhereTheyDoWithParameters) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit;
  for (const SurfacePtr& surface : parts()) {
    const Rectangle domain = surface->domain();
    for (int k = 0; k < 4000; ++k) {
      const bool top = unit(random) < 0.5;
      const double off = k % 4 == 0 ? 0 : std::pow(10, -16 * unit(random)) * (unit(random) - 0.5);
      const Vec3 at =
          surface->point(domain.u.lo + domain.u.width() * unit(random), (top ? domain.v.hi : domain.v.lo) + off);
      const Vec3 from = Vec3(unit(random), unit(random), unit(random)) * 8.0 - 4.0;
      const Line line{from, glm::normalize(at - from)};
      LineHits with(false, true), without(false, false);
      surface->line_hits(line, Interval::entire(), with);
      surface->line_hits(line, Interval::entire(), without);
      ASSERT_EQ(with.size(), without.size());
      for (int i = 0; i < with.size(); ++i) EXPECT_EQ(with[i].t, without[i].t);
    }
  }
}

TEST(BareHits, SolidsOfSolids) {
  const auto shape = [](Body body) { return std::make_shared<BodyShape>(std::make_shared<Body>(std::move(body))); };
  const Frame frame = frame_about({0.3, -0.2, 0.4}, glm::normalize(Vec3(1, 2, 3)));
  const auto solid = std::make_shared<Csg>(
      Csg::Operation::subtract, std::vector<ShapePtr>{shape(ball(Frame{}, 1.5)), shape(frustum(frame, 0.6, 0.2, 2)),
                                                      shape(box(frame, {2, 0.5, 0.6})), shape(ball(frame, 0.7))});
  auto model = std::make_shared<Model>();
  Object object;
  object.shape = ShapePtr(solid);
  object.material = make_material(Diffuse{});
  model->objects.push_back(object);
  const World bare(model, false), full(model);
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  int met = 0;
  for (int k = 0; k < 20000; ++k) {
    const auto any = [&] {
      const double x = normal(random), y = normal(random);
      return Vec3(x, y, normal(random));
    };
    Ray ray;
    ray.origin = 5.0 * any();
    ray.direction = glm::normalize(any() - ray.origin);
    Hit a, b;
    ASSERT_EQ(full.nearest(ray, a), bare.nearest(ray, b));
    if (a.instance < 0) continue;
    ++met;
    EXPECT_EQ(a.t, b.t);
    EXPECT_EQ(a.face, b.face);
    const SurfacePoint p = full.surface_point(ray, a), q = bare.surface_point(ray, b);
    EXPECT_LE(glm::length(p.position - q.position), p.error);
    EXPECT_LE(glm::length(p.normal - q.normal), 10 * p.error);
  }
  EXPECT_GT(met, 5000);
}

TEST(BareHits, FeetOfAllTheirPoints) {
  for (const SurfacePtr& surface : surfaces()) {
    if (!surface->has_closest_point()) continue;
    for (double u = 0.1; u < 6; u += 0.3)
      for (double v = -1.5; v < 1.5; v += 0.2) {
        const Vec3 p = surface->point(u, v);
        const FootPoint foot_point = surface->foot_point(p);
        EXPECT_LE(glm::length(foot_point.point - p), 1e-14);
        EXPECT_LE(glm::length(foot_point.normal - surface->normal(u, v)), 1e-14);
      }
  }
  for (const SurfacePtr& surface : parts()) {
    if (!surface->has_closest_point()) continue;
    const Rectangle domain = surface->domain();
    for (double u = 0.1; u < 6; u += 0.3)
      for (double s = 0.01; s < 1; s += 0.1) {
        const double v = domain.v.lo + s * domain.v.width();
        const Vec3 p = surface->point(u, v);
        const FootPoint foot_point = surface->foot_point(p);
        EXPECT_LE(glm::length(foot_point.point - p), 1e-14);
        EXPECT_LE(glm::length(foot_point.normal - surface->normal(u, v)), 1e-13);
      }
  }
}

}  // namespace
}  // namespace lekalo::render::bare_hits_test
