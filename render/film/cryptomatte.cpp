#include "render/film/cryptomatte.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <nlohmann/json.hpp>

namespace lekalo::render {

namespace {

uint32_t mixed(uint32_t k) { return std::rotl(k * 0xcc9e2d51u, 15) * 0x1b873593u; }

uint32_t matte_bits(std::string_view name) {
  uint32_t bits = murmur_hash(name);
  const uint32_t exponent = bits >> 23 & 255;
  if (exponent == 0 || exponent == 255) bits ^= 1u << 23;
  return bits;
}

}  // namespace

uint32_t murmur_hash(std::string_view bytes) {
  uint32_t hash = 0;
  size_t i = 0;
  for (; i + 4 <= bytes.size(); i += 4) {
    uint32_t k = 0;
    for (size_t b = 0; b < 4; ++b) k |= static_cast<uint32_t>(static_cast<unsigned char>(bytes[i + b])) << (8 * b);
    hash = std::rotl(hash ^ mixed(k), 13) * 5 + 0xe6546b64u;
  }
  uint32_t rest = 0;
  for (size_t b = 0; i + b < bytes.size(); ++b)
    rest |= static_cast<uint32_t>(static_cast<unsigned char>(bytes[i + b])) << (8 * b);
  hash ^= mixed(rest);
  hash ^= static_cast<uint32_t>(bytes.size());
  hash = (hash ^ (hash >> 16)) * 0x85ebca6bu;
  hash = (hash ^ (hash >> 13)) * 0xc2b2ae35u;
  return hash ^ (hash >> 16);
}

float matte_number(std::string_view name) { return std::bit_cast<float>(matte_bits(name)); }

void add_cryptomatte(Image& image, const std::string& layer) {
  for (int rank = 0; rank < kMatteRanks; ++rank)
    for (const char* lane : rank % 2 == 0 ? std::array{"R", "G"} : std::array{"B", "A"})
      add_channel(image, fmt::format("{}{:02}.{}", layer, rank / 2, lane));
}

void describe_cryptomatte(Image& image, const std::string& layer, const std::vector<std::string>& names) {
  const std::string key = "cryptomatte/" + fmt::format("{:08x}", murmur_hash(layer)).substr(0, 7) + "/";
  nlohmann::json manifest = nlohmann::json::object();
  for (const std::string& name : names) manifest[name] = fmt::format("{:08x}", matte_bits(name));
  image.metadata[key + "name"] = layer;
  image.metadata[key + "hash"] = "MurmurHash3_32";
  image.metadata[key + "conversion"] = "uint32_to_float32";
  // Names of model files may be in another encoding than UTF-8.
  image.metadata[key + "manifest"] = manifest.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void MatteCount::add(float number) {
  for (auto& [known, count] : counts_)
    if (std::bit_cast<uint32_t>(known) == std::bit_cast<uint32_t>(number)) {
      ++count;
      return;
    }
  counts_.emplace_back(number, 1);
}

void MatteCount::write(Channel* first, size_t pixel, int samples) {
  std::stable_sort(counts_.begin(), counts_.end(), [](const auto& a, const auto& b) {
    return a.second != b.second ? a.second > b.second
                                : std::bit_cast<uint32_t>(a.first) < std::bit_cast<uint32_t>(b.first);
  });
  for (size_t rank = 0; rank < kMatteRanks; ++rank) {
    const bool used = rank < counts_.size();
    first[2 * rank].values[pixel] = used ? counts_[rank].first : 0;
    first[2 * rank + 1].values[pixel] =
        used ? static_cast<float>(static_cast<double>(counts_[rank].second) / samples) : 0;
  }
}

}  // namespace lekalo::render
