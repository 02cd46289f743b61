// PLY (Turk 1994): a header that lists elements and their properties, then the values as text or in either byte order.
// Read are the elements vertex (x y z, nx ny nz, and u v or s t) and face (vertex_indices or vertex_index); others are
// skipped. A vertex has one normal and one pair of parameters: where a point has several it stands there several times,
// and becomes one point again.
#include <bit>
#include <cstring>
#include <map>
#include <unordered_map>
#include <utility>

#include "render/mesh_files/mesh_parts.h"

namespace lekalo::render {

using geometry::Mesh;
using geometry::Vec2;
using geometry::Vec3;

namespace {

enum class Scalar { i8, u8, i16, u16, i32, u32, f32, f64 };

int size_of(Scalar type) {
  constexpr int kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<int>(type)];
}

std::optional<Scalar> scalar_named(std::string_view word) {
  static const std::map<std::string_view, Scalar> names{
      {"char", Scalar::i8},   {"int8", Scalar::i8},     {"uchar", Scalar::u8},   {"uint8", Scalar::u8},
      {"short", Scalar::i16}, {"int16", Scalar::i16},   {"ushort", Scalar::u16}, {"uint16", Scalar::u16},
      {"int", Scalar::i32},   {"int32", Scalar::i32},   {"uint", Scalar::u32},   {"uint32", Scalar::u32},
      {"float", Scalar::f32}, {"float32", Scalar::f32}, {"double", Scalar::f64}, {"float64", Scalar::f64}};
  const auto found = names.find(word);
  return found == names.end() ? std::nullopt : std::optional(found->second);
}

struct Property {
  std::string name;
  Scalar type = Scalar::f32;
  bool is_list = false;
  Scalar count_type = Scalar::u8;
};

struct Element {
  std::string name;
  int64_t count = 0;
  std::vector<Property> properties;
};

template <class T>
T load(const char* bytes, bool big_endian) {
  char copy[sizeof(T)];
  std::memcpy(copy, bytes, sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(copy, copy + sizeof(T));
  T value;
  std::memcpy(&value, copy, sizeof(T));
  return value;
}

class PlyParser {
 public:
  PlyParser(std::string_view bytes, const std::string& name) : bytes_(bytes), lines_(bytes), name_(name) {}

  Mesh run() {
    header();
    for (const Element& element : elements_) {
      if (element.name == "vertex")
        vertices(element);
      else if (element.name == "face")
        faces(element);
      else
        skip(element);
    }
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    const std::string place =
        in_binary_ ? fmt::format("byte {}", bytes_.size() - binary_.size()) : fmt::format("{}", lines_.number());
    throw MeshFileError(fmt::format("{}:{}: {}", name_, place, reason));
  }

  void header() {
    std::string_view line;
    if (!lines_.next(line) || line != "ply") fail("the first line of a PLY file is 'ply'");
    bool has_format = false;
    for (;;) {
      if (!lines_.next(line)) fail("the header has no end_header");
      Words words(line);
      const std::string_view keyword = words.next();
      if (keyword == "end_header") break;
      if (keyword == "format") {
        const std::string_view format = words.next();
        ascii_ = format == "ascii";
        big_endian_ = format == "binary_big_endian";
        if (!ascii_ && !big_endian_ && format != "binary_little_endian")
          fail(fmt::format("unknown format '{}' (ascii, binary_little_endian or binary_big_endian)", format));
        has_format = true;
      } else if (keyword == "element") {
        Element element;
        element.name = words.next();
        const auto count = integer_of(words.next());
        if (!count || *count < 0 || *count > INT32_MAX) fail("an element needs its name and its count");
        element.count = *count;
        elements_.push_back(element);
      } else if (keyword == "property") {
        property(words);
      } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
        fail(fmt::format("unknown header line '{}'", keyword));
      }
    }
    if (!has_format) fail("the header has no format");
    binary_ = lines_.rest();
    in_binary_ = !ascii_;
    if (!find("vertex")) fail("the file has no element 'vertex'");
    if (!find("face")) fail("the file has no element 'face'");
  }

  void property(Words& words) {
    if (elements_.empty()) fail("a property before the first element");
    Property property;
    std::string_view type = words.next();
    property.is_list = type == "list";
    if (property.is_list) {
      const auto count_type = scalar_named(words.next());
      if (!count_type || *count_type >= Scalar::f32) fail("a list needs a whole-number type for its length");
      property.count_type = *count_type;
      type = words.next();
    }
    const auto scalar = scalar_named(type);
    if (!scalar) fail(fmt::format("unknown type '{}' of a property", type));
    property.type = *scalar;
    property.name = words.next();
    if (property.name.empty()) fail("a property needs a name");
    elements_.back().properties.push_back(property);
  }

  const Element* find(std::string_view name) const {
    for (const Element& element : elements_)
      if (element.name == name) return &element;
    return nullptr;
  }

  // A count in the header must not make us reserve more than the file can hold.
  void require_room(const Element& element) const {
    size_t least = 0;
    for (const Property& p : element.properties) least += ascii_ ? 2 : size_of(p.is_list ? p.count_type : p.type);
    const size_t left = ascii_ ? lines_.rest().size() + 1 : binary_.size();
    if (static_cast<size_t>(element.count) * std::max<size_t>(least, 1) > left)
      fail(fmt::format("the file is too short for {} elements '{}'", element.count, element.name));
  }

  // Text values stand one element on a line.
  void begin_element() {
    if (!ascii_) return;
    std::string_view line;
    do {
      if (!lines_.next(line)) fail("the file ends too early");
      words_ = Words(line);
      first_word_ = words_.next();
    } while (first_word_.empty());
  }

  double value(Scalar type) {
    if (ascii_) {
      const std::string_view word = first_word_.empty() ? words_.next() : std::exchange(first_word_, {});
      const auto number = number_of(word);
      if (!number) fail(word.empty() ? "the line has too few numbers" : fmt::format("'{}' is not a number", word));
      return *number;
    }
    const size_t size = size_of(type);
    if (binary_.size() < size) fail("the file ends too early");
    const char* at = binary_.data();
    double result = 0;
    switch (type) {
      case Scalar::i8:
        result = load<int8_t>(at, big_endian_);
        break;
      case Scalar::u8:
        result = load<uint8_t>(at, big_endian_);
        break;
      case Scalar::i16:
        result = load<int16_t>(at, big_endian_);
        break;
      case Scalar::u16:
        result = load<uint16_t>(at, big_endian_);
        break;
      case Scalar::i32:
        result = load<int32_t>(at, big_endian_);
        break;
      case Scalar::u32:
        result = load<uint32_t>(at, big_endian_);
        break;
      case Scalar::f32:
        result = load<float>(at, big_endian_);
        break;
      case Scalar::f64:
        result = load<double>(at, big_endian_);
        break;
    }
    if (!std::isfinite(result)) fail("a number is not finite");
    binary_.remove_prefix(size);
    return result;
  }

  int64_t list_length(const Property& property) {
    const double length = value(property.count_type);
    const size_t left = ascii_ ? lines_.rest().size() + 4096 : binary_.size() / size_of(property.type);
    if (!(length >= 0) || length != std::floor(length)) fail(fmt::format("a list cannot have {} entries", length));
    if (!ascii_ && length > static_cast<double>(left))
      fail(fmt::format("the file ends within a list of {} entries", length));
    return static_cast<int64_t>(length);
  }

  void skip(const Property& property) {
    const int64_t count = property.is_list ? list_length(property) : 1;
    for (int64_t k = 0; k < count; ++k) value(property.type);
  }
  void skip(const Element& element) {
    require_room(element);
    for (int64_t i = 0; i < element.count; ++i) {
      begin_element();
      for (const Property& property : element.properties) skip(property);
    }
  }

  void vertices(const Element& element) {
    require_room(element);
    // Where each property goes: 0..2 point, 3..5 normal, 6..7 parameters, -1 nowhere.
    static const std::map<std::string_view, int> slots{{"x", 0},  {"y", 1},  {"z", 2},         {"nx", 3},
                                                       {"ny", 4}, {"nz", 5}, {"u", 6},         {"v", 7},
                                                       {"s", 6},  {"t", 7},  {"texture_u", 6}, {"texture_v", 7}};
    std::vector<int> slot_of;
    std::array<bool, 8> present{};
    for (const Property& property : element.properties) {
      const auto found = slots.find(property.name);
      slot_of.push_back(found == slots.end() || property.is_list ? -1 : found->second);
      if (slot_of.back() >= 0) present[slot_of.back()] = true;
    }
    if (!present[0] || !present[1] || !present[2]) fail("the element 'vertex' needs the properties x, y and z");
    has_normals_ = present[3] && present[4] && present[5];
    has_parameters_ = present[6] && present[7];
    PointTable table(mesh_);
    for (int64_t i = 0; i < element.count; ++i) {
      begin_element();
      std::array<double, 8> values{};
      for (size_t k = 0; k < slot_of.size(); ++k) {
        if (slot_of[k] < 0)
          skip(element.properties[k]);
        else
          values[slot_of[k]] = value(element.properties[k].type);
      }
      const Vec3 point(values[0], values[1], values[2]);
      if (has_normals_ || has_parameters_) {
        point_of_.push_back(table.index(point));
      } else {
        point_of_.push_back(static_cast<int32_t>(mesh_.points.size()));
        mesh_.points.push_back(point);
      }
      if (has_normals_) mesh_.normals.push_back({values[3], values[4], values[5]});
      if (has_parameters_) mesh_.parameters.push_back({values[6], values[7]});
    }
  }

  void faces(const Element& element) {
    require_room(element);
    const auto is_indices = [](const Property& p) {
      return p.is_list && (p.name == "vertex_indices" || p.name == "vertex_index");
    };
    if (std::none_of(element.properties.begin(), element.properties.end(), is_indices))
      fail("the element 'face' needs the list vertex_indices");
    std::vector<MeshCorner> corners;
    for (int64_t i = 0; i < element.count; ++i) {
      begin_element();
      for (const Property& property : element.properties) {
        if (!is_indices(property)) {
          skip(property);
          continue;
        }
        const int64_t count = list_length(property);
        corners.clear();
        for (int64_t k = 0; k < count; ++k) {
          const double index = value(property.type);
          if (!(index >= 0) || index != std::floor(index) || index >= static_cast<double>(point_of_.size()))
            fail(fmt::format("there is no vertex {} (the first is 0, {} are defined)", index, point_of_.size()));
          const auto vertex = static_cast<int32_t>(index);
          MeshCorner corner;
          corner.point = point_of_[vertex];
          if (has_normals_) corner.normal = vertex;
          if (has_parameters_) corner.parameter = vertex;
          corners.push_back(corner);
        }
        if (count < 3) fail("a face needs at least three corners");
        add_polygon(mesh_, corners, 0);
      }
    }
  }

  std::string_view bytes_;
  TextLines lines_;
  std::string name_;
  std::string_view binary_;
  bool in_binary_ = false;
  bool ascii_ = true, big_endian_ = false;
  std::vector<Element> elements_;
  Words words_{{}};
  std::string_view first_word_;
  bool has_normals_ = false, has_parameters_ = false;
  std::vector<int32_t> point_of_;  // of each vertex
  Mesh mesh_;
};

template <class T>
void append(std::string& bytes, T value) {
  char copy[sizeof(T)];
  std::memcpy(copy, &value, sizeof(T));
  if (std::endian::native == std::endian::big) std::reverse(copy, copy + sizeof(T));
  bytes.append(copy, sizeof(T));
}

}  // namespace

