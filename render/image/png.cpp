#include "render/image/png.h"

#include <png.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "render/image/atomic_file.h"
#include "render/image/display.h"
#include "render/image/image_error.h"

// libpng reports errors by a long jump. Every function that can be jumped out of therefore has only plain numbers and
// pointers as locals; what needs a destructor lives in the State of its caller.

namespace lekalo::render {
namespace {

constexpr const char* kDamaged = "the file is damaged or incomplete";

// More than libpng needs for a row (at most a million pixels) or an honest chunk. A damaged length must not make it
// take 2 GB for a comment; its own limit only warns.
constexpr png_alloc_size_t kLargestAllocation = png_alloc_size_t{1} << 26;

// Texts and the like, unpacked: longer and further ones are left out. libpng itself would keep 8 GB of them.
constexpr png_alloc_size_t kLongestChunk = png_alloc_size_t{1} << 20;
constexpr png_uint_32 kMaxChunks = 64;

png_voidp allocate(png_structp, png_alloc_size_t size) {
  return size > kLargestAllocation ? nullptr : std::malloc(size);
}
void release(png_structp, png_voidp memory) { std::free(memory); }

// Of renderings each pixel less the one before (PNG_FILTER_SUB) packs about as well as the best filter of each row,
// which libpng would look for. Packing takes a quarter of the time at libpng's defaults (level 6, all filters), for 5
// to 20% more bytes.
constexpr int kCompressionLevel = 3;
constexpr int kFilter = PNG_FILTER_SUB;

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

// Frees libpng's reading structures and the file on every way out.
struct Reader {
  std::string message;
  std::FILE* file = nullptr;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::vector<png_byte> bytes;
  std::vector<png_bytep> rows;

  explicit Reader(const std::filesystem::path& path) : file(std::fopen(path.c_str(), "rbe")) {
    if (file == nullptr) {
      throw ImageError(path, std::string("cannot read: ") + std::strerror(errno), "check the name and the permissions");
    }
    png = png_create_read_struct_2(PNG_LIBPNG_VER_STRING, &message, on_error, on_warning, nullptr, allocate, release);
    info = png == nullptr ? nullptr : png_create_info_struct(png);
    if (png == nullptr) return;
    png_set_chunk_malloc_max(png, kLongestChunk);
    png_set_chunk_cache_max(png, kMaxChunks);
  }
  ~Reader() {
    png_destroy_read_struct(&png, &info, nullptr);
    if (file != nullptr) std::fclose(file);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
};

// Reads the header and asks for 8 or 16 bits of grey or RGB with or without alpha. False: error.
bool read_header(Reader& reader) {
  if (reader.info == nullptr || setjmp(png_jmpbuf(reader.png))) return false;
  png_init_io(reader.png, reader.file);
  png_read_info(reader.png, reader.info);
  if (png_get_color_type(reader.png, reader.info) == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(reader.png);
  png_set_expand_gray_1_2_4_to_8(reader.png);
  if (png_get_valid(reader.png, reader.info, PNG_INFO_tRNS)) png_set_tRNS_to_alpha(reader.png);
  png_set_swap(reader.png);  // 16-bit numbers in the machine's order (all supported ones are little-endian)
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

bool read_rows(Reader& reader) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  png_read_image(reader.png, reader.rows.data());
  png_read_end(reader.png, reader.info);
  return true;
}

double sample_at(const png_byte* row, std::size_t i, int bits) {
  if (bits == 8) return row[i] / 255.0;
  std::uint16_t value;
  std::memcpy(&value, row + 2 * i, sizeof value);
  return value / 65535.0;
}

void extract_text(Reader& reader, Image& image) {
  png_textp text = nullptr;
  int count = 0;
  png_get_text(reader.png, reader.info, &text, &count);
  for (int i = 0; i < count; ++i) image.metadata[text[i].key] = std::string(text[i].text ? text[i].text : "");
}

}  // namespace

Image read_png(const std::filesystem::path& path, SampleEncoding encoding) {
  Reader reader(path);
  if (!read_header(reader)) throw ImageError(path, "cannot read: " + reader.message, kDamaged);
  const auto width = png_get_image_width(reader.png, reader.info);
  const auto height = png_get_image_height(reader.png, reader.info);
  const int bits = png_get_bit_depth(reader.png, reader.info);
  const std::size_t channels = png_get_channels(reader.png, reader.info);
  if (std::int64_t{width} * height > kMaximumPixels) {
    throw ImageError(path, "has " + std::to_string(width) + " x " + std::to_string(height) + " pixels", kTooManyPixels);
  }
  const std::size_t row_bytes = png_get_rowbytes(reader.png, reader.info);
  // Palettes and low bit depths are expanded by at most 32 (1 bit to RGBA).
  if (static_cast<double>(row_bytes) * height >
      32 * kLargestDeflateRatio * static_cast<double>(std::filesystem::file_size(path))) {
    throw ImageError(path, "is too short for its " + std::to_string(width) + " x " + std::to_string(height) + " pixels",
                     kDamaged);
  }
  reader.bytes.resize(row_bytes * height);
  for (std::size_t y = 0; y < height; ++y) reader.rows.push_back(reader.bytes.data() + y * row_bytes);
  if (!read_rows(reader)) throw ImageError(path, "cannot read: " + reader.message, kDamaged);

  Image image = make_image(static_cast<int>(width), static_cast<int>(height));
  image.low_dynamic_range = true;
  const bool alpha = channels == 2 || channels == 4;
  const std::size_t colors = alpha ? channels - 1 : channels;
  for (std::size_t c = 0; c < colors; ++c) add_channel(image, colors == 1 ? "Y" : std::string(1, "RGB"[c]));
  if (alpha) add_channel(image, "A");
  const bool linear = encoding == SampleEncoding::linear;
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t pixel = y * width + x;
      const double opacity = alpha ? sample_at(reader.rows[y], x * channels + colors, bits) : 1;
      for (std::size_t c = 0; c < colors; ++c) {
        const double value = sample_at(reader.rows[y], x * channels + c, bits);
        image.channels[c].values[pixel] = static_cast<float>(linear ? srgb_decode(value) * opacity : value);
      }
      if (alpha) image.channels[colors].values[pixel] = static_cast<float>(opacity);
    }
  }
  extract_text(reader, image);
  return image;
}

struct PngWriter::State {
  std::filesystem::path path;
  AtomicFile file;
  std::string message;
  std::exception_ptr failure;  // of the file, carried around libpng
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::size_t row_samples = 0;
  int bits = 8, rows_left = 0;
  std::vector<png_byte> row;
  std::vector<png_text> texts;

