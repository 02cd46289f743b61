// Textures by hand-worked places, random normals by their law.
#include "render/materials/textures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/materials/normal_deviation.h"
#include "support/planes.h"

namespace lekalo::render::textures_test {
namespace {

SurfacePoint at(double u, double v) {
  SurfacePoint point;
  point.u = u;
  point.v = v;
  point.du = {1, 0, 0};
  point.dv = {0, 1, 0};
  point.incoming = {0, 0, -1};
  return point;
}

TEST(Checker, AlternatesFromTheOffset) {
  const TexturePtr checker =
      make_texture(Checker{.spacing = {2, 1}, .offset = {0.5, 0}, .color = 1.0, .background = 0.0});
  EXPECT_EQ(checker->at(at(0.6, 0.1))[0], 1);
  EXPECT_EQ(checker->at(at(2.6, 0.1))[0], 0);
  EXPECT_EQ(checker->at(at(2.6, 1.1))[0], 1);
  EXPECT_EQ(checker->at(at(0.4, 0.1))[0], 0);
  EXPECT_EQ(checker->at(at(0.4, -0.1))[0], 1);
  EXPECT_NE(checker->cell(at(0.6, 0.1)), checker->cell(at(2.6, 0.1)));
}

TEST(Checker, MayHoldTextures) {
  const TexturePtr inner = make_texture(Checker{.spacing = {0.5, 0.5}, .color = 0.25, .background = 0.75});
  const TexturePtr outer = make_texture(Checker{.color = inner, .background = 0.0});
  EXPECT_EQ(outer->at(at(0.2, 0.2))[0], 0.25f);
  EXPECT_EQ(outer->at(at(0.7, 0.2))[0], 0.75f);
  EXPECT_EQ(outer->at(at(1.2, 0.2))[0], 0);
}

TEST(Grid, RulesLinesOfTheGivenWidth) {
  const TexturePtr grid =
      make_texture(GridLines{.spacing = {5, 5}, .width = {0.4, 0.4}, .color = 0.0, .background = 1.0});
  EXPECT_EQ(grid->at(at(0.19, 2.5))[0], 0);
  EXPECT_EQ(grid->at(at(0.21, 2.5))[0], 1);
  EXPECT_EQ(grid->at(at(-4.85, 2.5))[0], 0);
  EXPECT_EQ(grid->at(at(2.5, 10.1))[0], 0);
  EXPECT_EQ(grid->at(at(2.5, 12.5))[0], 1);
}

TEST(ParameterLines, HaveTheirWidthInPixelsWhateverTheScaleAndTheView) {
  const TexturePtr lines =
      make_texture(ParameterLines{.spacing = {1, geometry::kInfinity}, .width = 1.5, .color = 1.0, .background = 0.0});
  for (const double scale : {1.0, 20.0}) {
    for (const double tilt : {0.0, 1.0}) {
      SurfacePoint point = at(0, 0.3);
      point.du = {scale, 0.4, 0};
      point.dv = {0, 2, 0};
      point.pixel_size = 0.01;
      point.incoming = glm::normalize(Vec3(-tilt, 0, -1));
      // Pixels across the picture that the line covers: the integral of its coverage.
      const double pixels_per_u = scale * -point.incoming.z / point.pixel_size;
      double width = 0;
      const double step = 0.01 / pixels_per_u;
      for (int i = -400; i <= 400; ++i) {
        point.u = 7 + i * step;
        width += lines->at(point)[0] * step * pixels_per_u;
      }
      EXPECT_NEAR(width, 1.5, 1e-3) << scale << ' ' << tilt;
    }
  }
}

Image two_by_two() {
  Image image = make_image(2, 2);
  for (const char* name : {"R", "G", "B"}) checks::set(add_channel(image, name), {0.1f, 0.2f, 0.3f, 0.4f});
  return image;
}

TEST(ImageTexture, MapsThePictureUprightIntoItsSpacing) {
  ImageTexture texture{.image = two_by_two(), .spacing = {2, 4}, .smooth = false};
  const TexturePtr picture = make_texture(texture);
  EXPECT_EQ(picture->at(at(0.5, 3))[0], 0.1f);  // upper left
  EXPECT_EQ(picture->at(at(1.5, 3))[0], 0.2f);
  EXPECT_EQ(picture->at(at(0.5, 1))[0], 0.3f);
  EXPECT_EQ(picture->at(at(2.5, 5))[0], 0.3f);  // repeated
}

TEST(ImageTexture, WrapsAsAsked) {
  const auto left_of_picture = [](Wrap wrap) {
    ImageTexture texture{.image = two_by_two(), .wrap = wrap, .smooth = false};
    texture.background = 0.9;
    return make_texture(texture)->at(at(-0.75, 0.75))[0];
  };
  EXPECT_EQ(left_of_picture(Wrap::repeat), 0.1f);
  EXPECT_EQ(left_of_picture(Wrap::mirror), 0.2f);
  EXPECT_EQ(left_of_picture(Wrap::clamp), 0.1f);
  EXPECT_EQ(left_of_picture(Wrap::background), 0.9f);
}

TEST(ImageTexture, InterpolatesBetweenPixelCentres) {
  ImageTexture texture{.image = two_by_two(), .wrap = Wrap::clamp};
  const TexturePtr picture = make_texture(texture);
  EXPECT_FLOAT_EQ(picture->at(at(0.5, 0.5))[1], 0.25f);
  EXPECT_FLOAT_EQ(picture->at(at(0.25, 0.75))[1], 0.1f);
  EXPECT_FLOAT_EQ(picture->at(at(0.375, 0.75))[1], 0.125f);
  EXPECT_THROW(make_texture(ImageTexture{.image = make_image(1, 1)}), std::invalid_argument);
}

TEST(NormalDeviation, IsUnitRepeatableBoundedAndUnbiased) {
  const NormalDeviation rough{.amplitude = 0.2, .spacing = {0.1, 0.1}, .seed = 3};
  Vec3 sum(0);
  const int n = 100;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3 m = deviated_normal(at(0.05 + 0.1 * i, 0.05 + 0.1 * j), rough);
      EXPECT_NEAR(glm::length(m), 1, 1e-15);
      EXPECT_LE(std::sqrt(1 - m.z * m.z) / m.z, 0.2 * std::sqrt(2.0) + 1e-12);
      sum += m;
    }
  // The mean of n^2 uniform numbers in [-0.2, 0.2] has the deviation 0.2 / sqrt(3) / n.
  EXPECT_LT(std::fabs(sum.x) / (n * n), 4 * 0.2 / std::sqrt(3.0) / n);
  EXPECT_LT(std::fabs(sum.y) / (n * n), 4 * 0.2 / std::sqrt(3.0) / n);
  EXPECT_EQ(deviated_normal(at(0.31, 0.31), rough), deviated_normal(at(0.39, 0.39), rough));
  EXPECT_NE(deviated_normal(at(0.31, 0.31), rough), deviated_normal(at(0.41, 0.31), rough));
  EXPECT_EQ(deviated_normal(at(0.31, 0.31), {}), Vec3(0, 0, 1));
}

}  // namespace
}  // namespace lekalo::render::textures_test
