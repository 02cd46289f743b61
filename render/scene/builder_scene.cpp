// The sections of a scene file, made into a Model, and the defaults that make three lines a good picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/expression/nearest_name.h"
#include "render/cameras/cameras.h"
#include "render/scene/builder.h"
#include "render/scene/scalars.h"
#include "render/scene/sections.h"

namespace lekalo::render {

using geometry::Box3;
using geometry::PictureSize;

namespace {

constexpr double kMostPixels = 1e8;  // of a picture
constexpr double kMillimetresPerInch = 25.4;

// The picture's shape that fits what the camera shows: the ratio height / width of its image, within reason.
double natural_aspect(const CameraFactory& factory, const Shown& shown) {
  const CameraPtr camera = factory(1000, 1000, shown);
  double x0 = geometry::kInfinity, x1 = -x0, y0 = x0, y1 = -x0;
  for (const Vec3& point : shown.points) {
    const PicturePoint p = camera->project(point);
    if (!p.visible_side) return 1;
    x0 = std::min(x0, p.x), x1 = std::max(x1, p.x), y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
  }
  const double width = x1 - x0, height = y1 - y0;
  return width > 0 && height > 0 ? std::clamp(height / width, 0.1, 10.0) : 0.75;
}

}  // namespace

Builder::Builder(const SceneDescription& scene, const BuildOptions& options, Diagnostics& diagnostics)
    : scene_(scene),
      options_(options),
      diagnostics_(diagnostics),
      parameters_(scene.root.find("parameters"), diagnostics) {}

Model Builder::build() {
  Model model;
  if (!scene_.files.empty()) model.source = scene_.files.front()->name;
  const Value& root = scene_.root;
  std::vector<std::string> known;
  for (const SectionDeclaration& section : sections()) known.push_back(section.name);
  for (const Entry& entry : root.entries) {
    if (std::find(known.begin(), known.end(), entry.key.name) != known.end()) continue;
    const auto nearest = geometry::nearest_name(entry.key.name, known);
    diagnostics_.error(entry.key.place,
                       fmt::format("unknown section '{}'{}", entry.key.name,
                                   nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : ""),
                       nearest ? ""
                               : "sections are info, include, parameters, geometry, materials, lights, camera, image, "
                                 "integrator, objects, styles, drawing, panels, layout, outputs");
  }
  for (const char* name : {"info", "parameters", "image"})
    if (const Value* value = section(name); value && !value->is_map() && !value->invalid)
      diagnostics_.error(value->place, fmt::format("'{}' is a map of fields, found {}", name, kind_name(*value)),
                         fmt::format("write {}: {{ name: value, ... }}", name));
  model.parameters = parameters_.all();
  for (const char* name : {"geometry", "materials", "lights"}) declare_section(name);
  if (const Value* info = section("info")) {
    const auto fields =
        info->is_map() ? read_fields(section_declaration("info").fields, *info, {}, "'info'") : std::nullopt;
    if (fields && fields->has("title")) model.title = fields->text("title");
    if (fields && fields->has("unit")) model.unit = fields->text("unit");
  }
  build_objects(model);
  build_named(model);
  build_lights(model);
  build_camera(model);
  build_outputs(model);
  check_drawing();
  return model;
}

// Everything that is named is built, so that errors in unused things are reported too.
void Builder::build_named(Model& model) {
  static const Category geometry_wanted[] = {Category::point, Category::curve, Category::surface, Category::body,
                                             Category::mesh};
  static const Category material_wanted[] = {Category::material};
  for (auto& [name, thing] : sections_["geometry"])
    for (NamedThing::Member& one : thing.members)
      if (const Built* built = member(thing, one, geometry_wanted))
        model.geometry[one.name.empty() ? name : name + "." + one.name] = entity_of(*built);
  for (auto& [name, thing] : sections_["materials"])
    for (NamedThing::Member& one : thing.members)
      if (const Built* built = member(thing, one, material_wanted))
        model.materials[one.name.empty() ? name : name + "." + one.name] = std::any_cast<MaterialPtr>(built->value);
}

MaterialPtr Builder::default_material() {
  if (!default_material_) {
    const Category wanted[] = {Category::material};
    const auto built = build_typed(default_value("{ type: classic, color: '#b9c3cd', ambient: 1, diffuse: 1, specular: 0.1, exponent: 30 }"), {}, wanted);
    if (built) default_material_ = std::any_cast<MaterialPtr>(built->value);
  }
  return default_material_;
}

void Builder::build_object(const Value& map, const Counters& counters, Model& model, std::vector<Object>& into) {
  // The look of lines belongs to drawings.
  const auto fields = read_fields(section_declaration("objects").fields, map, counters, "an object",
                                  {"repeat", "lines", "show", "legend"});
  if (!fields) return;
  Object object;
  const Value* shape = map.find("shape");
  object.name = fields->has("name") ? fields->text("name") : shape && shape->is_scalar() ? shape->text : "";
  object.material = fields->has("material") ? fields->get<MaterialPtr>("material") : default_material();
  if (fields->has("back_material")) object.back_material = fields->get<MaterialPtr>("back_material");
  object.representation = fields->text("representation") == "mesh" ? Representation::mesh : Representation::direct;
  const Fields& mesh = fields->group("mesh");
  if (mesh.has("sag")) object.sag = mesh.number("sag");
  object.sag_pixels = mesh.number("sag_pixels");
  object.flat_shading = fields->text("shading") == "flat";
  if (object.flat_shading && object.representation == Representation::direct && shape)
    for (const std::any& one : fields->references("shape"))
      if (!std::any_cast<geometry::MeshPtr>(&one))
        diagnostics_.error(map.find("shading")->place, "flat shading is for meshes", "add representation: mesh");
  object.visible_to = 0;
  for (const std::string& word : fields->get<std::vector<std::string>>("visible_to"))
    object.visible_to |= static_cast<uint32_t>(word == "camera"   ? RayKind::camera
                                               : word == "shadow" ? RayKind::shadow
                                                                  : RayKind::reflection);
  if (fields->has("clip"))
    for (const Fields& plane : fields->groups("clip"))
      object.clips.push_back({plane.vec3("through"), plane.vec3("normal"), plane.boolean("cap")});
  if (fields->has("transform")) object.transform = fields->transform("transform");
  for (const std::any& one : fields->references("shape")) {
    object.shape = entity_of({Category::surface, one});
    into.push_back(object);
  }
  (void)model;
}

void Builder::build_objects(Model& model) {
  const Value* list = section("objects");
  if (!list) {
    default_objects(model);
    return;
  }
  if (!list->is_sequence() && !list->is_map()) {
    diagnostics_.error(list->place, "'objects' is a list of maps", "write - { shape: name, material: name }");
    return;
  }
  for (const Scoped& item : items(*list, {})) {
    if (!item.value->is_map()) {
      diagnostics_.error(item.value->place, fmt::format("an object is a map, found {}", kind_name(*item.value)),
                         "write - { shape: name, material: name }");
      continue;
    }
    build_object(*item.value, item.counters, model, model.objects);
  }
}

// No objects: every entity that nothing else uses.
void Builder::default_objects(Model& model) {
  static const Category wanted[] = {Category::point, Category::curve, Category::surface, Category::body,
                                    Category::mesh};
  for (auto& [name, thing] : sections_["geometry"])
    for (NamedThing::Member& one : thing.members) member(thing, one, wanted);
  for (auto& [name, thing] : sections_["geometry"]) {
    if (thing.used) continue;
    for (NamedThing::Member& one : thing.members) {
      if (one.state != NamedThing::Member::State::known) continue;
      Object object;
      object.name = one.name.empty() ? name : name + "." + one.name;
      object.shape = entity_of(one.built);
      object.material = default_material();
      model.objects.push_back(std::move(object));
    }
  }
  if (!model.objects.empty()) defaults_.push_back("every entity is shown in a neutral material");
}

void Builder::build_lights(Model& model) {
  static const Category wanted[] = {Category::light};
  for (auto& [name, thing] : sections_["lights"])
    for (NamedThing::Member& one : thing.members)
      if (const Built* built = member(thing, one, wanted))
        model.lights.push_back(std::any_cast<LightPtr>(built->value));
  if (section("lights")) return;
  // The shipped studio, read like any scene file.
  for (const auto& folder : options_.search_path) {
    const auto path = folder / "studio" / "softbox.yaml";
    if (!std::filesystem::exists(path)) continue;
    Diagnostics own;
    ReadOptions read;
    read.search_path = options_.search_path;
    const SceneDescription studio = read_scene(path, read, own);
    Builder inner(studio, options_, own);
    inner.declare_section("lights");
    Model lit;
    inner.build_lights(lit);
    if (own.has_errors()) throw SceneError(own);
    model.lights = lit.lights;
    defaults_.push_back("studio light (studio/softbox.yaml)");
    return;
  }
  defaults_.push_back("no light: the shipped studio is not found");
}

void Builder::build_camera(Model& model) {
  const SectionDeclaration& image = section_declaration("image");
  static const Value empty = [] {
    Value map;
    map.kind = Value::Kind::map;
    return map;
  }();
  const Value* given = section("image");
  const auto fields = read_fields(image.fields, given && given->is_map() ? *given : empty, {}, "'image'");

  static const Category camera_wanted[] = {Category::camera};
  static const Category integrator_wanted[] = {Category::integrator};
  const Value* camera = section("camera");
  const Shown all = shown(model);
  const Box3& box = all.box;
  std::optional<Built> factory;
  if (camera) {
    const char* type =
        camera->is_map() && (camera->find("from") || camera->find("field_of_view")) ? "perspective" : "parallel";
    factory = build_typed(*camera, {}, camera_wanted, type);
  } else {
    // Plan view if flat, else three-quarter view.
    const Vec3 size = box.empty() ? Vec3(1) : box.size();
    const bool flat = size.z <= 1e-9 * std::max(size.x, size.y);
    factory =
        build_typed(default_value(flat ? "{ type: parallel, view: top, margin: 0.05 }"
                                       : "{ type: perspective, view: { azimuth: -60, elevation: 25 }, margin: 0.08 }"),
                    {}, camera_wanted);
    defaults_.push_back(flat ? "plan view" : "three-quarter view");
  }
  const Value* integrator = section("integrator");
  const auto chosen = build_typed(integrator ? *integrator : empty, {}, integrator_wanted, "classic");
  if (chosen) model.integrator = std::any_cast<IntegratorPtr>(chosen->value);
  if (!fields || !factory) return;

  PictureSize size = fields->get<PictureSize>("size");
  const double scale = size.on_paper ? fields->number("dpi") / kMillimetresPerInch : 1;
  const auto& make = std::any_cast<const CameraFactory&>(factory->value);
  try {
    if (size.width == 0 || size.height == 0) {
      const double aspect = natural_aspect(make, all);
      if (size.width == 0) size.width = size.height / aspect;
      if (size.height == 0) size.height = size.width * aspect;
    }
    const double width = std::max(1.0, std::round(size.width * scale)),
                 height = std::max(1.0, std::round(size.height * scale));
    if (width * height > kMostPixels) {
      const Value* place = given ? given->find("size") : nullptr;
      diagnostics_.error(place ? place->place : scene_.root.place,
                         fmt::format("a picture of {:.0f} x {:.0f} pixels is too large", width, height),
                         fmt::format("at most {:.0f} million pixels", kMostPixels / 1e6));
      return;
    }
    model.film.width = static_cast<int>(width);
    model.film.height = static_cast<int>(height);
    model.make_camera = [make, all](int w, int h) { return make(w, h, all); };
    model.camera = model.make_camera(model.film.width, model.film.height);
  } catch (const std::invalid_argument& error) {
    diagnostics_.error(camera ? camera->place : scene_.root.place, error.what());
    return;
  }
  Film& film = model.film;
  film.samples = fields->integer("samples");
  film.filter = fields->text("filter");
  film.filter_radius = fields->number("filter_radius");
  film.contrast = fields->number("contrast");
  film.half_color = fields->text("color_precision") == "half";
  if (fields->has("layers")) film.layers = fields->get<std::vector<std::string>>("layers");
  film.seed = static_cast<uint32_t>(fields->integer("seed"));
  model.background = rgb(fields->vec3("background"));
  if (fields->has("crop")) {
    const std::vector<double>& c = fields->numbers("crop");
    film.crop = {static_cast<int>(c[0]), static_cast<int>(c[1]), static_cast<int>(c[2]), static_cast<int>(c[3])};
    if (!(film.crop.x0 < film.crop.x1 && film.crop.y0 < film.crop.y1 && film.crop.x1 <= film.width &&
          film.crop.y1 <= film.height))
      diagnostics_.error(
          given->find("crop")->place,
          fmt::format("this part does not lie inside the picture of {} x {} pixels", film.width, film.height),
          "x0, y0, x1, y1 with x0 < x1 and y0 < y1");
  }
}

void Builder::build_outputs(Model& model) {
  const Value* list = section("outputs");
  if (!list) return;
  for (const Scoped& item : items(*list, {})) {
    OutputFile output;
    const Value* file = item.value;
    if (item.value->is_map()) {
      const auto fields =
          read_fields(section_declaration("outputs").fields, *item.value, item.counters, "an output", {"repeat"});
      if (!fields) continue;
      file = item.value->find("file");
      output.exposure = fields->number("exposure");
      output.filmic = fields->text("tone") == "filmic";
      output.kind = fields->text("kind") == "drawing" ? "drawing" : "";
      if (fields->has("panel")) output.options["panel"] = fields->text("panel");
    }
    const auto name = read_text(*file);
    if (!name) {
      report(diagnostics_, *file, name.slip());
      continue;
    }
    output.path = *name;
    const std::string ending = std::filesystem::path(*name).extension().string();
    if (ending == ".exr" || ending == ".png") {
      if (output.kind.empty()) output.kind = "render";
    } else if (ending == ".pdf" || ending == ".svg") {
      output.kind = "drawing";
    } else {
      diagnostics_.error(file->place, fmt::format("'{}' has an unknown ending", *name),
                         "exr or png for pictures, pdf or svg for drawings");
      continue;
    }
    model.outputs.push_back(std::move(output));
  }
}

// Drawings read these sections; here only their shape is checked, so that slips are found by every command.
void Builder::check_drawing() {
  for (const char* name : {"styles", "drawing", "panels", "layout"}) {
    const Value* value = section(name);
    if (value && !value->is_map() && !value->invalid)
      diagnostics_.error(value->place, fmt::format("'{}' is a map, found {}", name, kind_name(*value)));
  }
}

}  // namespace lekalo::render
