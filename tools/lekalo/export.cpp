// lekalo export: what a scene shows as one triangle mesh for another program, curves as polylines or as NURBS curves,
// boundary representations for CAD systems, or the whole scene for POV-Ray.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>

#include "command.h"
#include "geometry/tessellation/tessellate.h"
#include "geometry/transformed.h"
#include "measure.h"
#include "picture.h"
#include "render/image/atomic_file.h"
#include "render/image/display.h"
#include "render/mesh_files/mesh_files.h"
#include "render/model/mesh_tolerance.h"
#include "render/pov/pov_export.h"
#include "render/step/step_export.h"

namespace lekalo::command {

namespace {

using geometry::Affine;
using geometry::Mesh;

struct Options {
  SceneOptions scene;
  std::vector<std::string> names;
  std::string format, output;
  double sag = 0;
  double tolerance = 1e-9;
  render::PovOptions pov;
  bool quiet = false;
};

// Meshes collected into one; faces are numbered on, so that a file keeps them apart.
class Collection {
 public:
  explicit Collection(double sag) : sag_(sag) {}

  // The object says how the shape is to be meshed; its own transform is in to_world.
  void add_shape(const render::Object& object, const Affine& to_world) {
    const render::Entity& entity = object.shape;
    const std::string& name = object.name;
    const auto tolerance = [&] { return tolerance_of(object, to_world); };
    if (const auto* surface = std::get_if<geometry::SurfacePtr>(&entity)) {
      add_surface(**surface, to_world, tolerance(), name);
    } else if (const auto* set = std::get_if<render::SurfaceSet>(&entity)) {
      for (const geometry::SurfacePtr& one : *set) add_surface(*one, to_world, tolerance(), name);
    } else if (const auto* curve = std::get_if<geometry::CurvePtr>(&entity)) {
      add_curve(**curve, to_world, tolerance(), name);
    } else if (const auto* body = std::get_if<geometry::BodyPtr>(&entity)) {
      append(tessellate(**body, tolerance()), to_world);
    } else if (const auto* mesh = std::get_if<geometry::MeshPtr>(&entity)) {
      append(**mesh, to_world);
    } else if (const auto* group = std::get_if<render::GroupPtr>(&entity)) {
      for (const render::Object& object : (*group)->objects) add(object, to_world);
    } else if (std::holds_alternative<geometry::ShapePtr>(entity)) {
      left_out_.insert(fmt::format("'{}' is met by rays only and has no triangles", name));
    } else {
      left_out_.insert(fmt::format("'{}' is a point and has no triangles", name));
    }
  }

  void add(const render::Object& object, const Affine& to_world) {
    if (!object.clips.empty())
      left_out_.insert(fmt::format("'{}' is written whole: its clip planes are not applied", object.name));
    add_shape(object, to_world * object.transform);
  }

  void add(const std::string& name, const render::Entity& entity) {
    render::Object object;
    object.name = name;
    object.shape = entity;
    add_shape(object, Affine());
  }

  // Corners without normals or parameters get them where others have some: a file has them for all or none.
  Mesh finish() {
    if (with_normals_ && without_normals_) {
      for (Mesh::Triangle& triangle : all_.triangles) {
        if (triangle.normal[0] >= 0) continue;
        const auto& p = triangle.point;
        const geometry::Vec3 area =
            glm::cross(all_.points[p[1]] - all_.points[p[0]], all_.points[p[2]] - all_.points[p[0]]);
        const double length = glm::length(area);
        triangle.normal.fill(static_cast<int32_t>(all_.normals.size()));
        all_.normals.push_back(length > 0 ? area / length : geometry::Vec3(0, 0, 1));
      }
    }
    if (without_parameters_) {
      all_.parameters.clear();
      for (Mesh::Triangle& triangle : all_.triangles) triangle.parameter.fill(-1);
    }
    return std::move(all_);
  }

  // The polygons of curves.
  const std::vector<std::vector<geometry::Vec3>>& lines() const { return lines_; }

  const std::set<std::string>& left_out() const { return left_out_; }

