// Built as the module lekalo_assimp, never into the library: the only file that includes assimp.
#include <assimp/DefaultIOSystem.h>
#include <assimp/GltfMaterial.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "render/mesh_files/model_file.h"
#include "render/mesh_files/stored_path.h"

namespace {

using namespace lekalo::render;
using lekalo::geometry::Vec2;
using lekalo::geometry::Vec3;

ModelPicture picture(const aiScene& scene, const aiMaterial& material, aiTextureType type) {
  aiString path;
  ModelPicture found;
  if (material.GetTexture(type, 0, &path) != AI_SUCCESS) return found;
  found.file = path.C_Str();
  if (const aiTexture* within = scene.GetEmbeddedTexture(path.C_Str())) {
    if (within->mHeight != 0) return {};  // bare pixels: no format that we read stores them
    found.file = std::string("picture.") + within->achFormatHint;
    found.bytes.assign(reinterpret_cast<const char*>(within->pcData), within->mWidth);
  }
  aiUVTransform by;
  if (material.Get(AI_MATKEY_UVTRANSFORM(type, 0), by) == AI_SUCCESS) {
    // As KHR_texture_transform says it, with v downwards: offset + R(rotation) scale (u, v). assimp keeps the rotation
    // negated, and the offset with a part of the others.
    const double cosine = std::cos(by.mRotation), sine = -std::sin(by.mRotation);
    const Vec2 scale(by.mScaling.x, by.mScaling.y);
    const double right = by.mTranslation.x - scale.x / 2 * (1 + sine - cosine);
    const double down = 1 - scale.y - by.mTranslation.y + scale.y / 2 * (sine + cosine - 1);
    found.along_u = scale.x * Vec2(cosine, sine);
    found.along_v = scale.y * Vec2(-sine, cosine);
    found.shift = Vec2(right + sine * scale.y, 1 - down - cosine * scale.y);
  }
  return found;
}

Vec3 color(const aiMaterial& material, const char* key, unsigned type, unsigned index, const Vec3& standard) {
  aiColor3D value;
  return material.Get(key, type, index, value) == AI_SUCCESS ? Vec3(value.r, value.g, value.b) : standard;
}

double number(const aiMaterial& material, const char* key, unsigned type, unsigned index, double standard) {
  ai_real value;
  return material.Get(key, type, index, value) == AI_SUCCESS ? static_cast<double>(value) : standard;
}

ModelPicture first(const ModelPicture& a, const ModelPicture& b) { return a.exists() ? a : b; }

ModelMaterial material_of(const aiScene& scene, const aiMaterial& from) {
  ModelMaterial to;
  to.name = from.GetName().C_Str();
  aiColor4D base;
  const bool is_metal_rough = from.Get(AI_MATKEY_BASE_COLOR, base) == AI_SUCCESS;
  to.base_color = is_metal_rough ? Vec3(base.r, base.g, base.b) : color(from, AI_MATKEY_COLOR_DIFFUSE, Vec3(0.8));
  to.opacity = is_metal_rough ? static_cast<double>(base.a) : number(from, AI_MATKEY_OPACITY, 1);
  to.metalness = number(from, AI_MATKEY_METALLIC_FACTOR, is_metal_rough ? 1 : 0);
  // Of Phong's exponent n: a width of sqrt(2 / (n + 2)), which is the square of the roughness.
  const double shininess = number(from, AI_MATKEY_SHININESS, 10);
  to.roughness = number(from, AI_MATKEY_ROUGHNESS_FACTOR,
                        is_metal_rough ? 1 : std::sqrt(std::sqrt(2 / (std::fmax(0, shininess) + 2))));
  to.transmission = number(from, AI_MATKEY_TRANSMISSION_FACTOR, 0);
  if (const double index = number(from, AI_MATKEY_REFRACTI, 1.5); index > 1) to.index = index;  // OBJ: 1 if not given
  const Vec3 specular = color(from, AI_MATKEY_COLOR_SPECULAR, Vec3(1));
  to.shines = is_metal_rough || std::fmax(specular.x, std::fmax(specular.y, specular.z)) > 0;
  to.emission = number(from, AI_MATKEY_EMISSIVE_INTENSITY, 1) * color(from, AI_MATKEY_COLOR_EMISSIVE, Vec3(0));
  int shading = 0;
  to.unlit =
      is_metal_rough && from.Get(AI_MATKEY_SHADING_MODEL, shading) == AI_SUCCESS && shading == aiShadingMode_Unlit;
  aiString alpha;
  if (from.Get(AI_MATKEY_GLTF_ALPHAMODE, alpha) == AI_SUCCESS) {
    to.has_holes = std::string(alpha.C_Str()) != "OPAQUE";
    if (!to.has_holes) to.opacity = 1;
    if (std::string(alpha.C_Str()) == "MASK") to.cutoff = number(from, AI_MATKEY_GLTF_ALPHACUTOFF, 0.5);
  }
  to.base_picture = first(picture(scene, from, aiTextureType_BASE_COLOR), picture(scene, from, aiTextureType_DIFFUSE));
  to.normal_picture = picture(scene, from, aiTextureType_NORMALS);
  to.emission_picture = picture(scene, from, aiTextureType_EMISSIVE);
  to.opacity_picture = picture(scene, from, aiTextureType_OPACITY);
  if (is_metal_rough) to.metal_rough_picture = picture(scene, from, aiTextureType_UNKNOWN);
  return to;
}

FileModel::Part part_of(const aiMesh& from) {
  FileModel::Part part;
  part.name = from.mName.C_Str();
  part.material = static_cast<int>(from.mMaterialIndex);
  for (unsigned i = 0; i < from.mNumVertices; ++i) {
    part.mesh.points.emplace_back(from.mVertices[i].x, from.mVertices[i].y, from.mVertices[i].z);
    if (from.HasNormals()) {
      const Vec3 n(from.mNormals[i].x, from.mNormals[i].y, from.mNormals[i].z);
      const double length = glm::length(n);
      part.mesh.normals.push_back(length > 0 ? n / length : Vec3(0, 0, 1));
    }
    if (from.HasTextureCoords(0))
      part.mesh.parameters.emplace_back(from.mTextureCoords[0][i].x, from.mTextureCoords[0][i].y);
  }
  for (unsigned i = 0; i < from.mNumFaces; ++i) {
    if (from.mFaces[i].mNumIndices != 3) continue;
    lekalo::geometry::Mesh::Triangle triangle;
    for (size_t k = 0; k < 3; ++k) triangle.point[k] = static_cast<int32_t>(from.mFaces[i].mIndices[k]);
    if (from.HasNormals()) triangle.normal = triangle.point;
    if (from.HasTextureCoords(0)) triangle.parameter = triangle.point;
    part.mesh.triangles.push_back(triangle);
  }
  return part;
}

void place(const aiNode& node, const aiMatrix4x4& above, FileModel& model) {
  const aiMatrix4x4 here = above * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const auto part = static_cast<int>(node.mMeshes[i]);
    if (model.parts[static_cast<size_t>(part)].mesh.triangles.empty()) continue;
    FileModel::Placed placed{part, {}};
    for (unsigned row = 0; row < 4; ++row)
      for (unsigned column = 0; column < 4; ++column)
        placed.matrix[4 * column + row] = static_cast<double>(here[row][column]);
    model.placed.push_back(placed);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) place(*node.mChildren[i], here, model);
}

