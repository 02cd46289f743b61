#include "render/image/exr.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfTestFile.h>
#include <ImfThreading.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>

#if defined(__GNUC__) && defined(__x86_64__)
#include <immintrin.h>
#endif

#include "render/image/atomic_file.h"
#include "render/image/image_error.h"

namespace lekalo::render {
namespace {

// OpenEXR's own threads pay only for large pictures: starting them costs about as much as packing 300 x 300 pixels.
constexpr std::size_t kThreadedPixels = std::size_t{1} << 17;

void use_threads(std::size_t pixels) {
  const int threads = pixels < kThreadedPixels ? 0 : tbb::this_task_arena::max_concurrency();
  if (threads > Imf::globalThreadCount()) Imf::setGlobalThreadCount(threads);
}

// OpenEXR writes offsets into the beginning of the file at the end, hence the seeking.
class AtomicStream : public Imf::OStream {
 public:
  AtomicStream(AtomicFile& file, const std::string& name) : Imf::OStream(name.c_str()), file_(file) {}
  void write(const char bytes[], int count) override { file_.write(bytes, static_cast<std::size_t>(count)); }
  std::uint64_t tellp() override { return file_.position(); }
  void seekp(std::uint64_t position) override { file_.seek(position); }

 private:
  AtomicFile& file_;
};

Imf::PixelType stored_type(PixelType type) {
  switch (type) {
    case PixelType::half:
      return Imf::HALF;
    case PixelType::uint32:
      return Imf::UINT;
    case PixelType::float32:
      break;
  }
  return Imf::FLOAT;
}

// Finite numbers beyond the range of half become its largest.
half to_half(float v) {
  constexpr float kLargest = HALF_MAX;
  return half(std::isfinite(v) ? std::clamp(v, -kLargest, kLargest) : v);
}

// Imath converts one number after the other; processors with F16C take eight at a time, with the same rounding.
#if defined(__GNUC__) && defined(__x86_64__)
__attribute__((target("avx,f16c"))) std::size_t convert_eights(const float* from, half* to, std::size_t count) {
  const __m256 largest = _mm256_set1_ps(HALF_MAX), infinity = _mm256_set1_ps(INFINITY);
  const __m256 sign = _mm256_set1_ps(-0.0f);
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8) {
    const __m256 v = _mm256_loadu_ps(from + i);
    const __m256 finite = _mm256_cmp_ps(_mm256_andnot_ps(sign, v), infinity, _CMP_LT_OQ);
    const __m256 clamped = _mm256_min_ps(_mm256_max_ps(v, _mm256_xor_ps(largest, sign)), largest);
    const __m128i bits = _mm256_cvtps_ph(_mm256_blendv_ps(v, clamped, finite), _MM_FROUND_TO_NEAREST_INT);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to + i), bits);
  }
  return i;
}
const bool has_f16c = __builtin_cpu_supports("avx") && __builtin_cpu_supports("f16c");
#else
std::size_t convert_eights(const float*, half*, std::size_t) { return 0; }
constexpr bool has_f16c = false;
#endif

void to_half(const float* from, std::vector<half>& to) {
  std::size_t i = has_f16c ? convert_eights(from, to.data(), to.size()) : 0;
  for (; i < to.size(); ++i) to[i] = to_half(from[i]);
}

// Rows of halves made and written at a time: whole blocks of compression for a few threads.
constexpr int kHalfRows = 128;

void insert_metadata(Imf::Header& header, const Image& image, const std::filesystem::path& path) {
  for (const auto& [name, value] : image.metadata) {
    if (name.empty() || header.find(name.c_str()) != header.end()) {
      throw ImageError(path, "cannot write the metadata '" + name + "': OpenEXR has its own attribute of that name",
                       "choose another name");
    }
    if (const auto* text = std::get_if<std::string>(&value)) {
      header.insert(name.c_str(), Imf::StringAttribute(*text));
    } else if (const auto* integer = std::get_if<int>(&value)) {
      header.insert(name.c_str(), Imf::IntAttribute(*integer));
    } else {
      const double number = std::get<double>(value);
      const float rounded = static_cast<float>(number);
      if (static_cast<double>(rounded) == number) {
        header.insert(name.c_str(), Imf::FloatAttribute(rounded));
      } else {
        header.insert(name.c_str(), Imf::DoubleAttribute(number));
      }
    }
  }
}

void extract_metadata(const Imf::Header& header, Image& image) {
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
    const Imf::Attribute& value = attribute.attribute();
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&value)) {
      image.metadata[attribute.name()] = text->value();
    } else if (const auto* integer = dynamic_cast<const Imf::IntAttribute*>(&value)) {
      image.metadata[attribute.name()] = integer->value();
    } else if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&value)) {
      image.metadata[attribute.name()] = static_cast<double>(number->value());
    } else if (const auto* precise = dynamic_cast<const Imf::DoubleAttribute*>(&value)) {
      image.metadata[attribute.name()] = precise->value();
    }
  }
  // These two are in every header and say nothing about a picture with square pixels.
  image.metadata.erase("pixelAspectRatio");
  image.metadata.erase("screenWindowWidth");
}

// Width and height of a window of a header that may be damaged.
std::int64_t extent(int first, int last) { return std::int64_t{last} - first + 1; }

