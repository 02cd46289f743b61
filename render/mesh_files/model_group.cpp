// A whole model from a file, glTF or OBJ: its meshes where they stand, with the materials and pictures that it names.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

#include "geometry/describe.h"
#include "render/image/image_error.h"
#include "render/image/read_image.h"
#include "render/materials/materials.h"
#include "render/materials/surface_detail.h"
#include "render/materials/textures.h"
#include "render/mesh_files/mesh_files.h"
#include "render/mesh_files/model_file.h"
#include "render/mesh_files/stored_path.h"
#include "render/model/model.h"

namespace lekalo::render {

using namespace geometry;
namespace fs = std::filesystem;

namespace {

class FactoredTexture final : public Texture {
 public:
  FactoredTexture(TexturePtr texture, const Vec3& factor) : texture_(std::move(texture)), factor_(rgb(factor)) {}
  Spectrum at(const SurfacePoint& point) const override { return factor_ * texture_->at(point); }
  uint64_t cell(const SurfacePoint& point) const override { return texture_->cell(point); }

 private:
  TexturePtr texture_;
  Spectrum factor_;
};

// One lane of a texture as a grey.
class LaneTexture final : public Texture {
 public:
  LaneTexture(TexturePtr texture, int lane, double factor)
      : texture_(std::move(texture)), lane_(lane), factor_(static_cast<float>(factor)) {}
  Spectrum at(const SurfacePoint& point) const override {
    const float value = factor_ * texture_->at(point)[lane_];
    return {value, value, value};
  }

 private:
  TexturePtr texture_;
  int lane_;
  float factor_;
};

// A texture whose parameters are an affine image of those of the surface.
class MovedTexture final : public Texture {
 public:
  MovedTexture(TexturePtr texture, const ModelPicture& by)
      : texture_(std::move(texture)), along_u_(by.along_u), along_v_(by.along_v), shift_(by.shift) {}
  Spectrum at(const SurfacePoint& point) const override { return texture_->at(moved(point)); }
  uint64_t cell(const SurfacePoint& point) const override { return texture_->cell(moved(point)); }

 private:
  SurfacePoint moved(const SurfacePoint& point) const {
    SurfacePoint there = point;
    const Vec2 place = point.u * along_u_ + point.v * along_v_ + shift_;
    there.u = place.x;
    there.v = place.y;
    const double det = along_u_.x * along_v_.y - along_u_.y * along_v_.x;
    if (det != 0) {
      there.du = (along_v_.y * point.du - along_u_.y * point.dv) / det;
      there.dv = (along_u_.x * point.dv - along_v_.x * point.du) / det;
    }
    return there;
  }

  TexturePtr texture_;
  Vec2 along_u_, along_v_, shift_;
};

// All or nothing of a grey one.
class CutTexture final : public Texture {
 public:
  CutTexture(TexturePtr texture, double cutoff) : texture_(std::move(texture)), cutoff_(static_cast<float>(cutoff)) {}
  Spectrum at(const SurfacePoint& point) const override {
    const float value = texture_->at(point)[0] >= cutoff_ ? 1 : 0;
    return {value, value, value};
  }

 private:
  TexturePtr texture_;
  float cutoff_;
};

TexturePtr lane(TexturePtr texture, int lane, double factor) {
  return std::make_shared<LaneTexture>(std::move(texture), lane, factor);
}
TexturePtr factored(TexturePtr texture, const Vec3& factor) {
  return std::make_shared<FactoredTexture>(std::move(texture), factor);
}

// The pictures of a model, each read once.
class Pictures {
 public:
  explicit Pictures(fs::path folder) : folder_(std::move(folder)) {}

  Image read(const ModelPicture& picture, SampleEncoding encoding) {
    const auto key = std::pair(picture.bytes.empty() ? picture.file : picture.bytes, encoding);
    const auto found = images_.find(key);
    return found != images_.end() ? found->second : images_[key] = image(picture, encoding);
  }

 private:
  Image image(const ModelPicture& picture, SampleEncoding encoding) const {
    if (picture.bytes.empty()) return read_image(stored_path((folder_ / picture.file).string()), encoding);
    // The readers take files.
    std::string name = (fs::temp_directory_path() / "lekalo_picture_XXXXXX").string();
    const int file = ::mkstemp(name.data());
    if (file < 0) throw ImageError(name, "cannot be written", "");
    ::close(file);
    std::ofstream(name, std::ios::binary) << picture.bytes;
    try {
      Image image = read_image(name, encoding);
      fs::remove(name);
      return image;
    } catch (...) {
      fs::remove(name);
      throw;
    }
  }