 private:
  geometry::TessellationTolerance tolerance_of(render::Object object, const Affine& to_world) const {
    if (sag_ > 0) object.sag = sag_;
    auto result = render::mesh_tolerance(object, to_world, nullptr);
    // What another program shades smooth with the normals of the file needs no finer steps.
    if (object.mesh_angle == 0 && !std::holds_alternative<geometry::CurvePtr>(object.shape))
      result.angle = geometry::TessellationTolerance().angle;
    return result;
  }

  void add_curve(const geometry::Curve& curve, const Affine& to_world, const geometry::TessellationTolerance& tolerance,
                 const std::string& name) {
    if (!(curve.domain().width() < geometry::kInfinity)) {
      left_out_.insert(fmt::format("'{}' is left out: it has no ends", name));
      return;
    }
    lines_.emplace_back();
    for (const double t : polygon_parameters(curve, tolerance)) lines_.back().push_back(to_world.point(curve.point(t)));
  }

  void add_surface(const geometry::Surface& surface, const Affine& to_world,
                   const geometry::TessellationTolerance& tolerance, const std::string& name) {
    if (surface.bounded())
      append(tessellate(surface, tolerance), to_world);
    else
      left_out_.insert(fmt::format("'{}' is left out: it has no bounds; give it a domain", name));
  }

  void append(const Mesh& given, const Affine& to_world) {
    const Mesh part = to_world.is_identity() ? given : transformed(given, to_world);
    int32_t faces = 0;
    const auto shift = [](std::array<int32_t, 3>& index, size_t by) {
      for (int32_t& i : index)
        if (i >= 0) i += static_cast<int32_t>(by);
    };
    for (Mesh::Triangle triangle : part.triangles) {
      shift(triangle.point, all_.points.size());
      shift(triangle.normal, all_.normals.size());
      shift(triangle.parameter, all_.parameters.size());
      faces = std::max(faces, triangle.face + 1);
      triangle.face += faces_;
      all_.triangles.push_back(triangle);
    }
    faces_ += faces;
    (part.normals.empty() ? without_normals_ : with_normals_) = true;
    without_parameters_ = without_parameters_ || part.parameters.empty();
    all_.points.insert(all_.points.end(), part.points.begin(), part.points.end());
    all_.normals.insert(all_.normals.end(), part.normals.begin(), part.normals.end());
    all_.parameters.insert(all_.parameters.end(), part.parameters.begin(), part.parameters.end());
  }

