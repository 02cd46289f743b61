// Cameras: round trips, the foreshortenings that name the axonometric views, exact framing.
#include "render/cameras/cameras.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/curves/analytic/circle.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "geometry/tessellation/tessellate.h"
#include "render/small_scene.h"

namespace lekalo::render::cameras_test {
namespace {

using geometry::Box3;
using geometry::kPi;

std::vector<Vec3> corners(const Box3& box) { return FramedContent(box).points(); }

void check_round_trip(const Camera& camera) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 100; ++i) {
    const double x = unit(random) * camera.width(), y = unit(random) * camera.height(), t = 1 + 20 * unit(random);
    const Ray ray = camera.ray(x, y);
    EXPECT_NEAR(glm::length(ray.direction), 1, 1e-15);
    const PicturePoint back = camera.project(ray.at(t));
    EXPECT_NEAR(back.x, x, 1e-9);
    EXPECT_NEAR(back.y, y, 1e-9);
    EXPECT_NEAR(back.depth, t, 1e-12 * t);
    EXPECT_TRUE(back.visible_side);
    // Two rays a pixel apart are a pixel size apart, where they meet the plane across the view.
    const Ray next = camera.ray(x + 1, y);
    const Vec3 axis = camera.ray(0.5 * camera.width(), 0.5 * camera.height()).direction;
    const Vec3 p = ray.at(t);
    const Vec3 q = next.at(glm::dot(p - next.origin, axis) / glm::dot(next.direction, axis));
    if (!camera.is_parallel()) {
      EXPECT_NEAR(glm::length(q - p), camera.pixel_size(p), 1e-9);
    }
  }
}

TEST(Cameras, ProjectUndoesRay) {
  check_round_trip(*make_camera(PerspectiveView{{3, -7, 2}, {0.5, 0, 0.25}, {0, 0, 1}, 0.7}, 300, 200));
  check_round_trip(*make_camera(ParallelView{{3, -7, 2}, {0.5, 0, 0.25}, {0, 0, 1}, 5}, 300, 200));
  for (const std::string& name : view_names())
    check_round_trip(*make_view_camera(preset_view(name), 200, 300, corners({{-1, -2, -3}, {2, 1, 1}}), 0.1));
}

TEST(Cameras, UpperLeftPixelIsFirst) {
  const CameraPtr camera = make_camera(PerspectiveView{}, 200, 100);
  const Ray corner = camera->ray(0, 0);
  EXPECT_LT(corner.direction.x, 0);
  EXPECT_GT(corner.direction.z, 0);
  EXPECT_LT(glm::length(camera->ray(100, 50).direction - Vec3(0, 1, 0)), 1e-15);
}

TEST(Cameras, FieldOfViewIsThatOfTheShorterSide) {
  const PerspectiveView view{{0, -1, 0}, {0, 0, 0}, {0, 0, 1}, kPi / 2};
  EXPECT_NEAR(make_camera(view, 200, 100)->project({0, 0, 1}).y, 0, 1e-12);
  EXPECT_NEAR(make_camera(view, 100, 200)->project({1, 0, 0}).x, 100, 1e-12);
}

TEST(Cameras, CentralProjectionOfTheBook) {
  // Golovanov 2016, 8.5: eye at (0, 0, w) above the picture plane z = 0; x' = x w / (w - z). w = 5.
  const CameraPtr camera = make_camera(PerspectiveView{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 2 * std::atan(0.2)}, 2, 2);
  // The picture of half-size 1 at z = 0 is 2 pixels wide: one pixel a unit.
  const auto place = [&](const Vec3& p) {
    const PicturePoint q = camera->project(p);
    return Vec2(q.x - 1, 1 - q.y);
  };
  EXPECT_LT(glm::length(place({2, -1, -10}) - Vec2(2.0 / 3, -1.0 / 3)), 1e-12);
  EXPECT_LT(glm::length(place({-1, 2, -2}) - Vec2(-5.0 / 7, 10.0 / 7)), 1e-12);
  EXPECT_LT(glm::length(place({0, 0, -4}) - Vec2(0)), 1e-12);
}

TEST(Cameras, UpMayBeParallelToTheView) {
  const CameraPtr camera = make_camera(PerspectiveView{{0, 0, 5}, {0, 0, 0}, {0, 0, 1}, 1}, 100, 100);
  EXPECT_LT(camera->project({0, 1, 0}).y, 50);
  EXPECT_THROW(make_camera(PerspectiveView{{1, 1, 1}, {1, 1, 1}, {0, 0, 1}, 1}, 10, 10), std::invalid_argument);
}