Mesh parse_ply(std::string_view bytes, const std::string& name) { return PlyParser(bytes, name).run(); }

std::string ply_bytes(const Mesh& mesh) {
  // One vertex for each different corner, in the order of their first use.
  const bool with_normals = !mesh.normals.empty(), with_parameters = !mesh.parameters.empty();
  struct Hash {
    size_t operator()(const std::array<int32_t, 3>& c) const {
      uint64_t hash = 0;
      for (int32_t k : c) hash = (hash ^ static_cast<uint32_t>(k)) * 0x9e3779b97f4a7c15u + (hash >> 31);
      return hash;
    }
  };
  std::unordered_map<std::array<int32_t, 3>, int32_t, Hash> numbers;
  std::vector<std::array<int32_t, 3>> corners;
  std::vector<std::array<int32_t, 3>> faces;
  for (const Mesh::Triangle& t : mesh.triangles) {
    std::array<int32_t, 3>& face = faces.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const std::array<int32_t, 3> corner{t.point[k], with_normals ? t.normal[k] : -1,
                                          with_parameters ? t.parameter[k] : -1};
      const auto [found, is_new] = numbers.try_emplace(corner, static_cast<int32_t>(corners.size()));
      if (is_new) corners.push_back(corner);
      face[k] = found->second;
    }
  }
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment lekalo\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n",
      corners.size());
  if (with_normals) bytes += "property double nx\nproperty double ny\nproperty double nz\n";
  if (with_parameters) bytes += "property double u\nproperty double v\n";
  bytes += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", faces.size());
  for (const auto& [point, normal, parameter] : corners) {
    for (int k = 0; k < 3; ++k) append(bytes, mesh.points[point][k]);
    for (int k = 0; with_normals && k < 3; ++k) append(bytes, normal >= 0 ? mesh.normals[normal][k] : 0.0);
    for (int k = 0; with_parameters && k < 2; ++k) append(bytes, parameter >= 0 ? mesh.parameters[parameter][k] : 0.0);
  }
  for (const auto& face : faces) {
    append<uint8_t>(bytes, 3);
    for (int32_t index : face) append(bytes, index);
  }
  return bytes;
}

}  // namespace lekalo::render
