// lekalo export --format gltf, glb, html: objects with their materials, the lines that pictures show, and a page that
// shows them.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <tuple>

#include "export.h"
#include "geometry/tessellation/tessellate.h"
#include "geometry/transformed.h"
#include "mesh_collection.h"
#include "picture.h"
#include "render/image/atomic_file.h"
#include "render/image/image_error.h"
#include "render/lines/strokes.h"
#include "render/materials/materials.h"
#include "render/materials/optical_constants.h"
#include "render/mesh_files/gltf.h"
#include "render/model/face_materials.h"
#include "render/scene/values/characters.h"
#include "render/scene/yaml/data_path.h"
#include "render/scene/yaml/include.h"
#include "render/trace/world.h"

namespace lekalo::command {

namespace {

using geometry::Affine;
using geometry::Vec3;
using render::GltfMaterial;

constexpr std::uintmax_t kViewerBytes = 16 << 20;

// Of what glTF has: colour, metal or not, roughness, clear or not, own light. Textures are one colour.
GltfMaterial material_of(const render::Material& material, std::string name) {
  GltfMaterial result;
  result.name = std::move(name);
  render::SurfacePoint point;
  point.incoming = Vec3(0, 0, -1);
  result.color = render::rgb(material.albedo(point, render::Wavelengths{}));
  const std::any made = material.made_from();
  if (const auto* plastic = std::any_cast<render::Plastic>(&made)) {
    result.roughness = plastic->roughness.at(point);
  } else if (const auto* conductor = std::any_cast<render::Conductor>(&made)) {
    result.metalness = 1;
    result.roughness = conductor->roughness.at(point);
  } else if (const auto* clear = std::any_cast<render::Dielectric>(&made)) {
    result.color = Vec3(1);
    result.transmission = 1;
    result.index = clear->glass.empty() ? clear->index : render::dielectric_index(clear->glass, render::kLineD);
    result.roughness = clear->roughness.at(point);
  } else if (const auto* many = std::any_cast<render::Principled>(&made)) {
    result.metalness = many->base_metalness.at(point);
    result.roughness = many->specular_roughness.at(point);
    result.transmission = many->transmission_weight.at(point);
    result.index = many->specular_ior;
  }
  return result;
}

class Exporter {
 public:
  Exporter(const render::Model& model, double sag) : model_(model), sag_(sag) { scene_.title = model.title; }

  render::GltfScene run(const std::shared_ptr<const render::Model>& shared) {
    for (const render::Object& object : model_.objects) add(object, Affine());
    add_lines(shared);
    return std::move(scene_);
  }
  // Geometry by name, as it is: without materials, and curves as lines.
  render::GltfScene run(const render::LoadedScene& loaded, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      const render::Entity& entity = find_geometry(loaded, name);
      render::GltfNode node;
      node.name = name;
      MeshCollection collection(sag_);
      collection.add(name, entity);
      left_out_.insert(collection.left_out().begin(), collection.left_out().end());
      node.lines = collection.lines();
      if (!node.lines.empty()) node.line_material = line_material(Vec3(0));
      node.mesh = collection.finish();
      if (node.mesh.triangles.empty() && node.lines.empty()) continue;
      scene_.nodes.push_back(std::move(node));
    }
    return std::move(scene_);
  }
  const std::set<std::string>& left_out() const { return left_out_; }

 private:
  void add(const render::Object& object, const Affine& to_world) {
    if (const auto* group = std::get_if<render::GroupPtr>(&object.shape)) {
      for (const render::Object& member : (*group)->objects) add(member, to_world * object.transform);
      return;
    }
    MeshCollection collection(sag_);
    collection.leave_out_curves();
    collection.add(object, to_world);
    left_out_.insert(collection.left_out().begin(), collection.left_out().end());
    const geometry::Mesh mesh = collection.finish();
    // The faces of each material are a node.
    for (const render::Material* material : materials_in(mesh, object)) {
      render::GltfNode node;
      node.name = object.name;
      node.mesh = mesh;
      std::erase_if(node.mesh.triangles,
                    [&](const auto& one) { return material_of_face(object, one.face) != material; });
      if (material) node.material = number_of(*material);
      scene_.nodes.push_back(std::move(node));
    }
  }

  static const render::Material* material_of_face(const render::Object& object, int face) {
    const render::FaceMaterials* faced = render::face_materials(object);
    const render::Material* own = faced ? faced->own(face) : nullptr;
    return own ? own : render::body_material(object).get();
  }
  // In the order of the triangles.
  static std::vector<const render::Material*> materials_in(const geometry::Mesh& mesh, const render::Object& object) {
    std::vector<const render::Material*> all;
    for (const geometry::Mesh::Triangle& triangle : mesh.triangles) {
      const render::Material* one = material_of_face(object, triangle.face);
      if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
    }
    return all;
  }

