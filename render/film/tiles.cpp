#include "render/film/tiles.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "render/film/blocks.h"
#include "render/film/cryptomatte.h"
#include "render/film/render.h"
#include "render/materials/textured_color.h"

namespace lekalo::render {

namespace {

constexpr int kTileSize = 32;

struct ChannelName {
  const char* channel;
  const char* layer;  // as film_layers() has it
};
constexpr ChannelName kChannels[kFilmChannels] = {{"R", "color"},
                                                  {"G", "color"},
                                                  {"B", "color"},
                                                  {"A", "color"},
                                                  {"direct.R", "direct"},
                                                  {"direct.G", "direct"},
                                                  {"direct.B", "direct"},
                                                  {"indirect.R", "indirect"},
                                                  {"indirect.G", "indirect"},
                                                  {"indirect.B", "indirect"},
                                                  {"emission.R", "emission"},
                                                  {"emission.G", "emission"},
                                                  {"emission.B", "emission"},
                                                  {"diffuse.R", "diffuse"},
                                                  {"diffuse.G", "diffuse"},
                                                  {"diffuse.B", "diffuse"},
                                                  {"specular.R", "specular"},
                                                  {"specular.G", "specular"},
                                                  {"specular.B", "specular"},
                                                  {"transmission.R", "transmission"},
                                                  {"transmission.G", "transmission"},
                                                  {"transmission.B", "transmission"},
                                                  {"group", "light_groups"},
                                                  {"Z", "depth"},
                                                  {"P.X", "position"},
                                                  {"P.Y", "position"},
                                                  {"P.Z", "position"},
                                                  {"N.X", "normal"},
                                                  {"N.Y", "normal"},
                                                  {"N.Z", "normal"},
                                                  {"Ng.X", "geometric_normal"},
                                                  {"Ng.Y", "geometric_normal"},
                                                  {"Ng.Z", "geometric_normal"},
                                                  {"uv.U", "uv"},
                                                  {"uv.V", "uv"},
                                                  {"id.object", "id"},
                                                  {"id.material", "id"},
                                                  {"albedo.R", "albedo"},
                                                  {"albedo.G", "albedo"},
                                                  {"albedo.B", "albedo"},
                                                  {"quantity", "quantity"},
                                                  {"samples", "samples"},
                                                  {"variance.R", "variance"},
                                                  {"variance.G", "variance"},
                                                  {"variance.B", "variance"},
                                                  {"denoised.R", "denoised"},
                                                  {"denoised.G", "denoised"},
                                                  {"denoised.B", "denoised"},
                                                  {"CryptoObject", "cryptomatte_object"},
                                                  {"CryptoMaterial", "cryptomatte_material"},
                                                  {"id.key", "key"}};

// Kept only where they are asked for: the parts of light, and what is for other programs.
bool is_extra(int channel) { return (channel >= kIndirectR && channel <= kGroups) || channel >= kVarianceR; }

bool is_part(std::string_view layer) {
  for (int c = kIndirectR; c <= kGroups; ++c)
    if (layer == kChannels[c].layer) return true;
  return false;
}

Spectrum LightParts::*part_of(int channel) {
  switch (channel) {
    case kIndirectR:
      return &LightParts::indirect;
    case kEmissionR:
      return &LightParts::emission;
    case kDiffuseR:
      return &LightParts::diffuse;
    case kSpecularR:
      return &LightParts::specular;
    case kTransmissionR:
      return &LightParts::transmission;
    default:
      return nullptr;
  }
}

}  // namespace

Window intersection(const Window& a, const Window& b) {
  Window w{std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
  w.x1 = std::max(w.x0, w.x1);
  w.y1 = std::max(w.y0, w.y1);
  return w;
}

Tally& Tally::operator+=(const Tally& other) {
  camera_rays += other.camera_rays;
  shadow_rays += other.shadow_rays;
  other_rays += other.other_rays;
  not_finite += other.not_finite;
  return *this;
}

std::string TiledFilm::fault_of_layers(const Film& film, const Names& names) {
  for (const std::string& layer : film.layers) {
    if (std::find(film_layers().begin(), film_layers().end(), layer) == film_layers().end())
      return "a film has no layer '" + layer + "'";
    if (layer == kChannels[kQuantity].layer && names.quantity.empty())
      return "the layer 'quantity' is that of an integrator that measures: analysis";
    if (is_part(layer) && !names.parts)
      return "the layer '" + layer + "' is that of an integrator that follows paths: path";
  }
  if (keeps_layer(film, kChannels[kDenoisedR].layer))
    for (const char* needed : {"color", "normal", "albedo", "depth", "variance"})
      if (!keeps_layer(film, needed))
        return std::string("the layer 'denoised' is made of others; keep '") + needed + "' too";
  return {};
}

TiledFilm::TiledFilm(const Film& film, bool key_layer, const Names& names)
    : filter_(make_filter(film.filter, film.filter_radius)),
      reach_(static_cast<int>(std::ceil(filter_->radius() - 0.5))) {
  if (film.width < 1 || film.height < 1 || film.samples < 1)
    throw std::invalid_argument("a picture needs at least one pixel and one sample");
  const Window full{0, 0, film.width, film.height};
  crop_ = film.crop.x1 == 0 ? full : intersection({film.crop.x0, film.crop.y0, film.crop.x1, film.crop.y1}, full);
  if (crop_.width() == 0 || crop_.height() == 0) throw std::invalid_argument("the crop lies outside the picture");

  Window needed = intersection(crop_.grown(reach_), full);
  // Whether a block of pixels needs more samples is found of all of it.
  if (film.noise > 0) needed = intersection(whole_blocks(needed), full);
  for (int y = needed.y0 / kTileSize * kTileSize; y < needed.y1; y += kTileSize)
    for (int x = needed.x0 / kTileSize * kTileSize; x < needed.x1; x += kTileSize)
      tiles_.push_back(intersection({x, y, x + kTileSize, y + kTileSize}, needed));
  image_ = make_image(crop_.width(), crop_.height());
  image_.x = crop_.x0;
  image_.y = crop_.y0;
  image_.full_width = film.width;
  image_.full_height = film.height;
  if (const std::string fault = fault_of_layers(film, names); !fault.empty()) throw std::invalid_argument(fault);
  channel_.fill(-1);
  for (int c = 0; c < kFilmChannels; ++c) {
    const std::string_view name = c == kQuantity ? std::string_view(names.quantity) : kChannels[c].channel;
    const bool kept = c == kKey ? key_layer : keeps_layer(film, kChannels[c].layer);
    if (!kept || name.empty()) continue;
    channel_[c] = static_cast<int>(image_.channels.size());
    if (c == kGroups) {
      add_group("rest");
      for (const std::string& group : names.groups) add_group(group);
      continue;
    }
    if (c == kObjectMatte || c == kMaterialMatte) {
      add_cryptomatte(image_, std::string(name));
      continue;
    }
    const PixelType type = name.starts_with("id.")      ? PixelType::uint32
                           : c <= kA && film.half_color ? PixelType::half
                                                        : PixelType::float32;
    add_channel(image_, std::string(name), type);
    if (c > kGroups) continue;
    if (filtered_planes_.empty()) first_filtered_ = static_cast<FilmChannel>(c);
    if (const auto part = part_of(c)) parts_.push_back(part);
    base_planes_ += c <= kDirectB;
    add_filtered_plane();
  }

  for (const Window& tile : tiles_) sums_.push_back({intersection(tile.grown(reach_), crop_), {}});
  if (reach_ > 0) {
    const auto size_of = [&](const TileSums& sums) {
      return static_cast<size_t>(sums.window.width()) * sums.window.height() * planes();
    };
    size_t size = 0;
    for (const TileSums& sums : sums_) size += size_of(sums);
    sums_storage_ = PixelPlane<float>(size);
    float* next = sums_storage_.data();
    for (TileSums& sums : sums_) {
      sums.values = {next, size_of(sums)};
      next += sums.values.size();
    }
  }

  uint64_t hash = 0;
  for (const int value : {film.width, film.height, film.samples, crop_.x0, crop_.y0, crop_.x1, crop_.y1,
                          static_cast<int>(key_layer), kTileSize})
    hash = hash_combine(hash, static_cast<uint64_t>(value));
  hash = hash_combine(hash, film.seed);
  hash = hash_combine(hash, std::bit_cast<uint64_t>(filter_->radius()));
  hash = hash_combine(hash, std::bit_cast<uint64_t>(film.contrast));
  hash = hash_combine(hash, std::bit_cast<uint64_t>(film.noise));
  hash = hash_combine(hash, image_.channels.size());
  for (const int channel : channel_) hash = hash_combine(hash, static_cast<uint64_t>(channel + 1));
  for (const char letter : film.filter) hash = hash_combine(hash, static_cast<unsigned char>(letter));
  settings_hash_ = hash;
}

void TiledFilm::add_filtered_plane() {
  filtered_planes_.push_back(image_.channels.back().values.data());
  first_data_channel_ = static_cast<int>(image_.channels.size());
}

void TiledFilm::add_group(const std::string& name) {
  for (const char* lane : {".R", ".G", ".B"}) {
    add_channel(image_, "group." + name + lane);
    add_filtered_plane();
  }
  ++group_count_;
}

bool keeps_layer(const Film& film, std::string_view layer) {
  if (!film.layers.empty()) return std::find(film.layers.begin(), film.layers.end(), layer) != film.layers.end();
  return std::none_of(std::begin(kChannels), std::end(kChannels), [&](const ChannelName& channel) {
    return channel.layer == layer && is_extra(static_cast<int>(&channel - kChannels));
  });
}

bool is_light_channel(std::string_view name) {
  return name.starts_with("group.") ||
         std::any_of(kChannels, kChannels + kGroups, [&](const ChannelName& known) { return name == known.channel; });
}

const std::vector<std::string>& film_layers() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (int c = 0; c < kKey; ++c)
      if (list.empty() || list.back() != kChannels[c].layer) list.push_back(kChannels[c].layer);
    return list;
  }();
  return names;
}

