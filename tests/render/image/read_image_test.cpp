// Reading by content: pictures of other formats are made by hand from their format's definition.
#include "render/image/read_image.h"

#include <gtest/gtest.h>

#include <cstring>

#include "render/image/display.h"
#include "render/image/exr.h"
#include "render/image/image_error.h"
#include "render/image/temporary_folder.h"
#include "support/planes.h"

namespace lekalo::render::read_image_test {
namespace {

TEST(ReadImage, DecidesByTheFirstBytes) {
  const TemporaryFolder folder;
  Image image = make_image(2, 1);
  checks::set(add_channel(image, "Y"), {0.25f, 7.0f});
  write_exr(folder / "picture.png", image);
  EXPECT_EQ(read_image(folder / "picture.png").channels[0].values, image.channels[0].values);
  write_png(folder / "picture.exr", {.width = 1, .height = 1, .channels = 1, .bits = 8, .samples = {128}, .text = {}});
  EXPECT_FLOAT_EQ(read_image(folder / "picture.exr").channels[0].values[0],
                  static_cast<float>(srgb_decode(128 / 255.0)));
}

TEST(ReadImage, IntegerSamplesOfOtherFormatsAreSrgb) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.ppm", std::string("P6\n2 1\n255\n\xff\x80\x0a\x00\x01\x02", 17));
  const Image image = read_image(folder / "a.ppm");
  EXPECT_TRUE(image.low_dynamic_range);
  ASSERT_TRUE(has_color(image));
  const ColorPlanes planes = color_planes(image);
  EXPECT_FLOAT_EQ(planes.r[0], 1);
  EXPECT_FLOAT_EQ(planes.g[0], static_cast<float>(srgb_decode(128 / 255.0)));
  EXPECT_FLOAT_EQ(planes.b[0], static_cast<float>(srgb_decode(10 / 255.0)));
  EXPECT_FLOAT_EQ(color_planes(read_image(folder / "a.ppm", SampleEncoding::raw)).g[0], 128 / 255.0f);
}

TEST(ReadImage, FloatingPointFormatsAreLinearAlready) {
  const TemporaryFolder folder;
  // PFM: little-endian floats, the lowest row first.
  const float rows[2][3] = {{1, 2, 3}, {4, 5, 6}};
  std::string bytes = "PF\n1 2\n-1.0\n";
  bytes.append(reinterpret_cast<const char*>(rows), sizeof rows);
  write_bytes(folder / "a.pfm", bytes);
  const Image image = read_image(folder / "a.pfm");
  EXPECT_FALSE(image.low_dynamic_range);
  EXPECT_EQ(color_planes(image).r[0], 4);
  EXPECT_EQ(color_planes(image).b[1], 3);
}

TEST(ReadImage, SaysWhyAFileCannotBeRead) {
  const TemporaryFolder folder;
  write_bytes(folder / "notes.txt", "not a picture");
  for (const char* name : {"none.jpg", "notes.txt", "."}) {
    try {
      read_image(folder / name);
      FAIL() << name;
    } catch (const ImageError& error) {
      EXPECT_NE(std::string(error.what()).find("cannot read: "), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace lekalo::render::read_image_test
