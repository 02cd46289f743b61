// Files of whole models, glTF and OBJ with their materials and textures, as the module that wraps assimp reads them.
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace lekalo::render {

// A picture beside the file or within it.
struct ModelPicture {
  std::string file;   // its name; of one within the file only the ending counts
  std::string bytes;  // of a picture within the file, as stored: PNG, JPEG
  // The place in the picture of the parameters u, v: along_u u + along_v v + shift.
  geometry::Vec2 along_u{1, 0}, along_v{0, 1}, shift{0};
  bool exists() const { return !file.empty(); }
};

// Colours are linear, factors of their pictures.
struct ModelMaterial {
  std::string name;
  geometry::Vec3 base_color{0.8};
  double metalness = 0, roughness = 0.5, opacity = 1, transmission = 0, index = 1.5;
  geometry::Vec3 emission{0};
  bool shines = true;      // else it is matt
  bool unlit = false;      // shows its colour whatever the light (KHR_materials_unlit)
  bool has_holes = false;  // the alpha of base_picture counts
  double cutoff = -1;      // >= 0: what is less opaque is not there, the rest is there fully
  ModelPicture base_picture, normal_picture, emission_picture, opacity_picture;
  ModelPicture metal_rough_picture;  // roughness in green, metalness in blue (glTF 2.0, 3.9.2)
};

struct FileModel {
  struct Part {
    std::string name;
    geometry::Mesh mesh;
    int material = 0;
  };
  // A part as it stands in the model: columns of a 4 x 4 matrix.
  struct Placed {
    int part = 0;
    double matrix[16]{};
  };
  std::vector<ModelMaterial> materials;
  std::vector<Part> parts;
  std::vector<Placed> placed;
};

// What the module's function does. False: `error` says why. Throws nothing.
using ModelRead = bool(const char* path, FileModel& model, std::string& error);
inline constexpr const char* kModelModuleFile = "lekalo_assimp.so";
inline constexpr const char* kModelReadName = "lekalo_assimp_read";

// Throws MeshFileError: unreadable, broken, empty, or the module is missing.
FileModel read_model(const std::string& path);

}  // namespace lekalo::render
