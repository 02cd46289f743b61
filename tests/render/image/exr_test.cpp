// OpenEXR files: what is written is read again bit for bit (half: IEEE 754 binary16 rounding), and damaged files end in
// a message.
#include "render/image/exr.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <limits>

#include "render/image/image_error.h"
#include "render/image/temporary_folder.h"

namespace lekalo::render::exr_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Image all_layers() {
  Image image = make_image(37, 21);
  image.x = 5;
  image.y = 3;
  image.full_width = 64;
  image.full_height = 48;
  for (const char* name : {"R", "G", "B", "A"}) add_channel(image, name, PixelType::half);
  for (const char* name : {"Z", "N.X", "N.Y", "N.Z", "uv.U", "uv.V"}) add_channel(image, name);
  add_channel(image, "id.object", PixelType::uint32);
  unsigned state = 1;
  for (Channel& channel : image.channels) {
    for (float& v : channel.values) v = static_cast<float>((state = state * 1664525u + 1013904223u) >> 21) / 64.0f;
    for (std::uint32_t& id : channel.ids) id = state = state * 1664525u + 1013904223u;
  }
  find_channel(image, "Z")->values[7] = kInfinity;
  image.metadata = {{"scene", "primer/teapot.yaml"}, {"samples", 64}, {"tube", 0.1}, {"half_turn", 0.5}};
  return image;
}

std::string message_of(const std::filesystem::path& path) {
  try {
    read_exr(path);
  } catch (const ImageError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Exr, EveryChannelTypeWindowAndMetadataComesBack) {
  const TemporaryFolder folder;
  const Image image = all_layers();
  write_exr(folder / "a.exr", image);
  const Image read = read_exr(folder / "a.exr");
  EXPECT_EQ(read.width, 37);
  EXPECT_EQ(read.height, 21);
  EXPECT_EQ(read.x, 5);
  EXPECT_EQ(read.y, 3);
  EXPECT_EQ(read.full_width, 64);
  EXPECT_EQ(read.full_height, 48);
  EXPECT_EQ(read.metadata, image.metadata);
  EXPECT_FALSE(read.low_dynamic_range);
  ASSERT_EQ(read.channels.size(), image.channels.size());
  for (const Channel& channel : image.channels) {
    const Channel* same = find_channel(read, channel.name);
    ASSERT_NE(same, nullptr) << channel.name;
    EXPECT_EQ(same->type, channel.type);
    EXPECT_EQ(same->values, channel.values);  // multiples of 1/64 below 32 are exact in half
    EXPECT_EQ(same->ids, channel.ids);
  }
  EXPECT_EQ(non_finite_count(read), 1u);
}

TEST(Exr, HalfRoundsToNearestAndKeepsFiniteValuesFinite) {
  const TemporaryFolder folder;
  // Eleven numbers: eight are converted together, the rest one by one; so each in turn comes to stand in every place.
  const std::vector<float> given{0.1f,  70000.0f, -1e30f,   kInfinity,  2049.0f, 1e-9f,
                                 -0.0f, -2051.0f, 65519.0f, -kInfinity, 6.1e-5f};
  // binary16: 11 significant bits, largest 65504, ties to even (2049 lies between 2048 and 2050), below 2^-14 steps of
  // 2^-24.
  const std::vector<float> rounded{0.0999755859375f, 65504.0f, -65504.0f,  kInfinity,      2048.0f, 0.0f, -0.0f,
                                   -2052.0f,         65504.0f, -kInfinity, 1023 * 0x1p-24f};
  for (size_t turn = 0; turn < given.size(); ++turn) {
    Image image = make_image(static_cast<int>(given.size()), 1);
    PixelPlane<float>& values = add_channel(image, "Y", PixelType::half).values = PixelPlane<float>(given);
    PixelPlane<float> expected(rounded);
    std::rotate(values.begin(), values.begin() + turn, values.end());
    std::rotate(expected.begin(), expected.begin() + turn, expected.end());
    write_exr(folder / "half.exr", image);
    EXPECT_EQ(read_exr(folder / "half.exr").channels[0].values, expected);
  }
}

TEST(Exr, TheSameImageGivesTheSameBytes) {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", all_layers());
  write_exr(folder / "b.exr", all_layers());
  EXPECT_EQ(file_bytes(folder / "a.exr"), file_bytes(folder / "b.exr"));
  EXPECT_EQ(folder.entry_count(), 2u);
}

TEST(Exr, LargePicturesArePackedByThreadsToTheSamePixels) {
  const TemporaryFolder folder;
  Image image = make_image(800, 600);
  Channel& y = add_channel(image, "Y");
  for (std::size_t i = 0; i < y.values.size(); ++i) y.values[i] = std::sin(static_cast<float>(i));
  write_exr(folder / "a.exr", image);
  EXPECT_EQ(read_exr(folder / "a.exr").channels[0].values, image.channels[0].values);
}

TEST(Exr, NamesWhatCannotBeWritten) {
  const TemporaryFolder folder;
  Image image = make_image(2, 2);
  EXPECT_THROW(write_exr(folder / "a.exr", image), ImageError);
  add_channel(image, "Y");
  image.metadata["compression"] = "none";
  EXPECT_THROW(write_exr(folder / "a.exr", image), ImageError);
  image.metadata.clear();
  EXPECT_THROW(write_exr(folder / "none" / "a.exr", image), ImageError);
  add_channel(image, "Y");
  EXPECT_THROW(write_exr(folder / "a.exr", image), ImageError);
  EXPECT_EQ(folder.entry_count(), 0u);
}

TEST(Exr, DamagedFilesEndInAMessage) {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", all_layers());
  const std::string bytes = file_bytes(folder / "a.exr");
  EXPECT_NE(message_of(folder / "none.exr").find("No such file"), std::string::npos);
  write_bytes(folder / "text.exr", "P3 1 1 255 0 0 0");
  EXPECT_NE(message_of(folder / "text.exr").find("is not an OpenEXR file"), std::string::npos);
  for (const std::size_t length : {5u, 200u, 600u, 2000u}) {
    write_bytes(folder / "cut.exr", bytes.substr(0, length));
    EXPECT_NE(message_of(folder / "cut.exr"), "no error") << length;
  }
  // A data window of 2^31 columns in an otherwise sound header.
  std::string huge = bytes;
  const std::size_t window = huge.find("dataWindow") + std::string("dataWindow\0box2i\0\0\0\0\0", 22).size() - 1;
  huge.replace(window + 8, 4, std::string("\xff\xff\xff\x7f", 4));
  write_bytes(folder / "huge.exr", huge);
  EXPECT_NE(message_of(folder / "huge.exr"), "no error");
}

}  // namespace
}  // namespace lekalo::render::exr_test