// Pictures of the unit vectors in scene units.
std::array<Vec2, 3> axes(const ViewDirection& view) {
  const CameraPtr camera = make_view_camera(view, 100, 100, corners({Vec3(-1), Vec3(1)}), 0);
  const auto place = [&](const Vec3& p) {
    const PicturePoint q = camera->project(p);
    return camera->pixel_size(p) * Vec2(q.x, -q.y);
  };
  std::array<Vec2, 3> result;
  for (int i = 0; i < 3; ++i) {
    Vec3 e(0);
    e[i] = 1;
    result[i] = place(e) - place(Vec3(0));
  }
  return result;
}

void expect_axes(const char* name, const Vec2& x, const Vec2& y, const Vec2& z) {
  const auto shown = axes(preset_view(name));
  EXPECT_LT(glm::length(shown[0] - x), 1e-12) << name;
  EXPECT_LT(glm::length(shown[1] - y), 1e-12) << name;
  EXPECT_LT(glm::length(shown[2] - z), 1e-12) << name;
}

TEST(Views, PrincipalViewsShowTheirAxes) {
  expect_axes("front", {1, 0}, {0, 0}, {0, 1});
  expect_axes("back", {-1, 0}, {0, 0}, {0, 1});
  expect_axes("left", {0, 0}, {-1, 0}, {0, 1});
  expect_axes("right", {0, 0}, {1, 0}, {0, 1});
  expect_axes("top", {1, 0}, {0, 1}, {0, 0});
  expect_axes("bottom", {1, 0}, {0, -1}, {0, 0});
  EXPECT_THROW(preset_view("side"), std::invalid_argument);
}

TEST(Views, AxonometricViewsHaveTheirRatios) {
  const auto isometric = axes(preset_view("isometric"));
  for (const Vec2& axis : isometric) EXPECT_NEAR(glm::length(axis), std::sqrt(2.0 / 3), 1e-12);
  const auto dimetric = axes(preset_view("dimetric"));
  EXPECT_NEAR(glm::length(dimetric[0]), std::sqrt(8.0) / 3, 1e-12);
  EXPECT_NEAR(glm::length(dimetric[2]), std::sqrt(8.0) / 3, 1e-12);
  EXPECT_NEAR(glm::length(dimetric[1]), std::sqrt(8.0) / 6, 1e-12);
  // Angles with the horizontal: 7.18 and 41.41 degrees.
  EXPECT_NEAR(std::fabs(std::atan(dimetric[0].y / dimetric[0].x)) * 180 / kPi, 7.1808, 1e-4);
  EXPECT_NEAR(std::fabs(std::atan(dimetric[1].y / dimetric[1].x)) * 180 / kPi, 41.4096, 1e-4);
  const double half = std::sqrt(0.5);
  expect_axes("cavalier", {1, 0}, {half, half}, {0, 1});
  expect_axes("cabinet", {1, 0}, {half / 2, half / 2}, {0, 1});
}

TEST(Views, AnglesMeetThePresets) {
  const double d = kPi / 180;
  const auto same = [](const ViewDirection& a, const ViewDirection& b) {
    const auto p = axes(a), q = axes(b);
    for (int i = 0; i < 3; ++i) EXPECT_LT(glm::length(p[i] - q[i]), 1e-12);
  };
  same(view_from_angles(-90 * d, 0), preset_view("front"));
  same(view_from_angles(-45 * d, std::atan(std::sqrt(0.5))), preset_view("isometric"));
  same(view_from_angles(-90 * d, 90 * d), preset_view("top"));
}

void check_framing(const CameraPtr& camera, const Box3& box, double margin) {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (const Vec3& p : corners(box)) {
    const PicturePoint q = camera->project(p);
    EXPECT_GT(q.depth, 0);
    left = std::min(left, q.x);
    right = std::max(right, q.x);
    top = std::min(top, q.y);
    bottom = std::max(bottom, q.y);
  }
  const int w = camera->width(), h = camera->height();
  const double free = margin * std::min(w, h);
  EXPECT_NEAR(std::min({left, w - right, top, h - bottom}), free, 1e-6);
  EXPECT_NEAR(left, w - right, 1e-6);
  EXPECT_NEAR(top, h - bottom, 1e-6);
}

TEST(Framing, FitsTheCornersExactly) {
  const Box3 box{{-3, 0, 1}, {4, 2, 1.5}};
  for (const auto& [w, h] : {std::pair(300, 200), std::pair(100, 400)}) {
    for (const std::string& name : view_names())
      check_framing(make_view_camera(preset_view(name), w, h, corners(box), 0.1), box, 0.1);
    for (const char* name : {"front", "isometric", "top", "left"}) {
      const std::vector<Vec3> points = corners(box);
      const PerspectiveView view = framed_perspective(preset_view(name), 0.8, w, h, points, 0.05);
      check_framing(make_camera(view, w, h), box, 0.05);
    }
  }
}

