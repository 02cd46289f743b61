// OUTPUT.partial: what a stopped picture has got so far, in the machine's own byte order (it is continued by the same
// build on the same kind of machine or not at all).
//
//   "lekalo partial 1\n", identity, settings hash, number of finished tiles, tally (8-byte integers), then for each
//   tile its number, its sums (floats) where the filter needs them, and its pixels' layers that stand in the image
//   already, layer by layer, row by row.
#include <algorithm>
#include <cstring>
#include <fstream>
#include <sstream>

#include "render/film/tiles.h"
#include "render/image/atomic_file.h"
#include "render/image/image_error.h"

namespace lekalo::render {

namespace {

constexpr std::string_view kMagic = "lekalo partial 1\n";

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

void write_partial(const std::string& file, TiledFilm& film, uint64_t identity, const std::vector<int>& done,
                   const Tally& tally) {
  AtomicFile out(file);
  const auto number = [&](uint64_t value) { out.write(&value, sizeof value); };
  out.write(kMagic);
  for (const uint64_t value : {identity, film.settings_hash(), static_cast<uint64_t>(done.size()), tally.camera_rays,
                               tally.shadow_rays, tally.other_rays, tally.not_finite})
    number(value);
  for (const int tile : done) {
    number(static_cast<uint64_t>(tile));
    const std::span<const float> values = film.sums()[tile].values;
    out.write(values.data(), values.size_bytes());
    for_each_data_run(film, tile, [&](const void* run, size_t bytes) { out.write(run, bytes); });
  }
  out.commit();
}

std::vector<int> read_partial(const std::string& file, TiledFilm& film, uint64_t identity, Tally& tally) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw ImageError(file, "the partial picture cannot be read", "render without --resume");
  const auto read = [&](void* to, size_t bytes) {
    if (!in.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes)))
      throw ImageError(file, "the partial picture is damaged: it ends too early", "render without --resume");
  };
  const auto number = [&] {
    uint64_t value = 0;
    read(&value, sizeof value);
    return value;
  };
  std::string magic(kMagic.size(), '\0');
  read(magic.data(), magic.size());
  if (magic != kMagic) throw ImageError(file, "this is no partial picture", "render without --resume");
  const uint64_t of_scene = number(), of_settings = number(), count = number();
  if (of_scene != identity || of_settings != film.settings_hash())
    throw ImageError(file, "the partial picture is of another scene, other settings or another version of the program",
                     "repeat the options of the first run (-o decides the layers as well), or render without --resume");
  tally.camera_rays = number();
  tally.shadow_rays = number();
  tally.other_rays = number();
  tally.not_finite = number();
  std::vector<int> done;
  for (uint64_t i = 0; i < count; ++i) {
    const uint64_t tile = number();
    if (tile >= static_cast<uint64_t>(film.tile_count()))
      throw ImageError(file, "the partial picture is damaged", "render without --resume");
    TileSums& sums = film.sums()[tile];
    read(sums.values.data(), sums.values.size_bytes());
    sums.done = true;
    for_each_data_run(film, static_cast<int>(tile), read);
    done.push_back(static_cast<int>(tile));
  }
  return done;
}

}  // namespace lekalo::render
