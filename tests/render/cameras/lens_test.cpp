// Thin lenses: what is in focus stays a point, what is not becomes the opening's picture.
#include <gtest/gtest.h>

#include <cmath>

#include "render/cameras/cameras.h"
#include "render/samplers/sampler.h"

namespace lekalo::render::lens_test {
namespace {

PerspectiveView view(const Lens& lens) {
  PerspectiveView view{{0, -10, 0}, {0, 0, 0}, {0, 0, 1}, 0.6, {}};
  view.lens = lens;
  return view;
}

TEST(Lens, SharpPlaneIsSharp) {
  const CameraPtr camera = make_camera(view({.radius = 0.5, .focus = 10}), 200, 100);
  ASSERT_TRUE(camera->has_lens());
  SampleStream random(0, 0, 0, 64, 1);
  for (int i = 0; i < 64; ++i) {
    const Ray ray = camera->lens_ray(150, 20, random.next_pair());
    EXPECT_NEAR(glm::length(ray.direction), 1, 1e-15);
    const Vec3 met = ray.at((0 - ray.origin.y) / ray.direction.y);  // in the plane y = 0
    const PicturePoint seen = camera->project(met);
    EXPECT_NEAR(seen.x, 150, 1e-9);
    EXPECT_NEAR(seen.y, 20, 1e-9);
    EXPECT_LE(glm::length(ray.origin - Vec3(0, -10, 0)), 0.5 + 1e-12);
    EXPECT_NEAR(ray.origin.y, -10, 1e-12);
  }
}

// At twice the distance of the focus a point is blurred by a disc of the lens's own size.
TEST(Lens, BlursByItsLaw) {
  const CameraPtr camera = make_camera(view({.radius = 0.5, .focus = 10}), 200, 100);
  double farthest = 0;
  SampleStream random(0, 0, 0, 400, 1);
  for (int i = 0; i < 400; ++i) {
    const Ray ray = camera->lens_ray(100, 50, random.next_pair());
    const Vec3 met = ray.at((10 - ray.origin.y) / ray.direction.y);
    farthest = std::max(farthest, glm::length(Vec3(met.x, 0, met.z)));
  }
  EXPECT_LE(farthest, 0.5 + 1e-12);
  EXPECT_GT(farthest, 0.48);
}

// The mean square distance from the middle of a regular polygon with corners at 1 is (2 + cos(2 pi / n)) / 6, of a disc
// 1/2.
TEST(Lens, BladesMakeAPolygonThatIsEvenlyCovered) {
  for (const int blades : {0, 3, 5, 8}) {
    const CameraPtr camera = make_camera(view({.radius = 1, .focus = 10, .blades = blades, .rotation = 0.3}), 200, 100);
    double sum = 0, most = 0;
    constexpr int kSide = 200;
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        const Ray ray = camera->lens_ray(100, 50, {(i + 0.5) / kSide, (j + 0.5) / kSide});
        const double x = ray.origin.x, z = ray.origin.z;
        sum += (x * x + z * z) / (kSide * kSide);
        most = std::max(most, std::hypot(x, z));
      }
    const double expected = blades == 0 ? 0.5 : (2 + std::cos(geometry::kTwoPi / blades)) / 6;
    EXPECT_NEAR(sum, expected, 2e-3) << blades;
    EXPECT_LE(most, 1);
  }
}

TEST(Lens, OfNoWidthIsNone) {
  EXPECT_FALSE(make_camera(view({}), 20, 10)->has_lens());
  EXPECT_THROW(make_camera(view({.radius = 0.1, .focus = 0}), 20, 10), std::invalid_argument);
}

}  // namespace
}  // namespace lekalo::render::lens_test