  double sag_;
  Mesh all_;
  std::vector<std::vector<geometry::Vec3>> lines_;
  int32_t faces_ = 0;
  bool with_normals_ = false, without_normals_ = false, without_parameters_ = false;
  std::set<std::string> left_out_;
};

int export_pov(const Options& options, const std::string& output) {
  if (!options.names.empty()) throw UsageError("--format pov writes the whole scene; leave the names out");
  render::PovOptions pov = options.pov;
  pov.sag = options.sag;
  const render::LoadedScene loaded = options.scene.load();
  check_inputs_stay(loaded, {output});
  const render::PovScene scene = render::pov_scene(*loaded.model, pov);
  render::write_file_atomically(output, scene.text);
  if (!options.quiet) {
    for (const std::string& note : scene.notes) fmt::print(stderr, "not exact: {}\n", note);
    fmt::print(stderr, "{}\n", output);
  }
  return kDone;
}

// The curves and surfaces named, or all that the scene's objects show, as NURBS; those of objects where they are moved
// to, those of a set each by itself.
int export_json(const Options& options, const std::string& output) {
  const render::LoadedScene scene = options.scene.load();
  check_inputs_stay(scene, {output});
  ordered_json curves = ordered_json::array(), surfaces = ordered_json::array();
  const auto add = [&](const std::string& name, const render::Entity& entity) {
    ordered_json form = nurbs_form(name, entity);
    (form["kind"] == "curve" ? curves : surfaces).push_back(std::move(form));
  };
  const auto add_set = [&](const std::string& name, const render::SurfaceSet& set, const Affine& to_world) {
    for (size_t i = 0; i < set.size(); ++i) add(fmt::format("{}[{}]", name, i), transformed(set[i], to_world));
  };
  for (const std::string& name : options.names) {
    const render::Entity& entity = find_geometry(scene, name);
    if (const auto* set = std::get_if<render::SurfaceSet>(&entity))
      add_set(name, *set, Affine());
    else
      add(name, entity);
  }
  if (options.names.empty())
    for (const render::Object& object : scene.model->objects) {
      if (const auto* curve = std::get_if<geometry::CurvePtr>(&object.shape))
        add(object.name, transformed(*curve, object.transform));
      else if (const auto* surface = std::get_if<geometry::SurfacePtr>(&object.shape))
        add(object.name, transformed(*surface, object.transform));
      else if (const auto* set = std::get_if<render::SurfaceSet>(&object.shape))
        add_set(object.name, *set, object.transform);
      else if (!options.quiet)
        fmt::print(stderr, "note: '{}' is left out: JSON files hold curves and surfaces\n", object.name);
    }
  if (curves.empty() && surfaces.empty())
    throw UsageError("there is nothing to export: no curve and no surface is shown");
  render::write_file_atomically(output, ordered_json{{"curves", curves}, {"surfaces", surfaces}}.dump(2) + "\n");
  if (!options.quiet) fmt::print(stderr, "{}: {} curves, {} surfaces\n", output, curves.size(), surfaces.size());
  return kDone;
}

// Everything that is named or shown, as a boundary representation.
int export_step(const Options& options, const std::string& output) {
  const render::LoadedScene scene = options.scene.load();
  check_inputs_stay(scene, {output});
  std::vector<render::StepShape> shapes;
  std::set<std::string> notes;
  const auto color_of = [](const render::Object& object) -> std::optional<geometry::Vec3> {
    if (!object.material) return std::nullopt;
    const geometry::Vec3 linear = rgb(object.material->albedo(render::SurfacePoint(), render::Wavelengths{}));
    geometry::Vec3 color(0);
    for (int i = 0; i < 3; ++i) color[i] = render::srgb_encode(std::clamp(linear[i], 0.0, 1.0));
    return color;
  };
  const std::function<void(const render::Object&, const Affine&)> add = [&](const render::Object& object,
                                                                            const Affine& to_world) {
    const Affine moved = to_world * object.transform;
    if (!object.clips.empty())
      notes.insert(fmt::format("'{}' is written whole: its clip planes are not applied", object.name));
    if (const auto* group = std::get_if<render::GroupPtr>(&object.shape))
      for (const render::Object& member : (*group)->objects) add(member, moved);
    else
      shapes.push_back({object.name, object.shape, moved, color_of(object)});
  };
  for (const std::string& name : options.names) shapes.push_back({name, find_geometry(scene, name), Affine(), {}});
  if (options.names.empty())
    for (const render::Object& object : scene.model->objects) add(object, Affine());
  render::StepFile file;
  try {
    file = step_file(shapes, scene.model->title, scene.model->unit, options.tolerance);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("there is nothing to export: {}", error.what()));
  }
  notes.insert(file.notes.begin(), file.notes.end());
  render::write_file_atomically(output, file.text);
  for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", note);
  if (!options.quiet) fmt::print(stderr, "{}: {} shape{}\n", output, file.products, file.products == 1 ? "" : "s");
  return kDone;
}

int run(const Options& options) {
  std::string output = options.output;
  if (output.empty()) {
    if (options.format.empty()) throw UsageError("export takes -o FILE, or --format obj|ply|stl|json|step|pov");
    output = std::filesystem::path(options.scene.file).stem().string() + "." + options.format;
  }
  if (options.format == "json" || (options.format.empty() && output.ends_with(".json")))
    return export_json(options, output);
  if (options.format == "pov" || (options.format.empty() && output.ends_with(".pov")))
    return export_pov(options, output);
  if (options.format == "step" || (options.format.empty() && (output.ends_with(".step") || output.ends_with(".stp"))))
    return export_step(options, output);
  render::MeshFormat format;
  try {
    format = render::mesh_format(options.format.empty() ? output : "mesh." + options.format);
  } catch (const render::MeshFileError& error) {
    throw UsageError(fmt::format("{}; or give --format obj|ply|stl|json|step|pov", error.what()));
  }
  const render::LoadedScene scene = options.scene.load();
  check_inputs_stay(scene, {output});
  Collection collection(options.sag);
  if (options.names.empty())
    for (const render::Object& object : scene.model->objects) collection.add(object, Affine());
  for (const std::string& name : options.names) collection.add(name, find_geometry(scene, name));
  const Mesh mesh = collection.finish();
  for (const std::string& note : collection.left_out()) fmt::print(stderr, "note: {}\n", note);
  const bool has_lines = format == render::MeshFormat::obj && !collection.lines().empty();
  if (!has_lines && !collection.lines().empty())
    fmt::print(stderr, "note: curves are left out: only OBJ files hold polylines\n");
  if (mesh.triangles.empty() && !has_lines)
    throw UsageError("there is nothing to export: no surface, body, mesh or (to OBJ) curve is shown");
  std::string bytes = render::mesh_bytes(format, mesh);
  if (has_lines) bytes += render::obj_lines(mesh.points.size(), collection.lines());
  render::write_file_atomically(output, bytes);
  if (!options.quiet)
    fmt::print(stderr, "{}: {} points, {} triangles{}\n", output, mesh.points.size(), mesh.triangles.size(),
               has_lines ? fmt::format(", {} polylines", collection.lines().size()) : "");
  return kDone;
}

}  // namespace

