// Points of surfaces that know their feet, in a World that keeps no parameters: the same points and normals as with
// parameters, but for rounding, and parameters where a material asks for them.
#include <gtest/gtest.h>

#include <random>

#include "geometry/bodies/primitives.h"
#include "geometry/surfaces/plane.h"
#include "geometry/surfaces/sphere.h"
#include "geometry/surfaces/torus.h"
#include "render/materials/materials.h"
#include "render/materials/textures.h"
#include "render/trace/world.h"

namespace lekalo::render {
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
  for (const Affine& map : {Affine(), placed}) {
    const auto model = model_of(surfaces(), plain, map);
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
      EXPECT_EQ(p.free_sides.front, q.free_sides.front);
      EXPECT_EQ(p.free_sides.back, q.free_sides.back);
      if (glm::length(p.du) > 0 && a.instance >= 2 && a.instance <= 3) {  // part of a sphere, torus
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

TEST(BareHits, FeetOfAllTheirPoints) {
  for (const SurfacePtr& surface : surfaces()) {
    if (!surface->knows_feet()) continue;
    for (double u = 0.1; u < 6; u += 0.3)
      for (double v = -1.5; v < 1.5; v += 0.2) {
        const Vec3 p = surface->point(u, v);
        const Foot foot = surface->foot(p);
        EXPECT_LE(glm::length(foot.point - p), 1e-14);
        EXPECT_LE(glm::length(foot.normal - surface->normal(u, v)), 1e-14);
      }
  }
}

}  // namespace
}  // namespace lekalo::render
