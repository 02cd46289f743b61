#include "render/film/tiles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "render/materials/textured_color.h"

namespace lekalo::render {

namespace {

constexpr int kTileSize = 32;

const char* const kLayerNames[] = {
    "R",    "G",         "B",           "A",        "direct.R", "direct.G", "direct.B", "Z",     "P.X",
    "P.Y",  "P.Z",       "N.X",         "N.Y",      "N.Z",      "Ng.X",     "Ng.Y",     "Ng.Z",  "uv.U",
    "uv.V", "id.object", "id.material", "albedo.R", "albedo.G", "albedo.B", "samples",  "id.key"};

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

TiledFilm::TiledFilm(const Film& film, bool key_layer)
    : filter_(make_filter(film.filter, film.filter_radius)),
      reach_(static_cast<int>(std::ceil(filter_->radius() - 0.5))) {
  if (film.width < 1 || film.height < 1 || film.samples < 1)
    throw std::invalid_argument("a picture needs at least one pixel and one sample");
  const Window full{0, 0, film.width, film.height};
  crop_ = film.crop.x1 == 0 ? full : intersection({film.crop.x0, film.crop.y0, film.crop.x1, film.crop.y1}, full);
  if (crop_.width() == 0 || crop_.height() == 0) throw std::invalid_argument("the crop lies outside the picture");

  const Window needed = intersection(crop_.grown(reach_), full);
  for (int y = needed.y0 / kTileSize * kTileSize; y < needed.y1; y += kTileSize)
    for (int x = needed.x0 / kTileSize * kTileSize; x < needed.x1; x += kTileSize)
      tiles_.push_back(intersection({x, y, x + kTileSize, y + kTileSize}, needed));
  sums_.resize(tiles_.size());
  for (size_t i = 0; i < tiles_.size(); ++i) sums_[i].window = intersection(tiles_[i].grown(reach_), crop_);

  image_ = make_image(crop_.width(), crop_.height());
  image_.x = crop_.x0;
  image_.y = crop_.y0;
  image_.full_width = film.width;
  image_.full_height = film.height;
  for (int layer = 0; layer < (key_layer ? kKey + 1 : kKey); ++layer) {
    const std::string_view name = kLayerNames[layer];
    add_channel(image_, std::string(name), name.starts_with("id.") ? PixelType::uint32 : PixelType::float32);
  }

  uint64_t hash = 0;
  for (const int value : {film.width, film.height, film.samples, crop_.x0, crop_.y0, crop_.x1, crop_.y1,
                          static_cast<int>(key_layer), kTileSize})
    hash = hash_combine(hash, static_cast<uint64_t>(value));
  hash = hash_combine(hash, film.seed);
  hash = hash_combine(hash, std::bit_cast<uint64_t>(filter_->radius()));
  for (const char letter : film.filter) hash = hash_combine(hash, static_cast<unsigned char>(letter));
  settings_hash_ = hash;
}

void TiledFilm::develop() {
  constexpr int n = TileSums::kPlanes;
  std::vector<double> row(static_cast<size_t>(crop_.width()) * n);
  for (int y = crop_.y0; y < crop_.y1; ++y) {
    std::fill(row.begin(), row.end(), 0.0);
    for (const TileSums& tile : sums_) {
      const Window& w = tile.window;
      if (tile.values.empty() || y < w.y0 || y >= w.y1) continue;
      const float* from = &tile.values[static_cast<size_t>(y - w.y0) * w.width() * n];
      double* to = &row[static_cast<size_t>(w.x0 - crop_.x0) * n];
      for (int i = 0; i < w.width() * n; ++i) to[i] += from[i];
    }
    for (int x = 0; x < crop_.width(); ++x) {
      const double* sum = &row[static_cast<size_t>(x) * n];
      const double weight = sum[n - 1];
      const size_t pixel = static_cast<size_t>(y - crop_.y0) * crop_.width() + x;
      for (int layer = kR; layer <= kDirectB; ++layer)
        image_.channels[layer].values[pixel] = weight > 0 ? static_cast<float>(sum[layer] / weight) : 0.0f;
    }
  }
}

}  // namespace lekalo::render
