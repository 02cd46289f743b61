// What the readers of mesh files share.
#pragma once

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "geometry/mesh.h"
#include "render/mesh_files/mesh_files.h"

namespace lekalo::render {

// Words of one line, separated by blanks and tabs.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}
  // Empty at the line's end.
  std::string_view next() {
    const size_t start = rest_.find_first_not_of(" \t\r");
    if (start == std::string_view::npos) return rest_ = {};
    rest_.remove_prefix(start);
    const std::string_view word = rest_.substr(0, rest_.find_first_of(" \t\r"));
    rest_.remove_prefix(word.size());
    return word;
  }

 private:
  std::string_view rest_;
};

// A whole word as a finite number.
inline std::optional<double> number_of(std::string_view word) {
  if (word.size() > 1 && word[0] == '+') word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

inline std::optional<int64_t> integer_of(std::string_view word) {
  int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

// A line of a file with its number from 1; lines end with LF, CR LF or CR.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : rest_(text) {}
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    ++number_;
    const size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    line = rest_.substr(0, end);
    size_t skip = end;
    if (skip < rest_.size()) skip += rest_[skip] == '\r' && skip + 1 < rest_.size() && rest_[skip + 1] == '\n' ? 2 : 1;
    rest_.remove_prefix(skip);
    return true;
  }
  int number() const { return number_; }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

// Corner of a polygon; -1: none.
struct MeshCorner {
  int32_t point = -1;
  int32_t normal = -1;
  int32_t parameter = -1;
  bool operator==(const MeshCorner&) const = default;
};

// Gives equal coordinates one point.
class PointTable {
 public:
  explicit PointTable(geometry::Mesh& mesh) : mesh_(mesh) {}
  int32_t index(const geometry::Vec3& p) {
    // Adding zero makes -0 and 0 one.
    const std::array<double, 3> key{p.x + 0.0, p.y + 0.0, p.z + 0.0};
    const auto [found, is_new] = places_.try_emplace(key, static_cast<int32_t>(mesh_.points.size()));
    if (is_new) mesh_.points.push_back(p);
    return found->second;
  }

 private:
  struct Hash {
    size_t operator()(const std::array<double, 3>& key) const {
      uint64_t hash = 1469598103934665603u;
      for (double x : key) hash = (hash ^ std::bit_cast<uint64_t>(x)) * 1099511628211u + (hash >> 29);
      return hash;
    }
  };
  geometry::Mesh& mesh_;
  std::unordered_map<std::array<double, 3>, int32_t, Hash> places_;
};

// Adds a polygon as triangles: its own shape where it is plane and simple, a fan where it is not. Corners that repeat
// the point before them are left out.
void add_polygon(geometry::Mesh& mesh, std::span<const MeshCorner> corners, int32_t face);

geometry::Mesh parse_obj(std::string_view text, const std::string& name);
geometry::Mesh parse_ply(std::string_view bytes, const std::string& name);
geometry::Mesh parse_stl(std::string_view bytes, const std::string& name);
std::string obj_bytes(const geometry::Mesh& mesh);
std::string ply_bytes(const geometry::Mesh& mesh);
std::string stl_bytes(const geometry::Mesh& mesh);

}  // namespace lekalo::render