void TiledFilm::clear_data(size_t pixel) {
  for (int c = kZ; c < kSamples; ++c)  // counts and what all samples say together stay
    if (Channel* kept = channel(static_cast<FilmChannel>(c))) {
      if (kept->type == PixelType::uint32)
        kept->ids[pixel] = 0;
      else
        kept->values[pixel] = 0;
    }
}

void TiledFilm::clear(int tile) {
  const Window some = intersection(tiles_[tile], crop_);
  if (some.width() <= 0) return;  // it only reaches into the crop
  for (Channel& channel : image_.channels)
    for (int y = some.y0; y < some.y1; ++y) {
      const size_t begin = static_cast<size_t>(y - crop_.y0) * crop_.width() + (some.x0 - crop_.x0);
      if (channel.type == PixelType::uint32)
        std::fill_n(channel.ids.data() + begin, some.width(), 0u);
      else
        std::fill_n(channel.values.data() + begin, some.width(), 0.0f);
    }
}

void TiledFilm::set_pixel(size_t pixel, const double* sums) {
  const int n = static_cast<int>(filtered_planes_.size());
  const double weight = sums[n];
  if (weight == 1) {  // one sample under a box
    for (int i = 0; i < n; ++i) filtered_planes_[i][pixel] = static_cast<float>(sums[i]);
    return;
  }
  for (int i = 0; i < n; ++i) filtered_planes_[i][pixel] = weight > 0 ? static_cast<float>(sums[i] / weight) : 0.0f;
}

