// Wavefront OBJ: v, vt, vn, f with indices from 1 or from the end (negative), g and o; everything else (materials,
// smoothing groups, lines, free-form curves) is skipped. A backslash continues a line.
#include <iterator>

#include "render/mesh_files/mesh_parts.h"

namespace lekalo::render {

using geometry::Mesh;
using geometry::Vec2;
using geometry::Vec3;

namespace {

class ObjParser {
 public:
  ObjParser(std::string_view text, const std::string& name) : lines_(text), name_(name) {}

  Mesh run() {
    std::string_view line;
    std::string joined;
    while (lines_.next(line)) {
      line_number_ = lines_.number();
      // Lines without a continuation, nearly all, are not copied.
      if (line.ends_with('\\')) {
        joined.assign(line.substr(0, line.size() - 1));
        while (lines_.next(line)) {
          const bool more = line.ends_with('\\');
          joined.append(1, ' ').append(more ? line.substr(0, line.size() - 1) : line);
          if (!more) break;
        }
        line = joined;
      }
      statement(line);
    }
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw MeshFileError(fmt::format("{}:{}: {}", name_, line_number_, reason));
  }

  void statement(std::string_view line) {
    if (const size_t comment = line.find('#'); comment != std::string_view::npos) line = line.substr(0, comment);
    Words words(line);
    const std::string_view keyword = words.next();
    if (keyword == "v") {
      mesh_.points.push_back(vector(words, "a vertex"));
    } else if (keyword == "vn") {
      mesh_.normals.push_back(vector(words, "a normal"));
    } else if (keyword == "vt") {
      mesh_.parameters.push_back(texture_place(words));
    } else if (keyword == "f") {
      face(words);
    } else if (keyword == "g" || keyword == "o") {
      if (!mesh_.triangles.empty()) group_ = mesh_.triangles.back().face + 1;
    }
  }

  double number(std::string_view word, const char* what) const {
    const auto value = number_of(word);
    if (!value)
      fail(word.empty() ? fmt::format("{} has too few numbers", what) : fmt::format("'{}' is not a number", word));
    return *value;
  }

  // Further numbers on the line (a weight, colors) are not read.
  Vec3 vector(Words& words, const char* what) const {
    Vec3 result;
    for (int k = 0; k < 3; ++k) result[k] = number(words.next(), what);
    return result;
  }

  Vec2 texture_place(Words& words) const {
    const double u = number(words.next(), "a texture coordinate");
    const std::string_view second = words.next();
    return {u, second.empty() ? 0.0 : number(second, "a texture coordinate")};
  }

  int32_t index(std::string_view word, size_t count, const char* what) const {
    const auto value = integer_of(word);
    if (!value || *value == 0) fail(fmt::format("'{}' is not the number of a {} (they count from 1)", word, what));
    const int64_t at = *value > 0 ? *value - 1 : static_cast<int64_t>(count) + *value;
    if (at < 0 || at >= static_cast<int64_t>(count))
      fail(fmt::format("there is no {} {}: {} are defined so far", what, word, count));
    return static_cast<int32_t>(at);
  }

  void face(Words& words) {
    corners_.clear();
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      const size_t first = std::min(word.find('/'), word.size());
      const size_t second = first < word.size() ? std::min(word.find('/', first + 1), word.size()) : word.size();
      MeshCorner corner;
      corner.point = index(word.substr(0, first), mesh_.points.size(), "vertex");
      if (second > first + 1)
        corner.parameter =
            index(word.substr(first + 1, second - first - 1), mesh_.parameters.size(), "texture coordinate");
      if (second + 1 < word.size()) corner.normal = index(word.substr(second + 1), mesh_.normals.size(), "normal");
      corners_.push_back(corner);
    }
    if (corners_.size() < 3) fail("a face needs at least three corners");
    add_polygon(mesh_, corners_, group_);
  }

  TextLines lines_;
  std::string name_;
  int line_number_ = 0;
  Mesh mesh_;
  int32_t group_ = 0;
  std::vector<MeshCorner> corners_;
};

}  // namespace

Mesh parse_obj(std::string_view text, const std::string& name) { return ObjParser(text, name).run(); }

std::string obj_bytes(const Mesh& mesh) {
  fmt::memory_buffer out;
  auto at = std::back_inserter(out);
  fmt::format_to(at, "# lekalo: {} points, {} triangles\n", mesh.points.size(), mesh.triangles.size());
  for (const Vec3& p : mesh.points) fmt::format_to(at, "v {} {} {}\n", p.x, p.y, p.z);
  for (const Vec2& p : mesh.parameters) fmt::format_to(at, "vt {} {}\n", p.x, p.y);
  for (const Vec3& n : mesh.normals) fmt::format_to(at, "vn {} {} {}\n", n.x, n.y, n.z);
  int32_t face = -1;
  const bool has_groups = !mesh.triangles.empty() && mesh.triangles.front().face != mesh.triangles.back().face;
  for (const Mesh::Triangle& t : mesh.triangles) {
    if (has_groups && t.face != face) fmt::format_to(at, "g face_{}\n", face = t.face);
    fmt::format_to(at, "f");
    for (int k = 0; k < 3; ++k) {
      fmt::format_to(at, " {}", t.point[k] + 1);
      if (t.normal[k] >= 0 && t.parameter[k] >= 0)
        fmt::format_to(at, "/{}/{}", t.parameter[k] + 1, t.normal[k] + 1);
      else if (t.parameter[k] >= 0)
        fmt::format_to(at, "/{}", t.parameter[k] + 1);
      else if (t.normal[k] >= 0)
        fmt::format_to(at, "//{}", t.normal[k] + 1);
    }
    fmt::format_to(at, "\n");
  }
  return fmt::to_string(out);
}

std::string obj_lines(size_t points, const std::vector<std::vector<Vec3>>& polylines) {
  fmt::memory_buffer out;
  auto at = std::back_inserter(out);
  for (const std::vector<Vec3>& polyline : polylines) {
    for (const Vec3& p : polyline) fmt::format_to(at, "v {} {} {}\n", p.x, p.y, p.z);
    fmt::format_to(at, "l");
    for (size_t i = 0; i < polyline.size(); ++i) fmt::format_to(at, " {}", ++points);
    fmt::format_to(at, "\n");
  }
  return fmt::to_string(out);
}

}  // namespace lekalo::render