  explicit State(const std::filesystem::path& p) : path(p), file(p) {
    png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, on_error, on_warning);
    info = png == nullptr ? nullptr : png_create_info_struct(png);
  }
  ~State() { png_destroy_write_struct(&png, &info); }

  static void write_bytes(png_structp png, png_bytep bytes, png_size_t count) {
    State& state = *static_cast<State*>(png_get_io_ptr(png));
    try {
      state.file.write(bytes, count);
      return;
    } catch (...) {
      state.failure = std::current_exception();
    }
    png_error(png, "cannot write");
  }

  bool begin(const DisplayImage& format) {
    if (info == nullptr || setjmp(png_jmpbuf(png))) return false;
    constexpr int kColorTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                   PNG_COLOR_TYPE_RGB_ALPHA};
    png_set_write_fn(png, this, write_bytes, nullptr);
    png_set_compression_level(png, kCompressionLevel);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, kFilter);
    png_set_IHDR(png, info, static_cast<png_uint_32>(format.width), static_cast<png_uint_32>(format.height),
                 format.bits, kColorTypes[format.channels - 1], PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (format.is_srgb) png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    if (!texts.empty()) png_set_text(png, info, texts.data(), static_cast<int>(texts.size()));
    png_write_info(png, info);
    if (format.bits == 16) png_set_swap(png);
    return true;
  }

  bool write() {
    if (setjmp(png_jmpbuf(png))) return false;
    png_write_row(png, row.data());
    return true;
  }

  bool end() {
    if (setjmp(png_jmpbuf(png))) return false;
    png_write_end(png, info);
    return true;
  }

  [[noreturn]] void fail() {
    if (failure) std::rethrow_exception(failure);
    throw ImageError(path, "cannot write: " + message, "check the size and the texts of the picture");
  }
};

PngWriter::PngWriter(const std::filesystem::path& path, const DisplayImage& format)
    : state_(std::make_unique<State>(path)) {
  assert(format.channels >= 1 && format.channels <= 4 && (format.bits == 8 || format.bits == 16));
  State& state = *state_;
  state.bits = format.bits;
  state.rows_left = format.height;
  state.row_samples = static_cast<std::size_t>(format.width) * static_cast<std::size_t>(format.channels);
  state.row.resize(state.row_samples * static_cast<std::size_t>(format.bits / 8));
  for (const auto& [keyword, text] : format.text) {
    png_text entry{};
    entry.compression = PNG_ITXT_COMPRESSION_NONE;
    entry.key = const_cast<char*>(keyword.c_str());
    entry.text = const_cast<char*>(text.c_str());
    entry.itxt_length = text.size();
    state.texts.push_back(entry);
  }
  if (!state.begin(format)) state.fail();
  state.texts.clear();
}

PngWriter::~PngWriter() = default;

void PngWriter::write_row(const std::uint16_t* samples) {
  State& state = *state_;
  assert(state.rows_left > 0);
  --state.rows_left;
  if (state.bits == 16) {
    std::memcpy(state.row.data(), samples, state.row.size());
  } else {
    std::transform(samples, samples + state.row_samples, state.row.begin(),
                   [](std::uint16_t v) { return static_cast<png_byte>(v); });
  }
  if (!state.write()) state.fail();
}

void PngWriter::finish() {
  assert(state_->rows_left == 0);
  if (!state_->end()) state_->fail();
  state_->file.commit();
}

void write_png(const std::filesystem::path& path, const DisplayImage& image) {
  PngWriter writer(path, image);
  const std::size_t row_samples = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
  for (int y = 0; y < image.height; ++y) {
    writer.write_row(image.samples.data() + static_cast<std::size_t>(y) * row_samples);
  }
  writer.finish();
}

}  // namespace lekalo::render
