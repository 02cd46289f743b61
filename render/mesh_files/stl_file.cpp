// STL: triangles by their corners' coordinates, as text ("solid ... facet normal ... vertex ...") or binary (80 bytes
// of header, a 32-bit count, 50 bytes for each triangle, little-endian). Some binary files begin with "solid" too:
// their length tells, or that no "facet" follows.
#include <bit>
#include <cctype>
#include <cstring>

#include "render/mesh_files/mesh_parts.h"

namespace lekalo::render {

using geometry::Mesh;
using geometry::Vec3;

namespace {

constexpr size_t kHeader = 84, kRecord = 50;

uint32_t little_endian(const char* bytes) {
  uint32_t value = 0;
  for (int k = 3; k >= 0; --k) value = value << 8 | static_cast<uint8_t>(bytes[k]);
  return value;
}

Mesh parse_binary(std::string_view bytes, const std::string& name) {
  Mesh mesh;
  PointTable table(mesh);
  const size_t count = (bytes.size() - kHeader) / kRecord;
  for (size_t i = 0; i < count; ++i) {
    const size_t at = kHeader + i * kRecord + 12;  // after the normal
    std::array<MeshCorner, 3> corners;
    for (int corner = 0; corner < 3; ++corner) {
      Vec3 p;
      for (int k = 0; k < 3; ++k) {
        const size_t place = at + 12 * corner + 4 * k;
        p[k] = std::bit_cast<float>(little_endian(bytes.data() + place));
        if (!std::isfinite(p[k]))
          throw MeshFileError(fmt::format("{}:byte {}: a coordinate is not finite", name, place));
      }
      corners[corner].point = table.index(p);
    }
    add_polygon(mesh, corners, 0);
  }
  return mesh;
}

std::string lower(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

// "solid", and a facet or the end of an empty solid at the head of some line after it.
bool is_text(std::string_view bytes) {
  TextLines lines(bytes.substr(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size())));
  std::string_view line;
  if (!lines.next(line) || !lower(line.substr(0, 5)).starts_with("solid")) return false;
  while (lines.next(line)) {
    const std::string keyword = lower(Words(line).next());
    if (!keyword.empty()) return keyword.starts_with("facet") || keyword == "endsolid";
  }
  return bytes.size() < kHeader;
}

Mesh parse_text(std::string_view text, const std::string& name) {
  Mesh mesh;
  PointTable table(mesh);
  TextLines lines(text);
  std::string_view line;
  std::vector<MeshCorner> corners;
  bool in_facet = false;
  int solid = -1;
  const auto fail = [&](const std::string& reason) {
    throw MeshFileError(fmt::format("{}:{}: {}", name, lines.number(), reason));
  };
  while (lines.next(line)) {
    Words words(line);
    const std::string keyword = lower(words.next());
    if (keyword == "solid") {
      ++solid;
    } else if (keyword == "facet") {
      if (in_facet) fail("a facet begins inside another");
      in_facet = true;
      corners.clear();
    } else if (keyword == "vertex") {
      if (!in_facet) fail("a vertex outside a facet");
      Vec3 p;
      for (int k = 0; k < 3; ++k) {
        const std::string_view word = words.next();
        const auto value = number_of(word);
        if (!value) fail(word.empty() ? "a vertex has three numbers" : fmt::format("'{}' is not a number", word));
        p[k] = *value;
      }
      corners.push_back({table.index(p), -1, -1});
    } else if (keyword == "endfacet") {
      if (!in_facet) fail("'endfacet' without 'facet'");
      if (corners.size() != 3) fail(fmt::format("a facet has three vertices, not {}", corners.size()));
      add_polygon(mesh, corners, std::max(0, solid));
      in_facet = false;
    } else if (!keyword.empty() && keyword != "outer" && keyword != "endloop" && keyword != "endsolid") {
      fail(fmt::format("unknown word '{}'", keyword.substr(0, 40)));
    }
  }
  if (in_facet) fail("the file ends inside a facet");
  return mesh;
}

}  // namespace

Mesh parse_stl(std::string_view bytes, const std::string& name) {
  const bool long_enough = bytes.size() >= kHeader;
  if (long_enough && kHeader + kRecord * static_cast<uint64_t>(little_endian(bytes.data() + 80)) == bytes.size())
    return parse_binary(bytes, name);
  if (is_text(bytes)) return parse_text(bytes, name);
  if (!long_enough)
    throw MeshFileError(fmt::format("{}: neither a text STL (it begins with 'solid') nor a binary one", name));
  throw MeshFileError(fmt::format("{}:byte 80: the file has {} bytes, which is not the length of {} triangles", name,
                                  bytes.size(), little_endian(bytes.data() + 80)));
}

std::string stl_bytes(const Mesh& mesh) {
  std::string bytes = "binary STL written by lekalo";
  bytes.resize(80, ' ');
  const auto append = [&](uint32_t value) {
    for (int k = 0; k < 4; ++k) bytes.push_back(static_cast<char>(value >> (8 * k) & 0xff));
  };
  const auto append_vector = [&](const Vec3& v) {
    for (int k = 0; k < 3; ++k) append(std::bit_cast<uint32_t>(static_cast<float>(v[k])));
  };
  append(static_cast<uint32_t>(mesh.triangles.size()));
  for (const Mesh::Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.points[t.point[0]], b = mesh.points[t.point[1]], c = mesh.points[t.point[2]];
    const Vec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    append_vector(length > 0 ? normal / length : Vec3(0));
    for (const Vec3& p : {a, b, c}) append_vector(p);
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace lekalo::render
