// PNG files: levels come back exactly; the chunks are those of the PNG specification; sRGB by IEC 61966-2-1.
#include "render/image/png.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/image/display.h"
#include "render/image/image_error.h"
#include "render/image/temporary_folder.h"

namespace lekalo::render::png_test {
namespace {

DisplayImage ramp(int channels, int bits) {
  DisplayImage image{.width = 19, .height = 7, .channels = channels, .bits = bits, .samples = {}, .text = {}};
  const unsigned levels = (1u << bits) - 1;
  for (int i = 0; i < image.width * image.height * channels; ++i) {
    image.samples.push_back(static_cast<std::uint16_t>((static_cast<unsigned>(i) * 2654435761u >> 7) % (levels + 1)));
  }
  image.samples[0] = 0;
  image.samples[1] = static_cast<std::uint16_t>(levels);
  return image;
}

class PngFormats : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(PngFormats, LevelsComeBackExactly) {
  const auto [channels, bits] = GetParam();
  const TemporaryFolder folder;
  const DisplayImage image = ramp(channels, bits);
  write_png(folder / "a.png", image);
  const Image read = read_png(folder / "a.png", SampleEncoding::raw);
  EXPECT_TRUE(read.low_dynamic_range);
  ASSERT_EQ(read.channels.size(), static_cast<std::size_t>(channels));
  const double largest = (1 << bits) - 1;
  for (std::size_t i = 0; i < read.pixel_count(); ++i) {
    for (std::size_t c = 0; c < read.channels.size(); ++c) {
      EXPECT_EQ(std::lround(read.channels[c].values[i] * largest), image.samples[i * read.channels.size() + c]);
    }
  }
  EXPECT_EQ(read.channels[0].name, channels <= 2 ? "Y" : "R");
  EXPECT_EQ(find_channel(read, "A") != nullptr, channels % 2 == 0);
}

INSTANTIATE_TEST_SUITE_P(All, PngFormats,
                         testing::Values(std::pair{1, 8}, std::pair{2, 8}, std::pair{3, 8}, std::pair{4, 8},
                                         std::pair{1, 16}, std::pair{2, 16}, std::pair{3, 16}, std::pair{4, 16}));

TEST(Png, LinearReadingDecodesAndAssociatesAlpha) {
  const TemporaryFolder folder;
  write_png(folder / "a.png",
            {.width = 1, .height = 1, .channels = 4, .bits = 8, .samples = {255, 188, 10, 51}, .text = {}});
  const Image image = read_png(folder / "a.png");
  // 188/255 encodes 0.50289 of full light (the known value of half light is 187.5), 10/255 lies on the straight part.
  EXPECT_NEAR(find_channel(image, "R")->values[0], 0.2, 1e-7);
  EXPECT_NEAR(find_channel(image, "G")->values[0], 0.2 * 0.5028865, 1e-7);
  EXPECT_NEAR(find_channel(image, "B")->values[0], 0.2 * 10 / 255 / 12.92, 1e-8);
  EXPECT_NEAR(find_channel(image, "A")->values[0], 0.2, 1e-7);
}

TEST(Png, HasTheStatedChunksAndTheSameBytesEachTime) {
  const TemporaryFolder folder;
  DisplayImage image = ramp(3, 8);
  image.text = {{"Software", "lekalo"}, {"scene", "кольцо.yaml"}};
  write_png(folder / "a.png", image);
  write_png(folder / "b.png", image);
  const std::string bytes = file_bytes(folder / "a.png");
  EXPECT_EQ(bytes, file_bytes(folder / "b.png"));
  std::vector<std::string> chunks;
  for (std::size_t at = 8; at + 8 <= bytes.size();) {
    std::size_t length = 0;
    for (int i = 0; i < 4; ++i)
      length = length << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
    chunks.push_back(bytes.substr(at + 4, 4));
    at += length + 12;
  }
  EXPECT_EQ(chunks, (std::vector<std::string>{"IHDR", "sRGB", "iTXt", "iTXt", "IDAT", "IEND"}));
  const Image read = read_png(folder / "a.png");
  EXPECT_EQ(read.metadata.at("scene"), MetadataValue("кольцо.yaml"));
}

TEST(Png, RowsCanBeStreamedAndAnUnfinishedFileDoesNotExist) {
  const TemporaryFolder folder;
  const DisplayImage image = ramp(3, 16);
  write_png(folder / "whole.png", image);
  {
    PngWriter writer(folder / "cut.png", image);
    writer.write_row(image.samples.data());
  }
  PngWriter writer(folder / "rows.png", image);
  for (int y = 0; y < image.height; ++y) writer.write_row(image.samples.data() + y * image.width * 3);
  writer.finish();
  EXPECT_EQ(file_bytes(folder / "whole.png"), file_bytes(folder / "rows.png"));
  EXPECT_EQ(folder.entry_count(), 2u);
}

TEST(Png, DamagedFilesEndInAMessage) {
  const TemporaryFolder folder;
  write_png(folder / "a.png", ramp(3, 8));
  const std::string bytes = file_bytes(folder / "a.png");
  EXPECT_THROW(read_png(folder / "none.png"), ImageError);
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{4}, std::size_t{20}, bytes.size() / 2, bytes.size() - 14}) {
    write_bytes(folder / "cut.png", bytes.substr(0, length));
    EXPECT_THROW(read_png(folder / "cut.png"), ImageError) << length;
  }
  std::string flipped = bytes;
  flipped[100] = static_cast<char>(flipped[100] ^ 0x55);
  write_bytes(folder / "flipped.png", flipped);
  EXPECT_THROW(read_png(folder / "flipped.png"), ImageError);
  EXPECT_THROW(write_png(folder / "none/a.png", ramp(3, 8)), ImageError);
  if (std::filesystem::exists("/dev/full")) {
    try {
      write_png("/dev/full", ramp(4, 16));
      FAIL();
    } catch (const ImageError& error) {
      EXPECT_NE(std::string(error.what()).find("No space left"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace lekalo::render::png_test
