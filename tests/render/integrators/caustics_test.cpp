// Photons against closed forms and against brute force.
#include "render/integrators/caustics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/integrators/path.h"
#include "tests/render/small_scene.h"

namespace lekalo::render {
namespace {

using geometry::kPi;

struct Estimate {
  double mean, error;
};

// Mean of the floor's radiance over the square of half side `half` about `middle`, by as many pictures of n x n places;
// each with photons of its own.
Estimate floor_radiance(SmallScene scene, const PathOptions& options, const Vec3& middle, double half, int pictures,
                        int n, int samples) {
  double sum = 0, squares = 0;
  for (int picture = 0; picture < pictures; ++picture) {
    scene.model.film.seed = static_cast<uint32_t>(picture);
    auto model = std::make_shared<Model>(scene.model);
    model->integrator = make_path_integrator(options);
    const World world(model);
    const IntegratorPtr prepared = model->integrator->prepared(world);
    const Integrator& integrator = prepared ? *prepared : *model->integrator;
    double mean = 0;
    for (int i = 0; i < n * n; ++i) {
      const Vec3 place = middle + half * Vec3((2 * (i % n) + 1.0) / n - 1, (2 * (i / n) + 1.0) / n - 1, 0);
      Ray ray;
      ray.origin = place + Vec3(0, -0.002, 0.001);  // from just above, below everything that stands there
      ray.direction = glm::normalize(place - ray.origin);
      Hit first;
      if (!world.nearest(ray, first)) first.instance = -1;
      for (int s = 0; s < samples; ++s) {
        SampleStream random(static_cast<uint32_t>(i), static_cast<uint32_t>(picture), static_cast<uint32_t>(s),
                            static_cast<uint32_t>(samples), 3);
        mean += integrator.trace(world, ray, first, random).radiance[0] / (n * n * samples);
      }
    }
    sum += mean;
    squares += mean * mean;
  }
  const double mean = sum / pictures;
  return {mean, std::sqrt(std::max(0.0, squares / pictures - mean * mean) / std::max(1, pictures - 1))};
}

SmallScene floor_of(double albedo) {
  SmallScene scene;
  geometry::Frame frame;
  scene.add(plane_part(frame, {-20, 20}, {-20, 20}), make_material(Diffuse{.color = albedo}));
  return scene;
}

MaterialPtr mirror(double reflectance) {
  ClassicLook look;
  look.diffuse = 0.0;
  look.ambient = 0.0;
  look.mirror = reflectance;
  return make_material(look);
}

// A mirror in the plane x = 2, above the floor's, large enough that its ball holds the lamp in some of the cases.
geometry::SurfacePtr wall(double from_y, double to_y, double height) {
  geometry::Frame frame;
  frame.origin = {2, 0, 0};
  frame.z = {-1, 0, 0};
  frame.x = {0, 1, 0};
  frame.y = {0, 0, -1};
  return plane_part(frame, {from_y, to_y}, {-height, 0});
}

// The light that a plane mirror throws is that of the lamp's image behind it.
template <class LightValues>
void expect_image(const LightValues& lamp, const LightValues& image, double half_width, double height, bool halves,
                  const char* what) {
  SmallScene mirrored = floor_of(0.5), plain = floor_of(0.5);
  if (halves) {
    mirrored.add(wall(-half_width, 0.1, height), mirror(0.8)).add(wall(0.1, half_width, height), mirror(0.8));
  } else {
    mirrored.add(wall(-half_width, half_width, height), mirror(0.8));
  }
  mirrored.light(lamp);
  plain.light(image);
  const Vec3 middle(0.5, 0.2, 0);
  const PathOptions none{.photons = 0}, some{.photons = 160000};
  // What the lamp itself gives is the same in both.
  SmallScene direct = floor_of(0.5);
  direct.light(lamp);
  const double lamp_alone = floor_radiance(direct, none, middle, 0.4, 1, 12, 16).mean;
  const double from_image = 0.8 * floor_radiance(plain, none, middle, 0.4, 1, 12, 16).mean;
  const Estimate all = floor_radiance(mirrored, some, middle, 0.4, 5, 8, 1);
  ASSERT_GT(from_image, 0);
  EXPECT_NEAR(all.mean, lamp_alone + from_image, 3 * all.error + 2e-3 * from_image) << what;
  EXPECT_LT(all.error, 0.05 * from_image) << what;
}

TEST(Caustics, MirrorThrowsTheLightOfTheImage) {
  const Lamp square{.intensity = 3, .inverse_square = true};
  expect_image(PointLight{{-1, 0, 2}, square}, PointLight{{5, 0, 2}, square}, 3, 6, false, "point");
  expect_image(PointLight{{1, 0, 2}, square}, PointLight{{3, 0, 2}, square}, 6, 9, false, "point in the mirror's ball");
  expect_image(PointLight{{-1, 0, 2}, square}, PointLight{{5, 0, 2}, square}, 3, 6, true, "mirror in two parts");
  const Vec3 down = glm::normalize(Vec3(2, 0.1, -1.5)), back(-down.x, down.y, down.z);
  expect_image(DistantLight{.direction = down, .lamp = {.intensity = 1}},
               DistantLight{.direction = back, .lamp = {.intensity = 1}}, 3, 6, false, "parallel");
  SphereLight ball{.center = {-1, 0, 2}, .radius = 0.4, .lamp = square}, image = ball;
  image.center = {5, 0, 2};
  expect_image(ball, image, 3, 6, false, "ball");
}

// Parallel light through a plane slab, all bounces within: of the faces' reflectance R, (1 - R) / (1 + R) arrives.
TEST(Caustics, SlabLetsItsTransmittanceThrough) {
  for (const double degrees : {0.0, 50.0}) {
    SmallScene scene = floor_of(0.6);
    geometry::Frame top, bottom;
    top.origin = {0, 0, 1.2};
    bottom.origin = {0, 0, 1};
    bottom.y = {0, -1, 0};
    bottom.z = {0, 0, -1};
    scene.add(SurfaceSet{plane_part(top, {-6, 6}, {-6, 6}), plane_part(bottom, {-6, 6}, {-6, 6})},
              make_material(Dielectric{.index = 1.5}));
    const double angle = degrees * kPi / 180, cosine = std::cos(angle);
    scene.light(DistantLight{.direction = {std::sin(angle), 0, -cosine}, .lamp = {.intensity = 1}});
    const double inside = std::sqrt(1 - std::pow(std::sin(angle) / 1.5, 2));
    const double s = std::pow((cosine - 1.5 * inside) / (cosine + 1.5 * inside), 2);
    const double p = std::pow((1.5 * cosine - inside) / (1.5 * cosine + inside), 2), r = 0.5 * (s + p);
    const double passed = (1 - r) / (1 + r);
    // What the floor sends back to the slab is left out.
    const PathOptions direct{.max_depth = 64, .max_scatterings = 0};
    PathOptions some = direct;
    some.photons = 100000;
    EXPECT_EQ(floor_radiance(scene, direct, {0, 0, 0}, 0.5, 1, 8, 1).mean, 0) << "nothing by chance";
    const Estimate found = floor_radiance(scene, some, {0, 0, 0}, 0.5, 16, 8, 1);
    EXPECT_NEAR(found.mean, 0.6 * cosine * passed, 3 * found.error) << degrees;
    EXPECT_LT(found.error, 0.02 * found.mean) << degrees;
  }
}

// The bright spot under a glass ball by photons, and by paths that find the lamp by chance.
TEST(Caustics, GlassBallIsTheSameByChance) {
  SmallScene scene = floor_of(0.5);
  scene.add(sphere({0, 0, 1.5}, 1), make_material(Dielectric{.index = 1.5}));
  scene.light(SphereLight{.center = {1, 0.5, 6}, .radius = 1, .lamp = {.intensity = 20, .inverse_square = true}});
  for (const double half : {0.15, 0.8}) {
    const Vec3 middle(-0.28, -0.14, 0);
    const Estimate chance = floor_radiance(scene, {.photons = 0}, middle, half, 8, 16, 64);
    const Estimate photons = floor_radiance(scene, {.photons = 60000}, middle, half, 8, 16, 1);
    const double error = std::hypot(chance.error, photons.error);
    EXPECT_NEAR(photons.mean, chance.mean, 3 * error) << half;
    EXPECT_LT(error, 0.04 * chance.mean) << half;
  }
}

// What is seen in a mirror, and lamps that send no photons, are as they were.
TEST(Caustics, MirrorsShowLampsOnce) {
  SmallScene scene;
  scene.add(plane_part({}, {-9, 9}, {-9, 9}), mirror(0.5));
  SphereLight lamp{.center = {0, 0, 5}, .radius = 1, .lamp = {.intensity = 1}};
  scene.light(lamp);
  auto model = std::make_shared<Model>(scene.model);
  model->integrator = make_path_integrator({.photons = 1000});
  const World world(model);
  const IntegratorPtr prepared = model->integrator->prepared(world);
  Ray ray;
  ray.origin = {0.5, 0, 2};
  ray.direction = glm::normalize(Vec3(-0.05, 0, -1));
  Hit first;
  ASSERT_TRUE(world.nearest(ray, first));
  SampleStream a(0, 0, 0, 1, 0), b(0, 0, 0, 1, 0);
  const Spectrum with = prepared->trace(world, ray, first, a).radiance;
  EXPECT_EQ(with[0], model->integrator->trace(world, ray, first, b).radiance[0]);
  EXPECT_GT(with[0], 0);
}

TEST(Caustics, NoneWithoutThingsThatThrowThem) {
  SmallScene scene = floor_of(0.5);
  scene.light(PointLight{.position = {0, 0, 3}});
  auto model = std::make_shared<Model>(scene.model);
  const World world(model);
  EXPECT_EQ(trace_caustics(world, {.photons = 100}), nullptr);
}

}  // namespace
}  // namespace lekalo::render