// assimp before 5.3 does not know how strongly glTF materials glow: the text with the strengths multiplied into their
// colours; empty if it has none.
std::string with_strong_emission(std::string_view text) {
  constexpr const char* kExtension = "KHR_materials_emissive_strength";
  if (text.find(kExtension) == std::string_view::npos) return "";
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(text, nullptr, false);
  if (json.is_discarded() || !json.is_object() || !json.contains("materials")) return "";
  for (auto& material : json["materials"]) {
    if (!material.is_object() || !material.contains("extensions")) continue;
    auto& extensions = material["extensions"];
    if (!extensions.is_object() || !extensions.contains(kExtension)) continue;
    const auto& strength = extensions[kExtension];
    if (strength.is_object() && strength.contains("emissiveStrength") && strength["emissiveStrength"].is_number() &&
        material.contains("emissiveFactor"))
      for (auto& factor : material["emissiveFactor"])
        if (factor.is_number()) factor = factor.get<double>() * strength["emissiveStrength"].get<double>();
    extensions.erase(kExtension);
  }
  return json.dump();
}

// The same of a whole file. The binary form (glTF 2.0, 4.4): a head of 12 bytes with the length of all, then chunks,
// each with its length and kind before it; the first is the text.
std::string with_strong_emission_in(const std::string& file) {
  constexpr size_t kHead = 12, kText = 20;
  if (!file.starts_with("glTF")) return with_strong_emission(file);
  uint32_t length = 0;
  if (file.size() < kText) return "";
  std::memcpy(&length, &file[kHead], 4);
  if (length > file.size() - kText) return "";
  std::string text = with_strong_emission(std::string_view(file).substr(kText, length));
  if (text.empty()) return "";
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string mended = file.substr(0, kText) + text + file.substr(kText + length);
  const auto all = static_cast<uint32_t>(mended.size()), part = static_cast<uint32_t>(text.size());
  std::memcpy(&mended[8], &all, 4);
  std::memcpy(&mended[kHead], &part, 4);
  return mended;
}