  fs::path folder_;
  std::map<std::pair<std::string, SampleEncoding>, Image> images_;
};

TexturePtr texture_of(Image image, const ModelPicture& picture) {
  ImageTexture texture;
  texture.image = std::move(image);
  texture.filtered = true;
  const TexturePtr plain = make_texture(texture);
  const bool moved = picture.along_u != Vec2(1, 0) || picture.along_v != Vec2(0, 1) || picture.shift != Vec2(0);
  return moved ? std::make_shared<MovedTexture>(plain, picture) : plain;
}

// The picture's colours as if nothing of it were transparent, and its alpha as a grey; none where it has none.
std::optional<Image> split_alpha(Image& image) {
  const auto alpha = std::find_if(image.channels.begin(), image.channels.end(),
                                  [](const Channel& channel) { return channel.name == "A"; });
  if (alpha == image.channels.end()) return std::nullopt;
  Image mask = make_image(image.width, image.height);
  Channel& values = add_channel(mask, "Y");
  for (size_t i = 0; i < values.values.size(); ++i) values.values[i] = alpha->values[i];
  for (Channel& channel : image.channels)
    for (size_t i = 0; i < channel.values.size() && channel.name != "A"; ++i)
      if (alpha->values[i] > 0) channel.values[i] /= alpha->values[i];
  image.channels.erase(alpha);
  return mask;
}

MaterialPtr material_of(const ModelMaterial& from, Pictures& pictures) {
  Principled to;
  SurfaceDetail detail;
  to.base_color = glm::clamp(from.base_color, Vec3(0), Vec3(1));
  to.base_metalness = std::clamp(from.metalness, 0.0, 1.0);
  to.specular_roughness = std::clamp(from.roughness, 0.0, 1.0);
  to.transmission_weight = std::clamp(from.transmission, 0.0, 1.0);
  to.specular_weight = from.shines ? 1 : 0;
  to.specular_ior = std::max(1.0, from.index);
  if (from.base_picture.exists()) {
    Image image = pictures.read(from.base_picture, SampleEncoding::linear);
    if (std::optional<Image> mask = split_alpha(image); mask && from.has_holes) {
      TexturePtr opacity = lane(texture_of(std::move(*mask), from.base_picture), 0, from.opacity);
      if (from.cutoff >= 0) opacity = std::make_shared<CutTexture>(std::move(opacity), from.cutoff);
      detail.opacity = std::move(opacity);
      detail.has_holes = true;
    }
    to.base_color = factored(texture_of(std::move(image), from.base_picture), from.base_color);
  }
  if (from.metal_rough_picture.exists()) {
    const TexturePtr both =
        texture_of(pictures.read(from.metal_rough_picture, SampleEncoding::raw), from.metal_rough_picture);
    to.specular_roughness.texture = lane(both, 1, from.roughness);
    to.base_metalness.texture = lane(both, 2, from.metalness);
  }
  if (from.emission != Vec3(0)) {
    to.emission_luminance = 1;
    to.emission_color = from.emission;
    if (from.emission_picture.exists())
      to.emission_color =
          factored(texture_of(pictures.read(from.emission_picture, SampleEncoding::linear), from.emission_picture),
                   from.emission);
  }
  if (from.unlit) {
    to.emission_luminance = 1;
    to.emission_color = to.base_color;
    to.base_color = Vec3(0);
    to.base_metalness = to.specular_weight = 0;
  }
  if (from.normal_picture.exists())
    detail.normal_map = texture_of(pictures.read(from.normal_picture, SampleEncoding::raw), from.normal_picture);
  if (!detail.has_holes && (from.opacity < 1 || from.opacity_picture.exists())) {
    detail.has_holes = true;
    detail.opacity = from.cutoff < 0 ? from.opacity : from.opacity >= from.cutoff ? 1 : 0;
    if (from.opacity_picture.exists())
      detail.opacity = lane(texture_of(pictures.read(from.opacity_picture, SampleEncoding::raw), from.opacity_picture),
                            0, from.opacity);
  }
  if (from.transmission > 0) detail.has_holes = false;
  return with_surface_detail(make_material(to), detail);
}

Affine affine(const double (&m)[16]) {
  return {Mat3(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]), Vec3(m[12], m[13], m[14])};
}

GroupPtr group_of(FileModel model, const std::string& file, bool y_up) {
  Pictures pictures(fs::path(file).parent_path());
  std::vector<MaterialPtr> materials;
  for (const ModelMaterial& material : model.materials) materials.push_back(material_of(material, pictures));
  std::vector<MeshPtr> meshes;
  for (FileModel::Part& part : model.parts) meshes.push_back(std::make_shared<const Mesh>(std::move(part.mesh)));
  const Affine turned = y_up ? Affine{Mat3(1, 0, 0, 0, 0, 1, 0, -1, 0), Vec3(0)} : Affine{};
  auto group = std::make_shared<Group>();
  for (const FileModel::Placed& placed : model.placed) {
    const FileModel::Part& part = model.parts[static_cast<size_t>(placed.part)];
    Object object;
    object.name = part.name;
    object.shape = meshes[static_cast<size_t>(placed.part)];
    object.transform = turned * affine(placed.matrix);
    object.representation = Representation::mesh;
    if (part.material < static_cast<int>(materials.size()))
      object.material = materials[static_cast<size_t>(part.material)];
    group->objects.push_back(std::move(object));
  }
  return group;
}

}  // namespace

TypeDeclaration model_type() {
  TypeDeclaration type = declare(
      Category::group, "model",
      "A model from a glTF or OBJ file, with its materials, pictures and copies. Materials "
      "become `principled`, pictures are read from where the file says. Bumps of OBJ files "
      "(map_Bump) are left out, for their height has no unit; maps of normals (norm) count. Colours of vertices "
      "(COLOR_0) are left out; what is unlit glows with its colour.");
  type.example("file: lamp.glb");
  return type.field("file", file(), "glTF (.gltf, .glb), OBJ, or what else assimp reads")
      .field("up", choice({"y", "z"}), "the file's axis that becomes z; glTF has y, OBJ files this or that", "y")
      .built_by([](const Fields& f) -> std::any {
        try {
          return group_of(read_model(f.text("file")), f.text("file"), f.text("up") == "y");
        } catch (const MeshFileError& error) {
          throw FieldError("file", error.what());
        } catch (const ImageError& error) {
          throw FieldError("file", fmt::format("a picture of the model: {}", error.what()));
        }
      });
}

}  // namespace lekalo::render
