// lekalo export: what a scene shows as one triangle mesh for another program, curves as polylines or as NURBS curves,
// boundary representations for CAD systems, or the whole scene for POV-Ray.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>

#include "command.h"
#include "export.h"
#include "geometry/transformed.h"
#include "measure.h"
#include "mesh_collection.h"
#include "picture.h"
#include "render/image/atomic_file.h"
#include "render/image/display.h"
#include "render/mesh_files/mesh_files.h"
#include "render/model/face_materials.h"
#include "render/pov/pov_export.h"
#include "render/step/step_export.h"

namespace lekalo::command {

namespace {

using geometry::Affine;
using geometry::Mesh;

struct Options : ExportOptions {
  double tolerance = 1e-9;
  render::PovOptions pov;
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
  const render::SceneWithAttributes scene =
      render::load_with_attributes(options.scene.file, options.scene.load_options());
  print_external_notes(scene, false);
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
  const ordered_json attributes = attributes_of_elements(scene);
  if (curves.empty() && surfaces.empty() && attributes.empty())
    throw UsageError("there is nothing to export: no curve and no surface is shown");
  ordered_json written{{"curves", curves}, {"surfaces", surfaces}};
  if (!attributes.empty()) written["attributes"] = attributes;
  render::write_file_atomically(output, written.dump(2) + "\n");
  if (!options.quiet) fmt::print(stderr, "{}: {} curves, {} surfaces\n", output, curves.size(), surfaces.size());
  return kDone;
}

// Everything that is named or shown, as a boundary representation.
int export_step(const Options& options, const std::string& output) {
  const render::LoadedScene scene = options.scene.load();
  check_inputs_stay(scene, {output});
  std::vector<render::StepShape> shapes;
  std::set<std::string> notes;
  const auto color_of = [](const render::Material& material) {
    const geometry::Vec3 linear = rgb(material.albedo(render::SurfacePoint(), render::Wavelengths{}));
    geometry::Vec3 color(0);
    for (int i = 0; i < 3; ++i) color[i] = render::srgb_encode(std::clamp(linear[i], 0.0, 1.0));
    return color;
  };
  const std::function<void(const render::Object&, const Affine&)> add = [&](const render::Object& object,
                                                                            const Affine& to_world) {
    const Affine moved = to_world * object.transform;
    if (!object.clips.empty())
      notes.insert(fmt::format("'{}' is written whole: its clip planes are not applied", object.name));
    if (const auto* group = std::get_if<render::GroupPtr>(&object.shape)) {
      for (const render::Object& member : (*group)->objects) add(member, moved);
    } else {
      std::string no_boundary;
      const render::Entity shape = by_boundary(object.shape, &no_boundary);
      render::StepShape& written = shapes.emplace_back();
      written.name = object.name;
      written.entity = shape;
      written.to_world = moved;
      written.no_boundary = no_boundary;
      if (const render::MaterialPtr material = render::body_material(object)) written.color = color_of(*material);
      if (const render::FaceMaterials* faced = render::face_materials(object))
        for (const auto& [face, material] : faced->faces()) written.face_colors[face] = color_of(*material);
    }
  };
  for (const std::string& name : options.names) {
    std::string no_boundary;
    const render::Entity shape = by_boundary(find_geometry(scene, name), &no_boundary);
    render::StepShape& written = shapes.emplace_back();
    written.name = name;
    written.entity = shape;
    written.no_boundary = no_boundary;
  }
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
    if (options.format.empty())
      throw UsageError("export takes -o FILE, or --format obj|ply|stl|gltf|glb|html|json|step|pov|cldata");
    output = std::filesystem::path(options.scene.file).stem().string() + "." + options.format;
  }
  if (options.format == "json" || (options.format.empty() && output.ends_with(".json")))
    return export_json(options, output);
  if (options.format == "pov" || (options.format.empty() && output.ends_with(".pov")))
    return export_pov(options, output);
  if (options.format == "step" || (options.format.empty() && (output.ends_with(".step") || output.ends_with(".stp"))))
    return export_step(options, output);
  if (options.format == "cldata" || (options.format.empty() && output.ends_with(".cldata")))
    return export_cldata(options, output);
  for (const char* format : {"gltf", "glb", "html"})
    if (options.format == format || (options.format.empty() && output.ends_with(std::string(".") + format)))
      return export_gltf(options, format, output);
  render::MeshFormat format;
  try {
    format = render::mesh_format(options.format.empty() ? output : "mesh." + options.format);
  } catch (const render::MeshFileError& error) {
    throw UsageError(fmt::format("{}; or give --format obj|ply|stl|gltf|glb|html|json|step|pov|cldata", error.what()));
  }
  const render::LoadedScene scene = options.scene.load();
  check_inputs_stay(scene, {output});
  MeshCollection collection(options.sag);
  if (options.names.empty())
    for (const render::Object& object : scene.model->objects) collection.add(object, Affine());
  for (const std::string& name : options.names) collection.add(name, find_geometry(scene, name));
  const Mesh mesh = collection.finish();
  for (const std::string& note : collection.left_out()) fmt::print(stderr, "note: {}\n", note);
  const bool has_lines = format == render::MeshFormat::obj && !collection.lines().empty();
  if (!has_lines && !collection.lines().empty())
    fmt::print(stderr, "note: curves are left out: only OBJ and glTF files hold lines\n");
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
                         "Write what a scene shows as triangles (OBJ, PLY, STL, glTF) and polylines (OBJ, glTF), "
                         "curves and surfaces as NURBS (JSON), boundary representations (STEP), the scene for POV-Ray, "
                         "a web page (HTML), or paths of cutters (CLDATA)");
  sub->footer(
      "Examples:\n"
      "  lekalo export teapot.yaml -o teapot.obj --sag 0.001\n"
      "  lekalo export plate.yaml plate --format stl\n"
      "  lekalo export curves.yaml rim -o rim.json\n"
      "  lekalo export plate.yaml -o plate.step\n"
      "  lekalo export ring.yaml -o ring.html --sag 0.001\n"
      "  lekalo export ring.yaml -o ring.pov && povray +Iring.pov +FE -A\n\n"
      "Without names everything that the scene's objects show is written, moved as they are. Triangles and "
      "the\n"
      "chords of curves keep the sag of --sag in scene units, else of their object's mesh, else a thousandth of their\n"
      "shape's size. PLY has double\n"
      "precision; OBJ has shared points and a group for every face; STL has corners in single precision. JSON has\n"
      "curves and surfaces as NURBS and Bezier pieces, as 'lekalo measure --nurbs --json' prints them: exactly, or\n"
      "fitted to a billionth of a curve's size, to 1e-12 of a surface's; and the attributes of elements. STEP has "
      "bodies, surfaces, curves and points\n"
      "exactly where it has such (planes, cylinders, cones, spheres, tori, lines, circles, ellipses, NURBS), else\n"
      "fitted to --tolerance; lengths in info.unit. glTF (gltf, glb) has an\n"
      "object a node, materials, and the lines that pictures show; html is a page that shows it and needs no others.\n"
      "cldata has paths of cutters in the words of APT: CUTTER, FEDRAT, RAPID, GOTO with the middle of the cutter's "
      "end\n"
      "and its axis; chords keep the sag of --sag, else a thousandth of the path's size.");
  auto options = std::make_shared<Options>();
  options->scene.add_to(*sub);
  sub->add_option("names", options->names, "geometry to write, in place of the objects")->type_name("NAME");
  sub->add_option("--format", options->format, "what to write; else the output's extension decides")
      ->type_name("NAME")
      ->check(CLI::IsMember({"obj", "ply", "stl", "gltf", "glb", "html", "json", "step", "pov", "cldata"}));
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