void TiledFilm::finish(int tile, std::span<const double> sums) {
  TileSums& kept = sums_[tile];
  if (reach_ > 0) std::copy(sums.begin(), sums.end(), kept.values.begin());
  kept.done = true;
}

void TiledFilm::develop() {
  if (reach_ == 0) return;
  const int n = planes();
  // Rows of the picture one after the other: the tiles that reach a row are searched once for some of them.
  tbb::parallel_for(tbb::blocked_range<int>(crop_.y0, crop_.y1, 16), [&](const tbb::blocked_range<int>& rows) {
    std::vector<const TileSums*> near;
    for (const TileSums& tile : sums_)
      if (tile.done && tile.window.y0 < rows.end() && tile.window.y1 > rows.begin()) near.push_back(&tile);
    std::vector<double> row(static_cast<size_t>(crop_.width()) * n);
    for (int y = rows.begin(); y < rows.end(); ++y) {
      std::fill(row.begin(), row.end(), 0.0);
      for (const TileSums* tile : near) {
        const Window& w = tile->window;
        if (y < w.y0 || y >= w.y1) continue;
        const float* from = &tile->values[static_cast<size_t>(y - w.y0) * w.width() * n];
        double* to = &row[static_cast<size_t>(w.x0 - crop_.x0) * n];
        for (int i = 0; i < w.width() * n; ++i) to[i] += from[i];
      }
      const size_t first = static_cast<size_t>(y - crop_.y0) * crop_.width();
      for (int x = 0; x < crop_.width(); ++x) set_pixel(first + x, &row[static_cast<size_t>(x) * n]);
    }
  });
}

}  // namespace lekalo::render
