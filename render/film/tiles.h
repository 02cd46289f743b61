// The film while it is exposed: tiles of pixels, each the work of one thread.
//
// A sample counts for all pixels within the filter's radius, also beyond its tile. So each tile sums its own samples
// over its pixels and a margin of the filter's reach; in the end a pixel is the sum of the tiles that reach it, in the
// order of tiles. No sum ever depends on which thread did what when. The tiling belongs to the full picture, not to the
// crop.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "render/film/filter.h"
#include "render/image/image.h"
#include "render/integrator.h"
#include "render/model/model.h"
#include "render/spectrum.h"

namespace lekalo::render {

struct Window {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // pixels, half open
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  Window grown(int by) const { return {x0 - by, y0 - by, x1 + by, y1 + by}; }
};
Window intersection(const Window& a, const Window& b);

// Rays and samples of a part of the picture.
struct Tally {
  uint64_t camera_rays = 0, shadow_rays = 0, other_rays = 0, not_finite = 0;
  Tally& operator+=(const Tally& other);
};

// Sums of one tile: the filtered channels that the film keeps, then the weight, for each pixel of `window`, row by row.
struct TileSums {
  Window window;            // the tile with its margin
  std::span<float> values;  // none where the filter does not reach beyond a pixel
  bool done = false;        // before, the values mean nothing
};

// Channels that a film may have, in the order of the image.
enum FilmChannel : int {
  kR,
  kG,
  kB,
  kA,
  kDirectR,
  kDirectG,
  kDirectB,
  kIndirectR,
  kIndirectG,
  kIndirectB,
  kEmissionR,
  kEmissionG,
  kEmissionB,
  kDiffuseR,
  kDiffuseG,
  kDiffuseB,
  kSpecularR,
  kSpecularG,
  kSpecularB,
  kTransmissionR,
  kTransmissionG,
  kTransmissionB,
  kGroups,  // one colour for each group of lights; filtered up to here
  kZ,
  kPX,
  kPY,
  kPZ,
  kNX,
  kNY,
  kNZ,
  kNgX,
  kNgY,
  kNgZ,
  kU,
  kV,
  kObject,
  kMaterial,
  kAlbedoR,
  kAlbedoG,
  kAlbedoB,
  kQuantity,
  kSamples,
  kVarianceR,
  kVarianceG,
  kVarianceB,
  kDenoisedR,  // written when the picture is complete
  kDenoisedG,
  kDenoisedB,
  kObjectMatte,  // each a Cryptomatte (cryptomatte.h)
  kMaterialMatte,
  kKey,
  kFilmChannels
};

struct PartialHeader;

class TiledFilm {
 public:
  // What the integrator and the model have names for.
  struct Names {
    std::string quantity;             // of the channel for RaySample::quantity; empty: there is none
    bool parts = false;               // samples tell the parts of their light
    std::vector<std::string> groups;  // of lights
  };

  // Why a film does not have the layers that are asked for; empty: it has.
  static std::string fault_of_layers(const Film& film, const Names& names);

  // Throws std::invalid_argument for an unknown filter or layer, one that the samples do not bring, or an empty crop.
  TiledFilm(const Film& film, bool key_layer, const Names& names);

  int tile_count() const { return static_cast<int>(tiles_.size()); }
  const Window& tile(int i) const { return tiles_[i]; }  // pixels whose samples the tile takes
  const Window& crop() const { return crop_; }
  const Filter& filter() const { return *filter_; }
  int reach() const { return reach_; }  // pixels beyond its own that a sample counts for
  Image& image() { return image_; }
  // A channel of the image, or nullptr if the film does not keep it.
  Channel* channel(FilmChannel c) { return channel_[c] < 0 ? nullptr : &image_.channels[channel_[c]]; }
  // The first of the image's channels that tiles write at once, without sums that develop() makes it of.
  int first_unsummed_channel() const { return reach_ == 0 ? 0 : first_data_channel_; }
  // True with channels that describe what the nearest sample to a pixel's centre saw; sets those of a pixel to nothing.
  bool keeps_data() const { return first_data_channel_ < static_cast<int>(image_.channels.size()); }
  void clear_data(size_t pixel);
  std::vector<TileSums>& sums() { return sums_; }
  // The filtered channels: first a run of kR..kDirectB, as layers come whole, then three for each of the parts of light
  // that are kept. The numbers in the sums of a pixel are one for each channel and the weight.
  FilmChannel first_filtered() const { return first_filtered_; }
  int base_planes() const { return base_planes_; }
  const std::vector<Spectrum LightParts::*>& parts() const { return parts_; }
  int group_count() const { return group_count_; }  // kept, after the parts
  int planes() const { return static_cast<int>(filtered_planes_.size()) + 1; }
  bool keeps_parts() const { return !parts_.empty() || group_count_ > 0; }

  const Window& sums_window(int i) const { return sums_[i].window; }

  // Hash of everything that decides the film's layout and contents but the scene.
  uint64_t settings_hash() const { return settings_hash_; }

  // Writes a pixel of the filtered layers from its sums.
  void set_pixel(int x, int y, std::span<const double> sums) {
    set_pixel(static_cast<size_t>(y - crop_.y0) * crop_.width() + (x - crop_.x0), sums.data());
  }
  // The same from the values of its only sample, whatever that weighs.
  void set_pixel(int x, int y, const float* values) {
    const size_t pixel = static_cast<size_t>(y - crop_.y0) * crop_.width() + (x - crop_.x0);
    for (size_t i = 0; i < filtered_planes_.size(); ++i) filtered_planes_[i][pixel] = values[i];
  }
  // Takes back what has been written of a tile that was given up: its pixels are 0 again.
  void clear(int tile);
  // Takes the sums of a tile. Where the filter does not reach beyond a pixel there are none, and its pixels are set.
  void finish(int tile, std::span<const double> sums);
  // Writes the filtered layers of the image from the sums of the tiles that are done, where there are any.
  void develop();

 private:
  Window crop_;
  std::unique_ptr<const Filter> filter_;
  int reach_ = 0;
  std::vector<Window> tiles_;
  std::vector<TileSums> sums_;
  PixelPlane<float> sums_storage_;  // of all tiles
  Image image_;
  std::array<int, kFilmChannels> channel_;
  FilmChannel first_filtered_ = kR;
  int base_planes_ = 0, group_count_ = 0;
  std::vector<Spectrum LightParts::*> parts_;
  std::vector<float*> filtered_planes_;  // of the image's channels
  int first_data_channel_ = 0;
  uint64_t settings_hash_ = 0;

  void set_pixel(size_t pixel, const double* sums);
  void add_filtered_plane();  // the image's last channel
  void add_group(const std::string& name);
};

// The file of a stopped picture (OUTPUT.partial), or of a part of one: the tiles done so far and what they cost.
// `done` lists the numbers of the finished tiles, whose sums and data layers are complete.
void write_partial(const std::string& file, TiledFilm& film, const PartialHeader& header, const std::vector<int>& done,
                   const Tally& tally);
// Reads it back into the film; returns the numbers of the finished tiles. Throws ImageError.
std::vector<int> read_partial(const std::string& file, TiledFilm& film, uint64_t identity, Tally& tally);

}  // namespace lekalo::render
