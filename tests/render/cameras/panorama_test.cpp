#include <gtest/gtest.h>

#include <cmath>

#include "render/scene/scene_text.h"

namespace lekalo::render {
namespace {

// Of a picture 1000 pixels across and 600 high.
CameraPtr camera(const std::string& fields) {
  const BuiltText built = build_text("geometry:\n  ball: { type: ball, radius: 1 }\ncamera: { type: panorama, " +
                                     fields + " }\nimage: { size: [1000, 600] }\n");
  EXPECT_EQ(built.said, "");
  return built.model.camera;
}

// Angles, or heights, from the middle of the picture.
Vec2 place(const Camera& camera, const Vec3& point, double field_of_view) {
  const PicturePoint at = camera.project(point);
  return {(at.x - 500) / 1000 * field_of_view, (300 - at.y) / 1000 * field_of_view};
}

// Zavyalov et al. 1985, VI.1: the eye at Z = -5, a point (1, 2, 3) of the picture's coordinates. Here X is to the
// right, Z forward along y, Y up along z.
TEST(Panorama, PlacesOfThePointOfTheSource) {
  const Vec3 point{1, 3, 2};
  const std::string eye = "from: [0, -5, 0], at: [0, 0, 0], field_of_view: 90";
  const double width = 0.5 * geometry::kPi;
  const Vec2 sphere = place(*camera(eye + ", onto: sphere"), point, width);
  EXPECT_NEAR(sphere.x, 0.1243549945, 1e-10);
  EXPECT_NEAR(sphere.y, 0.2449786631, 1e-10);
  const Vec2 cylinder = place(*camera(eye + ", onto: cylinder"), point, width);
  EXPECT_NEAR(cylinder.x, 0.1243549945, 1e-10);
  EXPECT_NEAR(cylinder.y, 0.2480694692, 1e-10);
}

TEST(Panorama, RaysMeetWhatTheyShow) {
  for (const char* onto : {"sphere", "cylinder", "longitude_latitude", "fisheye"}) {
    const CameraPtr one = camera(std::string("from: [1, 2, 3], at: [4, 5, 1], onto: ") + onto);
    for (const double x : {3.0, 411.5, 500.0, 990.0})
      for (const double y : {250.0, 300.0, 377.0}) {
        const Ray ray = one->ray(x, y);
        EXPECT_NEAR(glm::length(ray.direction), 1, 1e-15);
        const PicturePoint back = one->project(ray.origin + 2.5 * ray.direction);
        EXPECT_NEAR(back.x, x, 1e-9) << onto;
        EXPECT_NEAR(back.y, y, 1e-9) << onto;
        EXPECT_NEAR(back.depth, 2.5, 1e-14);
        EXPECT_TRUE(back.visible_side);
      }
  }
}

TEST(Panorama, ALookAllRoundSeesWhatIsBehind) {
  const CameraPtr one = camera("from: [0, 0, 0], at: [0, 1, 0]");
  EXPECT_NEAR(one->project({0, 1, 0}).x, 500, 1e-12);
  EXPECT_NEAR(one->project({1, 0, 0}).x, 750, 1e-12);
  EXPECT_NEAR(std::abs(one->project({1e-13, -1, 0}).x - 500), 500, 1e-9);
  EXPECT_FALSE(camera("from: [0, 0, 0], at: [0, 1, 0], onto: sphere")->project({0, -1, 0}).visible_side);
}

TEST(Panorama, Errors) {
  const auto said = [](const std::string& fields) {
    return build_text("camera: { type: panorama, " + fields + " }\n").said;
  };
  EXPECT_NE(said("from: [0, 0, 0], at: [0, 0, 0]").find("stands at the point"), std::string::npos);
  EXPECT_NE(said("from: [0, 0, 0], onto: sphere, field_of_view: 180").find("before the eye"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::render