Image read_checked(const std::filesystem::path& path) {
  Imf::InputFile file(path.c_str());
  const Imf::Header& header = file.header();
  const Imath::Box2i data = header.dataWindow();
  const Imath::Box2i display = header.displayWindow();
  const std::int64_t width = extent(data.min.x, data.max.x);
  const std::int64_t height = extent(data.min.y, data.max.y);
  if (width < 1 || height < 1 || width > kMaximumPixels || height > kMaximumPixels || width * height > kMaximumPixels) {
    throw ImageError(path, "claims to have " + std::to_string(width) + " x " + std::to_string(height) + " pixels",
                     kTooManyPixels);
  }
  std::int64_t pixel_bytes = 0;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    pixel_bytes += channel.channel().type == Imf::HALF ? 2 : 4;
  }
  // The other methods may pack an even picture tighter than deflate.
  const bool deflate = header.compression() <= Imf::ZIP_COMPRESSION;
  if (deflate && static_cast<double>(width * height * pixel_bytes) >
                     kLargestDeflateRatio * static_cast<double>(std::filesystem::file_size(path))) {
    throw ImageError(path, "is too short for its " + std::to_string(width) + " x " + std::to_string(height) + " pixels",
                     "the file is damaged or incomplete");
  }
  Image image = make_image(static_cast<int>(width), static_cast<int>(height));
  image.x = data.min.x - display.min.x;
  image.y = data.min.y - display.min.y;
  image.full_width = static_cast<int>(extent(display.min.x, display.max.x));
  image.full_height = static_cast<int>(extent(display.min.y, display.max.y));
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) {
      throw ImageError(path, std::string("channel '") + channel.name() + "' does not have a value for every pixel",
                       "convert it to plain RGB");
    }
    const Imf::PixelType type = channel.channel().type;
    add_channel(image, channel.name(),
                type == Imf::HALF   ? PixelType::half
                : type == Imf::UINT ? PixelType::uint32
                                    : PixelType::float32);
  }
  Imf::FrameBuffer frame_buffer;
  for (Channel& channel : image.channels) {
    const bool integer = channel.type == PixelType::uint32;
    void* base = integer ? static_cast<void*>(channel.ids.data()) : static_cast<void*>(channel.values.data());
    frame_buffer.insert(channel.name, Imf::Slice::Make(integer ? Imf::UINT : Imf::FLOAT, base, data));
  }
  use_threads(image.pixel_count());
  file.setFrameBuffer(frame_buffer);
  file.readPixels(data.min.y, data.max.y);
  extract_metadata(header, image);
  return image;
}

void write_checked(const std::filesystem::path& path, const Image& image, AtomicFile& file) {
  const int full_width = image.full_width > 0 ? image.full_width : image.width;
  const int full_height = image.full_height > 0 ? image.full_height : image.height;
  const Imath::Box2i display({0, 0}, {full_width - 1, full_height - 1});
  const Imath::Box2i data({image.x, image.y}, {image.x + image.width - 1, image.y + image.height - 1});
  Imf::Header header(display, data);
  header.compression() = Imf::ZIP_COMPRESSION;
  bool has_halves = false;
  for (const Channel& channel : image.channels) {
    if (header.channels().findChannel(channel.name) != nullptr) {
      throw ImageError(path, "cannot write two channels of the name '" + channel.name + "'", "rename one of them");
    }
    header.channels().insert(channel.name, Imf::Channel(stored_type(channel.type)));
    has_halves = has_halves || channel.type == PixelType::half;
  }
  insert_metadata(header, image, path);
  use_threads(image.pixel_count());
  AtomicStream stream(file, path.string());
  Imf::OutputFile output(stream, header);
  std::vector<std::vector<half>> halves(image.channels.size());
  const int rows_at_once = has_halves ? kHalfRows : image.height;
  for (int row = 0; row < image.height; row += rows_at_once) {
    const int rows = std::min(rows_at_once, image.height - row);
    const std::size_t first = static_cast<std::size_t>(row) * image.width;
    const Imath::Box2i part({data.min.x, data.min.y + row}, {data.max.x, data.min.y + row + rows - 1});
    Imf::FrameBuffer frame_buffer;
    for (std::size_t c = 0; c < image.channels.size(); ++c) {
      const Channel& channel = image.channels[c];
      const void* base = nullptr;
      switch (channel.type) {
        case PixelType::float32:
          base = &channel.values[first];
          break;
        case PixelType::uint32:
          base = &channel.ids[first];
          break;
        case PixelType::half:
          halves[c].resize(static_cast<std::size_t>(rows) * image.width);
          to_half(&channel.values[first], halves[c]);
          base = halves[c].data();
          break;
      }
      frame_buffer.insert(channel.name, Imf::Slice::Make(stored_type(channel.type), base, part));
    }
    output.setFrameBuffer(frame_buffer);
    output.writePixels(rows);
  }
}

}  // namespace

Image read_exr(const std::filesystem::path& path) {
  if (!std::ifstream(path, std::ios::binary)) {
    throw ImageError(path, std::string("cannot read: ") + std::strerror(errno), "check the name and the permissions");
  }
  bool tiled = false, deep = false;
  if (!Imf::isOpenExrFile(path.c_str(), tiled, deep)) {
    throw ImageError(path, "is not an OpenEXR file", "check that it was written completely and is not renamed");
  }
  if (deep) throw ImageError(path, "has deep pixels (several samples each)", "flatten it first");
  try {
    return read_checked(path);
  } catch (const ImageError&) {
    throw;
  } catch (const std::exception& error) {
    throw ImageError(path, std::string("cannot read: ") + error.what(), "the file is damaged or incomplete");
  }
}

void write_exr(const std::filesystem::path& path, const Image& image) {
  if (image.channels.empty()) throw ImageError(path, "cannot write a picture without channels", "add one");
  AtomicFile file(path);
  try {
    write_checked(path, image, file);
  } catch (const ImageError&) {
    throw;
  } catch (const std::exception& error) {
    throw ImageError(path, std::string("cannot write: ") + error.what(), "check the folder and the disk");
  }
  file.commit();
}

}  // namespace lekalo::render
