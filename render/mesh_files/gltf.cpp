#include "render/mesh_files/gltf.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <utility>

namespace lekalo::render {

namespace {

using geometry::Mesh;
using geometry::Vec3;
using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");

// Numbers of the specification.
constexpr int kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kLineStrip = 3;

Json list_of(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

class Writer {
 public:
  explicit Writer(const GltfScene& scene) : scene_(scene) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "Lekalo"}};
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"nodes", {0}}}});
    if (!scene.title.empty()) json_["scenes"][0]["name"] = scene.title;
    // z up becomes y up: a quarter turn about x.
    json_["nodes"] = Json::array({{{"name", "z up"}, {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}}});
    for (const GltfMaterial& material : scene.materials) add(material);
    for (const GltfNode& node : scene.nodes) add(node);
    if (!extensions_.empty()) json_["extensionsUsed"] = extensions_;
  }

  // `uri`: of the buffer; empty in .glb files.
  Json finish(const std::string& uri) {
    Json buffer = {{"byteLength", bytes_.size()}};
    if (!uri.empty()) buffer["uri"] = uri;
    if (!bytes_.empty()) json_["buffers"] = Json::array({buffer});
    return std::move(json_);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void add(const GltfMaterial& material) {
    const auto share = [](double x) { return std::clamp(x, 0.0, 1.0); };
    const Vec3 color(share(material.color.x), share(material.color.y), share(material.color.z));
    Json one = {{"name", material.name},
                {"doubleSided", true},
                {"pbrMetallicRoughness",
                 {{"baseColorFactor", {color.x, color.y, color.z, 1.0}},
                  {"metallicFactor", share(material.metalness)},
                  {"roughnessFactor", share(material.roughness)}}}};
    const auto extend = [&](const char* name, Json values) {
      one["extensions"][name] = std::move(values);
      extensions_.insert(name);
    };
    if (material.transmission > 0) {
      extend("KHR_materials_transmission", {{"transmissionFactor", share(material.transmission)}});
      extend("KHR_materials_ior", {{"ior", std::max(material.index, 1.0)}});
    }
    if (material.unlit) extend("KHR_materials_unlit", Json::object());
    const double brightest = std::max({material.emission.x, material.emission.y, material.emission.z});
    if (brightest > 0) {
      one["emissiveFactor"] = list_of(material.emission / std::max(brightest, 1.0));
      if (brightest > 1) extend("KHR_materials_emissive_strength", {{"emissiveStrength", brightest}});
    }
    json_["materials"].push_back(one);
  }

  // A view of the buffer, its numbers already checked.
  template <class T>
  int accessor(const std::vector<T>& numbers, const char* type, size_t per_item, int component, int target) {
    const size_t begin = bytes_.size(), count = numbers.size() * sizeof(T);
    bytes_.resize(begin + count);
    std::memcpy(bytes_.data() + begin, numbers.data(), count);
    json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", count}, {"target", target}});
    json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                  {"componentType", component},
                                  {"count", numbers.size() / per_item},
                                  {"type", type}});
    return static_cast<int>(json_["accessors"].size()) - 1;
  }

  int vectors(const std::vector<float>& values, bool positions) {
    for (const float value : values)
      if (!std::isfinite(value)) throw std::invalid_argument("a point or normal is infinite or has no value");
    const int number = accessor(values, "VEC3", 3, kFloat, kArrayBuffer);
    if (!positions) return number;
    std::array<float, 3> lo{values[0], values[1], values[2]}, hi = lo;
    for (size_t i = 0; i < values.size(); ++i)
      lo[i % 3] = std::min(lo[i % 3], values[i]), hi[i % 3] = std::max(hi[i % 3], values[i]);
    json_["accessors"].back()["min"] = lo;
    json_["accessors"].back()["max"] = hi;
    return number;
  }

  static void append(std::vector<float>& values, const Vec3& v) {
    for (int k = 0; k < 3; ++k) values.push_back(static_cast<float>(v[k]));
  }

  // A vertex for each pair of a point and a normal.
  Json triangles(const GltfNode& node, const Vec3& middle) {
    const Mesh& mesh = node.mesh;
    const bool has_normals = !mesh.normals.empty();
    std::map<std::pair<int32_t, int32_t>, uint32_t> vertices;
    std::vector<float> points, normals;
    std::vector<uint32_t> indices;
    for (const Mesh::Triangle& triangle : mesh.triangles)
      for (size_t k = 0; k < 3; ++k) {
        const std::pair key(triangle.point[k], has_normals ? triangle.normal[k] : -1);
        const auto [found, is_new] = vertices.emplace(key, static_cast<uint32_t>(vertices.size()));
        if (is_new) append(points, mesh.points[static_cast<size_t>(key.first)] - middle);
        if (is_new && has_normals) append(normals, mesh.normals[static_cast<size_t>(key.second)]);
        indices.push_back(found->second);
      }
    Json primitive = {{"attributes", {{"POSITION", vectors(points, true)}}}};
    if (has_normals) primitive["attributes"]["NORMAL"] = vectors(normals, false);
    primitive["indices"] = accessor(indices, "SCALAR", 1, kUnsignedInt, kElementArrayBuffer);
    if (node.material >= 0) primitive["material"] = node.material;
    return primitive;
  }

  Json line(const std::vector<Vec3>& points, int material, const Vec3& middle) {
    std::vector<float> values;
    for (const Vec3& p : points) append(values, p - middle);
    Json primitive = {{"attributes", {{"POSITION", vectors(values, true)}}}, {"mode", kLineStrip}};
    if (material >= 0) primitive["material"] = material;
    return primitive;
  }

  void add(const GltfNode& node) {
    Vec3 lo(geometry::kInfinity), hi(-geometry::kInfinity);
    const auto include = [&](const Vec3& p) { lo = glm::min(lo, p), hi = glm::max(hi, p); };
    for (const Vec3& p : node.mesh.points) include(p);
    for (const auto& points : node.lines)
      for (const Vec3& p : points) include(p);
    const Vec3 middle = (lo + hi) / 2.0;
    Json primitives = Json::array();
    if (!node.mesh.triangles.empty()) primitives.push_back(triangles(node, middle));
    for (const auto& points : node.lines)
      if (points.size() > 1) primitives.push_back(line(points, node.line_material, middle));
    if (primitives.empty()) return;
    json_["meshes"].push_back({{"name", node.name}, {"primitives", primitives}});
    json_["nodes"][0]["children"].push_back(json_["nodes"].size());
    json_["nodes"].push_back(
        {{"name", node.name}, {"mesh", json_["meshes"].size() - 1}, {"translation", list_of(middle)}});
  }

  const GltfScene& scene_;
  Json json_;
  std::string bytes_;
  std::set<std::string> extensions_;
};

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

void append_number(std::string& bytes, size_t number) {
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>(number >> (8 * k) & 255);
}

}  // namespace

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t three = 0;
    for (size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k) result += i + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63] : '=';
  }
  return result;
}

std::string gltf_text(const GltfScene& scene) {
  Writer writer(scene);
  return text_of(writer.finish("data:application/octet-stream;base64," + base64(writer.bytes()))) + "\n";
}

std::string glb_bytes(const GltfScene& scene) {
  Writer writer(scene);
  std::string json = text_of(writer.finish("")), buffer = writer.bytes();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  append_number(bytes, 2);
  append_number(bytes, 12 + 8 + json.size() + 8 + buffer.size());
  append_number(bytes, json.size());
  bytes += "JSON" + json;
  append_number(bytes, buffer.size());
  bytes += std::string("BIN\0", 4) + buffer;
  return bytes;
}

}  // namespace lekalo::render
