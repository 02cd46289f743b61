// PNG files (ISO/IEC 15948, W3C PNG Specification): display values, 8 or 16 bits, marked as sRGB.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "render/image/image.h"

namespace lekalo::render {

// Pixels as a display shows them: integers, usually in the sRGB encoding (IEC 61966-2-1), alpha not multiplied in.
struct DisplayImage {
  int width = 0, height = 0;
  int channels = 3;                    // 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha
  int bits = 8;                        // 8 or 16
  bool is_srgb = true;                 // else for a display that the file does not name
  std::vector<std::uint16_t> samples;  // width * height * channels numbers in 0 .. 2^bits - 1, row by row from the top
  std::map<std::string, std::string> text;  // keyword (1 to 79 Latin-1 characters) -> UTF-8 text
};

// What read_png makes of the numbers of a file.
enum class SampleEncoding {
  linear,  // decoded from sRGB to linear Rec.709, colours multiplied by alpha: as everywhere in an Image
  raw      // number / (2^bits - 1) and nothing else: normal maps, heights, and pictures that are compared as stored
};

// Channels R G B (or Y for a grey file) and A if there is transparency; grey of 1, 2 and 4 bits and palettes are
// expanded. gAMA, cHRM and iCCP chunks are not applied. Text chunks become metadata. Throws ImageError: unreadable,
// damaged, more than kMaximumPixels.
Image read_png(const std::filesystem::path& path, SampleEncoding encoding = SampleEncoding::linear);

// Writes a file row by row, atomically: it exists only after finish(). Deterministic: the chunks are IHDR, sRGB
// (perceptual intent; only of pictures that are), the texts, IDAT, IEND. Throws ImageError.
class PngWriter {
 public:
  // `format` gives size, channels, bits and text; its samples are not looked at.
  PngWriter(const std::filesystem::path& path, const DisplayImage& format);
  ~PngWriter();

  // The next row from the top: width * channels numbers.
  void write_row(const std::uint16_t* samples);
  // Requires that all rows have been written.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

void write_png(const std::filesystem::path& path, const DisplayImage& image);

}  // namespace lekalo::render