  int number_of(const render::Material& material) {
    const auto [found, is_new] = materials_.emplace(&material, static_cast<int>(scene_.materials.size()));
    if (is_new) {
      std::string name = fmt::format("material {}", materials_.size());
      for (const auto& [known, one] : model_.materials)
        if (one.get() == &material) name = known;
      scene_.materials.push_back(material_of(material, name));
    }
    return found->second;
  }

  int line_material(const Vec3& color) {
    const auto [found, is_new] =
        line_materials_.emplace(std::tuple(color.x, color.y, color.z), static_cast<int>(scene_.materials.size()));
    if (is_new) {
      GltfMaterial material;
      material.name = fmt::format("lines {}", line_materials_.size());
      material.color = color;
      material.unlit = true;
      scene_.materials.push_back(material);
    }
    return found->second;
  }

  // The lines of an object in one colour are one node.
  void add_lines(const std::shared_ptr<const render::Model>& shared) {
    const render::World world(shared, true);
    const render::LineWork work = render::line_work(world);
    std::map<std::tuple<int, int>, size_t> nodes;
    for (const render::Stroke& stroke : work.strokes) {
      if (!stroke.drawn || !(stroke.curve->domain().width() < geometry::kInfinity)) continue;
      const int material = line_material(render::rgb(stroke.look.color));
      const auto [found, is_new] = nodes.emplace(std::tuple(stroke.object, material), scene_.nodes.size());
      if (is_new) {
        render::GltfNode node;
        node.name =
            (stroke.object >= 0 ? world.objects()[static_cast<size_t>(stroke.object)]->name : std::string("page")) +
            " lines";
        node.line_material = material;
        scene_.nodes.push_back(std::move(node));
      }
      scene_.nodes[found->second].lines.push_back(polyline_of(*transformed(stroke.curve, stroke.to_world)));
    }
  }

  std::vector<Vec3> polyline_of(const geometry::Curve& curve) const {
    geometry::TessellationTolerance tolerance;
    tolerance.sag = sag_ > 0 ? sag_ : 1e-3 * size_of(curve);
    std::vector<Vec3> points;
    for (const double t : polygon_parameters(curve, tolerance)) points.push_back(curve.point(t));
    return points;
  }

  static double size_of(const geometry::Curve& curve) {
    constexpr int kPlaces = 16;
    Vec3 lo(geometry::kInfinity), hi(-geometry::kInfinity);
    for (int i = 0; i <= kPlaces; ++i) {
      const Vec3 p = curve.point(curve.domain().lo + curve.domain().width() * i / kPlaces);
      lo = glm::min(lo, p), hi = glm::max(hi, p);
    }
    return std::max(glm::length(hi - lo), 1e-12);
  }

  const render::Model& model_;
  double sag_;
  render::GltfScene scene_;
  std::map<const render::Material*, int> materials_;
  std::map<std::tuple<double, double, double>, int> line_materials_;
  std::set<std::string> left_out_;
};

// The viewer lies beside the shipped scenes.
std::string viewer() {
  for (const std::filesystem::path& folder : render::data_folders()) {
    std::string reason;
    if (auto text = render::read_file(folder.parent_path() / "viewer/viewer.js", kViewerBytes, true, reason))
      return *text;
  }
  throw render::ImageError("share/lekalo/viewer/viewer.js", "the viewer is not found",
                           "keep the program in its tree, or write a .gltf file");
}

std::string page_of(const render::GltfScene& scene) {
  return fmt::format(
      "<!DOCTYPE html>\n<html>\n<head>\n<meta charset=\"utf-8\">\n<title>{}</title>\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n"
      "<style>html, body {{ margin: 0; height: 100%; overflow: hidden; }}</style>\n</head>\n<body>\n"
      "<script type=\"application/octet-stream\" "
      "id=\"lekalo-model\">{}</script>\n<script>{}</script>\n</body>\n</html>\n",
      render::xml_text(scene.title.empty() ? "Lekalo" : scene.title), render::base64(render::glb_bytes(scene)),
      viewer());
}

}  // namespace

int export_gltf(const ExportOptions& options, const std::string& format, const std::string& output) {
  const render::LoadedScene loaded = options.scene.load();
  check_inputs_stay(loaded, {output});
  Exporter exporter(*loaded.model, options.sag);
  const render::GltfScene scene =
      options.names.empty() ? exporter.run(loaded.model) : exporter.run(loaded, options.names);
  for (const std::string& note : exporter.left_out()) fmt::print(stderr, "note: {}\n", note);
  if (scene.nodes.empty())
    throw UsageError(options.names.empty() ? "there is nothing to export: no surface, body, mesh or line is shown"
                                           : "there is nothing to export: no surface, body, mesh or curve is named");
  render::write_file_atomically(output, format == "gltf"  ? render::gltf_text(scene)
                                        : format == "glb" ? render::glb_bytes(scene)
                                                          : page_of(scene));
  if (!options.quiet)
    fmt::print(stderr, "{}: {} node{}, {} material{}\n", output, scene.nodes.size(), scene.nodes.size() == 1 ? "" : "s",
               scene.materials.size(), scene.materials.size() == 1 ? "" : "s");
  return kDone;
}

}  // namespace lekalo::command