void add_export(CLI::App& app, Action& action) {
  auto* sub =
      app.add_subcommand("export",
                         "Write what a scene shows as triangles (OBJ, PLY, STL) and polylines (OBJ), curves and "
                         "surfaces as NURBS (JSON), boundary representations (STEP), or the scene for POV-Ray");
  sub->footer(
      "Examples:\n"
      "  lekalo export teapot.yaml -o teapot.obj --sag 0.001\n"
      "  lekalo export plate.yaml plate --format stl\n"
      "  lekalo export curves.yaml rim -o rim.json\n"
      "  lekalo export plate.yaml -o plate.step\n"
      "  lekalo export ring.yaml -o ring.pov && povray +Iring.pov +FE -A\n\n"
      "Without names everything that the scene's objects show is written, moved as they are. Triangles and "
      "the\n"
      "chords of curves keep the sag of --sag in scene units, else of their object's mesh, else a thousandth of their\n"
      "shape's size. PLY has double\n"
      "precision; OBJ has shared points and a group for every face; STL has corners in single precision. JSON has\n"
      "curves and surfaces as NURBS and Bezier pieces, as 'lekalo measure --nurbs --json' prints them: exactly, or\n"
      "fitted to a billionth of a curve's size, to 1e-12 of a surface's. STEP has bodies, surfaces, curves and points\n"
      "exactly where it has such (planes, cylinders, cones, spheres, tori, lines, circles, ellipses, NURBS), else\n"
      "fitted to --tolerance; lengths in info.unit.");
  auto options = std::make_shared<Options>();
  options->scene.add_to(*sub);
  sub->add_option("names", options->names, "geometry to write, in place of the objects")->type_name("NAME");
  sub->add_option("--format", options->format, "what to write; else the output's extension decides")
      ->type_name("NAME")
      ->check(CLI::IsMember({"obj", "ply", "stl", "json", "step", "pov"}));
  sub->add_option("-o,--output", options->output, "file to write; without it SCENE.FORMAT here")->type_name("FILE");
  sub->add_option("--sag", options->sag, "largest distance of a triangle from its surface, of a chord from its curve")
      ->type_name("LENGTH")
      ->check(CLI::PositiveNumber)
      ->check(not_finite);
  sub->add_option("--tolerance", options->tolerance, "step: largest distance of a fit, of the size of each")
      ->type_name("NUMBER")
      ->check(CLI::Range(1e-12, 1e-2));
  sub->add_option("--flatness", options->pov.flatness, "pov: flatness of Bezier patches, in scene units")
      ->type_name("LENGTH")
      ->check(CLI::NonNegativeNumber)
      ->check(not_finite);
  sub->add_option("--patch-steps", options->pov.patch_steps, "pov: u_steps and v_steps of Bezier patches")
      ->check(CLI::Range(1, 8));
  sub->add_flag("--quiet", options->quiet, "print no summary");
  sub->callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace lekalo::command