// The files of a model, of which the first is read with the strengths of its emission, others where they lie.
class ModelFiles final : public Assimp::DefaultIOSystem {
 public:
  explicit ModelFiles(const char* path) : path_(path) {
    if (!path_.ends_with(".gltf") && !path_.ends_with(".glb")) return;
    std::ifstream stream(path_, std::ios::binary);
    mended_ = with_strong_emission_in(std::string(std::istreambuf_iterator<char>(stream), {}));
  }

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (mended_.empty() || path_ != file) {
      Assimp::IOStream* const stream = DefaultIOSystem::Open(stored_path(file).c_str(), mode);
      note_library(file, stream != nullptr);
      return stream;
    }
    return new Assimp::MemoryIOStream(reinterpret_cast<const uint8_t*>(mended_.data()), mended_.size());
  }

  // The first library of materials of an OBJ file that is not there; empty: all are.
  const std::string& missing_library() const { return missing_; }

 private:
  // In place of one that is not there assimp takes that of the model's name, which it asks for next.
  void note_library(const std::string& file, bool is_there) {
    if (!file.ends_with(".mtl")) return;
    const bool is_own = file == path_.substr(0, path_.rfind('.')) + ".mtl";
    if (!is_there && missing_.empty()) missing_ = file;
    if (is_there && is_own) missing_.clear();
  }

  std::string path_, mended_, missing_;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) bool lekalo_assimp_read(const char* path, FileModel& model,
                                                                          std::string& error) {
  try {
    Assimp::Importer importer;
    auto* const files = new ModelFiles(path);
    importer.SetIOHandler(files);  // which the importer deletes
    const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                                       aiProcess_SortByPType | aiProcess_ValidateDataStructure);
    if (!scene || (scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) || !scene->mRootNode) {
      error = importer.GetErrorString();
      if (error.empty()) error = "the file is not complete";
      return false;
    }
    if (!files->missing_library().empty()) {
      error = "there is no '" + files->missing_library() +
              "', the library of its materials; put it there, or take the file's triangles alone: type: mesh";
      return false;
    }
    for (unsigned i = 0; i < scene->mNumMaterials; ++i)
      model.materials.push_back(material_of(*scene, *scene->mMaterials[i]));
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) model.parts.push_back(part_of(*scene->mMeshes[i]));
    place(*scene->mRootNode, aiMatrix4x4(), model);
    return true;
  } catch (const std::exception& caught) {
    error = caught.what();
    return false;
  }
}