TEST(Framing, FitsTheOutlineOfABall) {
  // Interaction from outside, a ball's outline in central projection is a conic about the line of sight; framed by
  // points on the ball it fills the picture to the margin but for the grid's half a per cent.
  SmallScene scene;
  scene.add(sphere({1, 2, 3}, 2), nullptr);
  const FramedContent all(scene.model.objects);
  const PerspectiveView view = framed_perspective(preset_view("isometric"), 0.6, 200, 200, all.points(), 0.1);
  const double distance = glm::length(view.from - Vec3(1, 2, 3));
  const double outline = std::tan(std::asin(2 / distance)) / std::tan(0.3);  // share of half the picture
  EXPECT_NEAR(outline, 0.8, 0.005);
  const Vec3 sight = glm::normalize(view.at - view.from);
  EXPECT_LT(glm::length(glm::cross(Vec3(1, 2, 3) - view.from, sight)), 0.02);
}

// What planes cut away is not framed: of each kind of thing the part with x <= 0.3 of what is about the origin, where
// the object and its planes stand in a group that is turned.
TEST(Framing, LeavesOutWhatPlanesCutAway) {
  using namespace geometry;
  const auto ball = std::make_shared<Body>(geometry::ball(Frame{}, 2));
  const auto ring = std::make_shared<Circle>(Frame{}, 2.0);
  const auto block = std::make_shared<Body>(box(Frame{{-2, -2, -2}}, {4, 4, 4}));
  const MeshPtr mesh = std::make_shared<Mesh>(tessellate(*block, {}));
  const ShapePtr solid = std::make_shared<Csg>(
      Csg::Operation::unite,
      std::vector<ShapePtr>{std::make_shared<BodyShape>(block), std::make_shared<BodyShape>(ball)});
  for (const Entity& shape :
       {Entity(sphere({0, 0, 0}, 2)), Entity(ball), Entity(ring), Entity(block), Entity(mesh), Entity(solid)}) {
    Group group;
    group.objects.emplace_back();
    group.objects[0].shape = shape;
    group.objects[0].transform = Affine::translation({5, 0, 0});
    group.objects[0].clips = {{{5.3, 7, 7}, {1, 0, 0}, false}};
    Object placed;
    placed.shape = std::make_shared<const Group>(group);
    placed.transform = Affine::rotation(kPi / 2, {0, 0, 1});
    Box3 found;
    const FramedContent all(std::vector<Object>{placed});
    for (const Vec3& p : all.points()) found.include(p);
    // The group's x is the world's y.
    const double within = std::holds_alternative<ShapePtr>(shape) ? 4.0 / 32 : 0.002;
    EXPECT_NEAR(found.lo.y, 3, 0.01) << shape.index();
    EXPECT_NEAR(found.hi.y, 5.3, within) << shape.index();
    EXPECT_LE(found.hi.y, 5.3 + 1e-9) << shape.index();
    EXPECT_NEAR(found.hi.x - found.lo.x, 4, 0.02) << shape.index();
  }
}

// A model of any size, anywhere, looks the same.
TEST(Framing, KnowsNoUnit) {
  for (const double size : {1e-6, 1e-4, 1e6}) {
    std::vector<Vec3> points = corners({Vec3(-1, -2, 0), Vec3(3, 1, 2)});
    for (Vec3& p : points) p = size * (p + Vec3(40, 0, 7));
    const auto camera =
        make_camera(framed_perspective(preset_view("isometric"), 0.7, 400, 300, points, 0.05), 400, 300);
    double lo = 400, hi = 0, top = 300, bottom = 0;
    for (const Vec3& p : points) {
      const PicturePoint at = camera->project(p);
      lo = std::min(lo, at.x), hi = std::max(hi, at.x), top = std::min(top, at.y), bottom = std::max(bottom, at.y);
    }
    EXPECT_NEAR(std::min({lo, 400 - hi, top, 300 - bottom}), 15, 1e-3) << size;
  }
}

TEST(Framing, CopesWithAPointAndWithNothing) {
  const CameraPtr one = make_view_camera(preset_view("front"), 100, 100, corners({Vec3(3), Vec3(3)}), 0.1);
  EXPECT_NEAR(one->project(Vec3(3)).x, 50, 1e-9);
  const CameraPtr none = make_view_camera(preset_view("front"), 100, 100, corners({}), 0.1);
  EXPECT_NEAR(none->project(Vec3(0)).x, 50, 1e-9);
  const CameraPtr near =
      make_camera(framed_perspective(preset_view("front"), 0.7, 100, 100, std::vector<Vec3>{Vec3(3)}, 0.1), 100, 100);
  EXPECT_NEAR(near->project(Vec3(3)).y, 50, 1e-9);
}

}  // namespace
}  // namespace lekalo::render::cameras_test
