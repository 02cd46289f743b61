// OUTPUT.partial: what a stopped picture has got so far, in the machine's own byte order (it is continued by the same
// build on the same kind of machine or not at all).
//
//   "lekalo partial 3\n", instruction set (8 characters), identity, settings hash, part, number of parts, number of
//   tiles of the picture, of finished tiles, length of the job (8-byte integers), the job, tally (8-byte integers),
//   then for each tile its number, its sums (floats) where the filter needs them, and its pixels' layers that stand in
//   the image already, layer by layer, row by row; at the end the checksum of all before it.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "render/film/render.h"
#include "render/film/tiles.h"
#include "render/image/atomic_file.h"
#include "render/image/image_error.h"
#include "render/trace/device.h"

namespace lekalo::render {

namespace {

constexpr std::string_view kMagic = "lekalo partial 3\n";
constexpr const char* kRenderAnew = "render without --resume";

// FNV-1a, 64 bits.
struct Checksum {
  uint64_t value = 14695981039346656037u;
  void add(const void* bytes, size_t count) {
    const auto* next = static_cast<const unsigned char*>(bytes);
    for (size_t i = 0; i < count; ++i) value = (value ^ next[i]) * 1099511628211u;
  }
};

// As the file has it.
std::string own_instruction_set() {
  std::string name = instruction_set();
  name.resize(8);
  return name;
}

// Longer ones no command line has.
constexpr uint64_t kLongestJob = 1 << 24;
constexpr uint64_t kMaxParts = 1 << 20;

// Reads what is not cut off, and sums it up.
class Reader {
 public:
  explicit Reader(const std::string& file) : file_(file) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) in_.open(file, std::ios::binary);
    if (!in_.is_open()) throw ImageError(file, "the partial picture cannot be read", kRenderAnew);
  }

  void read(void* to, size_t bytes) {
    if (!in_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes)))
      throw ImageError(file_, "the partial picture is damaged: it ends too early", kRenderAnew);
    checksum_.add(to, bytes);
  }
  uint64_t number(uint64_t most = ~uint64_t{0}) {
    uint64_t value = 0;
    read(&value, sizeof value);
    if (value > most) throw ImageError(file_, "the partial picture is damaged", kRenderAnew);
    return value;
  }
  std::string text(size_t length) {
    std::string result(length, '\0');
    read(result.data(), length);
    return result;
  }
  uint64_t checksum() const { return checksum_.value; }
  bool at_end() { return in_.peek() == std::ifstream::traits_type::eof(); }

 private:
  const std::string& file_;
  std::ifstream in_;
  Checksum checksum_;
};

// The header, and the instruction set.
PartialHeader read_header(const std::string& file, Reader& in, std::string& set) {
  const std::string magic = in.text(kMagic.size());
  if (magic != kMagic)
    throw ImageError(file,
                     magic.starts_with(kPartialMagic) ? "the partial picture is of another version of the program"
                                                      : "this is no partial picture",
                     kRenderAnew);
  set = in.text(8);
  PartialHeader header;
  header.identity = in.number();
  header.settings = in.number();
  header.part.index = static_cast<int>(in.number(kMaxParts));
  header.part.count = static_cast<int>(in.number(kMaxParts));
  header.tiles = static_cast<int>(in.number(1 << 30));
  header.done = static_cast<int>(in.number(1 << 30));
  header.job = in.text(in.number(kLongestJob));
  return header;
}

// Calls visit(pointer, bytes) for each run of data-layer values of a tile.
template <class Visit>
void for_each_data_run(TiledFilm& film, int tile, Visit visit) {
  const Window own = intersection(film.tile(tile), film.crop());
  Image& image = film.image();
  for (size_t layer = film.first_unsummed_channel(); layer < image.channels.size(); ++layer) {
    Channel& channel = image.channels[layer];
    for (int y = own.y0; y < own.y1; ++y) {
      const size_t begin = static_cast<size_t>(y - film.crop().y0) * image.width + (own.x0 - film.crop().x0);
      if (own.width() == 0) continue;
      void* run = channel.type == PixelType::uint32 ? static_cast<void*>(&channel.ids[begin])
                                                    : static_cast<void*>(&channel.values[begin]);
      visit(run, static_cast<size_t>(own.width()) * 4);
    }
  }
}

}  // namespace

PartialHeader read_partial_header(const std::string& file) {
  Reader in(file);
  std::string set;
  return read_header(file, in, set);
}

void write_partial(const std::string& file, TiledFilm& film, const PartialHeader& header, const std::vector<int>& done,
                   const Tally& tally) {
  AtomicFile out(file);
  Checksum checksum;
  const auto write = [&](const void* bytes, size_t count) {
    checksum.add(bytes, count);
    out.write(bytes, count);
  };
  const auto number = [&](uint64_t value) { write(&value, sizeof value); };
  write(kMagic.data(), kMagic.size());
  write(own_instruction_set().data(), 8);
  for (const uint64_t value : {header.identity, film.settings_hash(), static_cast<uint64_t>(header.part.index),
                               static_cast<uint64_t>(header.part.count), static_cast<uint64_t>(film.tile_count()),
                               static_cast<uint64_t>(done.size()), static_cast<uint64_t>(header.job.size())})
    number(value);
  write(header.job.data(), header.job.size());
  for (const uint64_t value : {tally.camera_rays, tally.shadow_rays, tally.other_rays, tally.not_finite}) number(value);
  for (const int tile : done) {
    number(static_cast<uint64_t>(tile));
    const std::span<const float> values = film.sums()[tile].values;
    write(values.data(), values.size_bytes());
    for_each_data_run(film, tile, write);
  }
  number(checksum.value);
  out.commit();
}

std::vector<int> read_partial(const std::string& file, TiledFilm& film, uint64_t identity, Tally& tally) {
  Reader in(file);
  std::string set;
  const PartialHeader header = read_header(file, in, set);
  if (header.identity != identity || header.settings != film.settings_hash())
    throw ImageError(file, "the partial picture is of another scene, other settings or another version of the program",
                     "repeat the options of the first run (-o decides the layers as well), or render without --resume");
  if (set != own_instruction_set())
    throw ImageError(file,
                     fmt::format("the partial picture was made with the instruction set {}, this run has {}",
                                 set.c_str(), instruction_set()),
                     fmt::format("add --isa {}, or render without --resume", set.c_str()));
  Tally of_file;
  for (uint64_t* count : {&of_file.camera_rays, &of_file.shadow_rays, &of_file.other_rays, &of_file.not_finite})
    *count = in.number();
  std::vector<int> done;
  for (int i = 0; i < header.done; ++i) {
    const uint64_t tile = in.number();
    if (tile >= static_cast<uint64_t>(film.tile_count()))
      throw ImageError(file, "the partial picture is damaged", kRenderAnew);
    TileSums& sums = film.sums()[tile];
    in.read(sums.values.data(), sums.values.size_bytes());
    sums.done = true;
    for_each_data_run(film, static_cast<int>(tile), [&](void* to, size_t bytes) { in.read(to, bytes); });
    done.push_back(static_cast<int>(tile));
  }
  const uint64_t sum = in.checksum();
  if (in.number() != sum || !in.at_end())
    throw ImageError(file, "the partial picture is damaged: its checksum does not fit", kRenderAnew);
  tally += of_file;
  return done;
}

}  // namespace lekalo::render
