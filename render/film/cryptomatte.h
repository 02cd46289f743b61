// Cryptomatte: how much of each pixel things of a name cover, for compositors (Friedman and Jones, "Fully automatic ID
// mattes with support for motion blur and transparency", 2015; Psyop's specification 1.2.0).
//
// A name is told by the 32 bits of its MurmurHash3 (Appleby, x86, 32 bits, seed 0), stored as a float; hashes whose
// exponent would make no ordinary number have its lowest bit turned. A layer NAME has the channels NAME00.R G B A,
// NAME01.R ..., of which each pair holds a name's number and its share of the pixel, the largest first. Metadata
// `cryptomatte/KEY/...` hold the layer's name and, as JSON, all names with their hashes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/image/image.h"

namespace lekalo::render {

inline constexpr int kMatteRanks = 6;  // names that a pixel can tell; the rest is left out

uint32_t murmur_hash(std::string_view bytes);
// Of a name, as channels hold it.
float matte_number(std::string_view name);

// Appends the channels of a layer.
void add_cryptomatte(Image& image, const std::string& layer);
// Metadata of a layer with the names in it.
void describe_cryptomatte(Image& image, const std::string& layer, const std::vector<std::string>& names);

// What the samples of one pixel met.
class MatteCount {
 public:
  void add(float number);
  // To a pixel of the layer whose channels begin at `first`; `samples`: all of the pixel, also those that met nothing.
  void write(Channel* first, size_t pixel, int samples);
  void clear() { counts_.clear(); }

 private:
  std::vector<std::pair<float, int>> counts_;
};

}  // namespace lekalo::render
