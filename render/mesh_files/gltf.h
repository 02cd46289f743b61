// Scenes for other programs and web pages as glTF 2.0 (Khronos Group 2021): triangles with normals, lines, names,
// metallic-roughness materials.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh.h"

namespace lekalo::render {

struct GltfMaterial {
  std::string name;
  geometry::Vec3 color{0.8};  // linear
  double metalness = 0, roughness = 1;
  double transmission = 0, index = 1.5;  // of clear bodies
  geometry::Vec3 emission{0};
  bool unlit = false;  // shows its colour as it is: lines
};

// In the world; z is up, as in scenes (the file's root turns it to glTF's y).
struct GltfNode {
  std::string name;
  geometry::Mesh mesh;
  std::vector<std::vector<geometry::Vec3>> lines;
  int material = -1, line_material = -1;  // numbers of the scene's; -1: glTF's own
};

struct GltfScene {
  std::string title;
  std::vector<GltfMaterial> materials;
  std::vector<GltfNode> nodes;
};

// A .gltf file, its buffer inside, and a .glb file. Coordinates are single precision about the middle of each node.
// Throws std::invalid_argument for a point or normal that is infinite or has no value.
std::string gltf_text(const GltfScene& scene);
std::string glb_bytes(const GltfScene& scene);

// RFC 4648.
std::string base64(std::string_view bytes);

}  // namespace lekalo::render
