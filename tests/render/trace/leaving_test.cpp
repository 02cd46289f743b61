// Rays that leave a point of a surface, and shadow rays to a light: what the World leaves out of their tests (the face
// or piece that they left, obstacles that cannot stand in the way) never changes what they meet.
#include <gtest/gtest.h>

#include <random>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/surfaces/analytic/cone.h"
#include "geometry/surfaces/analytic/ellipsoid.h"
#include "geometry/surfaces/analytic/plane.h"
#include "geometry/surfaces/analytic/sphere.h"
#include "geometry/surfaces/analytic/torus.h"
#include "geometry/surfaces/splines/bezier_surface.h"
#include "render/trace/world.h"
#include "support/tier.h"

namespace lekalo::render::leaving_test {
namespace {

using namespace geometry;

class Leaving : public testing::Test {
 protected:
  std::mt19937_64 random_{31};
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> unit_{0, 1};

  double uniform(double a, double b) { return a + (b - a) * unit_(random_); }
  Vec3 any_point(double reach) {
    const double x = uniform(-reach, reach), y = uniform(-reach, reach);
    return {x, y, uniform(-reach, reach)};
  }
  Vec3 any_direction() {
    const double x = normal_(random_), y = normal_(random_);
    return glm::normalize(Vec3(x, y, normal_(random_)));
  }
  // Turned, stretched and every third time mirrored.
  Affine any_place(int i) {
    Affine map;
    const Vec3 z = any_direction();
    const Frame frame = frame_about(Vec3(0), z);
    map.linear = Mat3(uniform(0.5, 2) * frame.x, uniform(0.5, 2) * frame.y, (i % 3 == 0 ? -1.0 : 1.0) * frame.z);
    map.offset = any_point(3);
    return map;
  }
  SurfacePtr any_surface(int i) {
    const Frame frame = frame_about(any_point(2), any_direction());
    switch (i % 7) {
      case 0:
        return std::make_shared<SphereSurface>(frame, uniform(0.5, 1.5), Rectangle{{0, 4}, {-1, 1.5}});
      case 1:
        return std::make_shared<TorusSurface>(frame, 1, 0.4);
      case 2:
        return std::make_shared<ConeSurface>(frame, 1, uniform(-1, 1), i % 2 ? 2 : -2);
      case 3:
        return std::make_shared<Ellipsoid>(frame, Vec3(1, 0.5, 1.5));
      case 4:
        return std::make_shared<Plane>(frame, Rectangle{{-1, 1}, {-1, 2}});
      case 5:
        return std::make_shared<CylinderSurface>(frame, 0.7, 2);
      default: {
        Grid<Vec3> points{4, 4, {}};
        for (int k = 0; k < 16; ++k)
          points.values.push_back(frame.point(Vec3(k / 4 - 1.5, k % 4 - 1.5, normal_(random_))));
        return std::make_shared<NurbsSurface>(bezier_surface(points));
      }
    }
  }
  std::shared_ptr<World> any_world(int objects, bool placed, bool ground = true) {
    auto model = std::make_shared<Model>();
    for (int i = 0; i < objects; ++i) {
      Object object;
      if (i % 8 == 7)
        object.shape = std::make_shared<const Body>(ball(Frame{any_point(2)}, uniform(0.3, 1)));
      else
        object.shape = any_surface(i + static_cast<int>(random_() % 7));
      if (placed) object.transform = any_place(i);
      model->objects.push_back(std::move(object));
    }
    if (ground)
      model->objects.emplace_back().shape = std::make_shared<Plane>(frame_about(Vec3(0, 0, -4), Vec3(0, 0, 1)));
    return std::make_shared<World>(model);
  }
};

// Beyond a thousandth of the scene the ray meets the same with what it left as without.
TEST_F(Leaving, RaysMeetTheSameAsIfNothingWereLeft) {
  int rays = 0, met = 0, for_good = 0, lost = 0;
  for (int n = 0; n < tests::tier_count(1000, 24); ++n) {
    const auto world = any_world(n % 2 ? 3 : 12, n % 3 == 0);
    for (int k = 0; k < 400; ++k) {
      Ray first;
      first.origin = any_point(6);
      first.direction = glm::normalize(any_point(2) - first.origin);
      Hit hit;
      if (!world->nearest(first, hit)) continue;
      const SurfacePoint point = world->surface_point(first, hit);
      Ray ray;
      ray.direction = any_direction();
      if (std::abs(glm::dot(ray.direction, point.geometric_normal)) < 1e-3) continue;
      ray.kind = k % 2 ? RayKind::reflection : RayKind::shadow;
      world->leave(point, ray.direction, ray);
      ray.t_min = 1e-3;
      for_good += ray.left_for_good;
      Ray plain = ray;
      plain.left_instance = -1;
      Hit a, b;
      const bool left = world->nearest(ray, a), all = world->nearest(plain, b);
      ++rays;
      met += all;
      lost += left != all || (left && (a.t != b.t || a.instance != b.instance));
      EXPECT_EQ(world->occluded(ray), left);
    }
  }
  EXPECT_EQ(lost, 0) << "of " << rays;
  EXPECT_GT(for_good, rays / 5);
  EXPECT_GT(met, rays / 4);
  tests::report_figure("rays", rays);
  tests::report_figure("changed", lost);
}

// Rays to the places of a box are occluded by what was listed for the box, and by nothing else.
TEST_F(Leaving, ObstaclesAreAllThatOccludes) {
  int rays = 0, clear = 0, occluded = 0, wrong = 0;
  for (int n = 0; n < tests::tier_count(1000, 24); ++n) {
    const auto world = any_world(n % 2 ? 3 : 12, n % 3 == 0, n % 4 < 2);
    for (int k = 0; k < 100; ++k) {
      Box3 places;
      const Vec3 at = any_point(8);
      for (int corner = 0; corner < 2; ++corner) places.include(at + any_point(k % 5 == 0 ? 0 : 0.6));
      Ray ray;
      ray.kind = RayKind::shadow;
      ray.origin = any_point(4);
      const Obstacles obstacles = world->obstacles(ray, places);
      clear += obstacles.none();
      for (int i = 0; i < 10; ++i) {
        const Vec3 to = places.lo + Vec3(unit_(random_), unit_(random_), unit_(random_)) * places.size() - ray.origin;
        ray.t_max = glm::length(to);
        ray.direction = to / ray.t_max;
        const bool is_occluded = world->occluded(ray);
        ++rays;
        occluded += is_occluded;
        wrong += world->occluded(ray, obstacles) != is_occluded;
      }
    }
  }
  EXPECT_EQ(wrong, 0) << "of " << rays;
  EXPECT_GT(clear, rays / 100);
  EXPECT_GT(occluded, rays / 10);
  tests::report_figure("rays", rays);
  tests::report_figure("wrong", wrong);
}

}  // namespace
}  // namespace lekalo::render::leaving_test
