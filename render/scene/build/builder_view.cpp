// Lights, camera, picture and output files of a scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/cameras/cameras.h"
#include "render/film/filter.h"
#include "render/film/tiles.h"
#include "render/scene/build/builder.h"
#include "render/scene/types/panels.h"
#include "render/scene/types/sections.h"
#include "render/scene/values/scalars.h"
#include "render/scene/values/words.h"

namespace lekalo::render {

using geometry::Box3;
using geometry::PictureSize;

namespace {

constexpr double kMillimetresPerInch = 25.4;
constexpr double kPixelsPerInch = 96;  // of drawings without a size on paper
constexpr double kMinFree = 2;         // millimetres between the margins of a page whose side is automatic

// The picture's shape that fits what the camera shows: the ratio height / width of its image, within reason.
double natural_aspect(const CameraFactory& factory, const FramedContent& shown) {
  const CameraPtr camera = factory(1000, 1000, shown);
  double x0 = geometry::kInfinity, x1 = -x0, y0 = x0, y1 = -x0;
  std::vector<Vec3> points = shown.points();
  if (camera->is_graph()) points.insert(points.end(), {shown.tight_box().lo, shown.tight_box().hi});
  for (const Vec3& point : points) {
    const PicturePoint p = camera->project(point);
    if (!p.visible_side) return 1;
    x0 = std::min(x0, p.x), x1 = std::max(x1, p.x), y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
  }
  const double width = x1 - x0, height = y1 - y0;
  return width > 0 && height > 0 ? std::clamp(height / width, 0.1, 10.0) : 0.75;
}

const Value kEmptyMap = [] {
  Value map;
  map.kind = Value::Kind::map;
  return map;
}();

ToneCurve tone_curve(const std::string& word) {
  if (word == "filmic") return ToneCurve::filmic;
  if (word == "agx") return ToneCurve::agx;
  return word == "pbr_neutral" ? ToneCurve::pbr_neutral : ToneCurve::none;
}

// The view with all its names, or an error at the name that is wrong.
std::optional<ColorView> color_view(const Fields& given, const Value& value, Diagnostics& diagnostics) {
  const auto word = [&](const char* field) { return given.has(field) ? given.text(field) : std::string(); };
  ColorView view{word("config"), word("display"), word("view"), word("space"), word("looks")};
  const ColorViewFault fault = complete(view);
  if (fault.member.empty()) return view;
  const Value* field = value.find(fault.member);
  diagnostics.error((field ? *field : value).place, fault.message, fault.hint);
  return std::nullopt;
}

}  // namespace

void Builder::build_lights(Model& model) {
  visit_named("lights", Category::light, [&](const std::string&, const Built& built) {
    model.lights.push_back(std::any_cast<LightPtr>(built.value));
  });
  if (light_groups(model).size() >= LightParts::kMaxGroups)
    diagnostics_.error(section("lights")->place, "too many groups of lights",
                       fmt::format("at most {}", LightParts::kMaxGroups - 1));
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
    defaults_.push_back({DefaultTaken::Of::lights, "studio light (studio/softbox.yaml)"});
    return;
  }
  std::string looked;
  for (const auto& folder : options_.search_path) looked += (looked.empty() ? "" : ", ") + folder.string();
  diagnostics_.unreadable(
      {scene_.files.front(), 0, 0, 1},
      "the shipped studio, which lights scenes without lights of their own, is not found: "
      "studio/softbox.yaml in " +
          (looked.empty() ? "no folder of shipped scenes" : looked),
      "the installation is not whole; until it is, write lights in the scene (lights: {} for none)");
}

void Builder::build_camera(Model& model) {
  static const Category camera_wanted[] = {Category::camera};
  static const Category integrator_wanted[] = {Category::integrator};
  const Value* given = section("image");
  const auto image =
      read_fields(section_declaration("image").fields, given && given->is_map() ? *given : kEmptyMap, {}, "'image'");
  const Value* camera = section("camera");
  FramedContent all(model.objects);
  all.objects = std::make_shared<const std::vector<Object>>(names_frames() ? model.objects : std::vector<Object>());
  const Box3& box = all.box;
  std::optional<Built> factory;
  if (camera) {
    factory = build_typed(*camera, {}, camera_wanted);
  } else {
    // Plan view if flat, else three-quarter view.
    const Vec3 size = box.empty() ? Vec3(1) : box.size();
    const bool flat = size.z <= 1e-9 * std::max(size.x, size.y);
    factory =
        build_typed(default_value(flat ? "{ type: parallel, view: top, margin: 0.05 }"
                                       : "{ type: perspective, view: { azimuth: -60, elevation: 25 }, margin: 0.08 }"),
                    {}, camera_wanted);
    defaults_.push_back({DefaultTaken::Of::view, flat ? "plan view" : "three-quarter view"});
  }
  const Value* integrator = section("integrator");
  const auto chosen = build_typed(integrator ? *integrator : kEmptyMap, {}, integrator_wanted);
  if (chosen) model.integrator = std::any_cast<IntegratorPtr>(chosen->value);
  if (image) build_film(*image, model);
  if (!image || !factory) return;
  model.paper.size_place = model.paper.margin_place = scene_.root.place;
  if (given) {
    if (const Value* size = given->find("size")) model.paper.size_place = size->place;
    if (const Value* margin = given->find("margin")) model.paper.margin_place = margin->place;
  }
  const auto make = std::any_cast<CameraFactory>(factory->value);
  model.camera_frames = !camera || !camera->find("from");
  model.make_camera = [make, all](int w, int h) { return make(w, h, all); };
  scene_view_ = make;
  attempt(camera ? *camera : scene_.root, "'camera'", [&] {
    PictureSize size = image->get<PictureSize>("size");
    const double scale = size.on_paper ? image->number("dpi") / kMillimetresPerInch : 1;
    model.paper.auto_width = size.width == 0, model.paper.auto_height = size.height == 0;
    double aspect = 0;
    if (size.width == 0 || size.height == 0) {
      aspect = natural_aspect(make, all);
      if (size.width == 0) size.width = size.height / aspect;
      if (size.height == 0) size.height = size.width * aspect;
    }
    const double millimetres = size.on_paper ? 1 : kMillimetresPerInch / kPixelsPerInch;
    model.paper.width = size.width * millimetres;
    model.paper.height = size.height * millimetres;
    // A page has its margins beside that: what is between them has the content's shape. Rendered pictures have none.
    if (const double margins = 2 * model.paper.margin; margins > 0) {
      const double free_width = model.paper.width - margins, free_height = model.paper.height - margins;
      if (model.paper.auto_height) model.paper.height = margins + std::max(kMinFree, free_width * aspect);
      if (model.paper.auto_width) model.paper.width = margins + std::max(kMinFree, free_height / aspect);
    }
    const double width = std::max(1.0, std::round(size.width * scale)),
                 height = std::max(1.0, std::round(size.height * scale));
    if (width * height > Film::kMaxPixels) {
      const Value* place = given ? given->find("size") : nullptr;
      diagnostics_.error(place ? place->place : scene_.root.place,
                         fmt::format("a picture of {:.0f} x {:.0f} pixels is too large", width, height),
                         fmt::format("at most {:.0f} million pixels", Film::kMaxPixels / 1e6));
      return false;
    }
    model.film.width = static_cast<int>(width);
    model.film.height = static_cast<int>(height);
    model.camera = model.make_camera(model.film.width, model.film.height);
    check_crop(*image, given, model.film);
    return true;
  });
}

void Builder::build_film(const Fields& image, Model& model) {
  Film& film = model.film;
  film.samples = image.integer("samples");
  film.filter = image.text("filter");
  film.filter_radius = image.number("filter_radius");
  film.contrast = image.number("contrast");
  film.noise = image.number("noise");
  film.half_color = image.text("color_precision") == "half";
  if (image.has("layers")) film.layers = image.get<std::vector<std::string>>("layers");
  if (image.has("layers") && model.integrator) {
    const std::string fault =
        TiledFilm::fault_of_layers(film, {model.integrator->quantity(), model.integrator->tells_parts(), {}});
    if (!fault.empty()) diagnostics_.error(section("image")->find("layers")->place, fault);
  }
  film.seed = static_cast<uint32_t>(image.integer("seed"));
  model.background = rgb(image.vec3("background"));
  const Value* given = section("image");
  if (film.filter_radius > 0 && film.filter_radius < kMinFilterRadius)
    diagnostics_.error(given->find("filter_radius")->place,
                       fmt::format("the filter reaches less than {} pixels: it would miss samples", kMinFilterRadius),
                       fmt::format("from {} to {}, or 0 for the filter's own", kMinFilterRadius, kMaxFilterRadius));
  if (!model.background.is_finite())
    diagnostics_.error(given->find("background")->place, "too bright: pictures hold numbers up to 3.4e38");
  if (image.has("margin")) model.paper.margin = image.number("margin");
}

void Builder::check_crop(const Fields& image, const Value* given, Film& film) {
  if (!image.has("crop")) return;
  const std::vector<double>& c = image.numbers("crop");
  film.crop = {static_cast<int>(c[0]), static_cast<int>(c[1]), static_cast<int>(c[2]), static_cast<int>(c[3])};
  if (film.crop.x0 < film.crop.x1 && film.crop.y0 < film.crop.y1 && film.crop.x1 <= film.width &&
      film.crop.y1 <= film.height)
    return;
  diagnostics_.error(
      given->find("crop")->place,
      fmt::format("this part does not lie inside the picture of {} x {} pixels", film.width, film.height),
      "x0, y0, x1, y1 with x0 < x1 and y0 < y1");
}

// Whether a camera says `frame: [names]`, and so must know the objects.
bool Builder::names_frames() const {
  const auto says_frame = [](const Value* camera) {
    const Value* frame = camera ? camera->find("frame") : nullptr;
    return frame && !(frame->is_scalar() && frame->text == "all");
  };
  if (says_frame(section("camera"))) return true;
  const Value* panels = section("panels");
  return panels && std::any_of(panels->entries.begin(), panels->entries.end(),
                               [&](const Entry& entry) { return says_frame(entry.value.find("camera")); });
}

void Builder::build_outputs(Model& model) {
  const Value* list = section("outputs");
  if (!list) return;
  for (const Scoped& item : items(*list, {}))
    if (auto output = build_output(*item.value, item.counters)) model.outputs.push_back(*std::move(output));
}

std::optional<OutputFile> Builder::build_output(const Value& value, const Counters& counters) {
  OutputFile output;
  const Value* file = &value;
  std::optional<Fields> fields;
  if (value.is_map()) {
    fields = read_fields(section_declaration("outputs").fields, value, counters, "an output", {"repeat"});
    if (!fields) return std::nullopt;
    file = value.find("file");
  }
  const auto name = read_text(*file);
  if (!name) {
    report(diagnostics_, *file, name.slip());
    return std::nullopt;
  }
  output.path = *name;
  const std::string ending = std::filesystem::path(*name).extension().string();
  const bool is_png = ending == ".png",
             is_drawing = ending == ".pdf" || ending == ".svg" || ending == ".dxf" || ending == ".tikz";
  if (!is_png && !is_drawing && ending != ".exr") {
    diagnostics_.error(file->place, fmt::format("'{}' has an unknown ending", *name),
                       "exr or png for pictures, pdf, svg, dxf or tikz for drawings");
    return std::nullopt;
  }
  output.kind = is_drawing ? "drawing" : "render";
  if (!fields) return output;
  if (fields->given("kind")) {
    if (!is_png && fields->text("kind") != output.kind) {
      diagnostics_.error(value.find("kind")->place, fmt::format("'{}' is always a {}", *name, output.kind),
                         "only a png can be either");
      return std::nullopt;
    }
    output.kind = fields->text("kind");
  }
  output.display.exposure = fields->number("exposure");
  output.display.curve = tone_curve(fields->text("tone"));
  for (const char* field : {"exposure", "tone", "ocio"})
    if (fields->given(field) && !(is_png && output.kind == "render"))
      diagnostics_.error(value.find(field)->place, fmt::format("'{}' is for rendered png files", field),
                         output.kind == "render" ? "exr files hold the light as it is" : "");
  if (fields->has("ocio")) output.display.view = color_view(fields->group("ocio"), *value.find("ocio"), diagnostics_);
  if (output.display.view && fields->given("tone"))
    diagnostics_.error(value.find("tone")->place, "'tone' and 'ocio' are two ways to a display", "keep one of them");
  for (const char* field : {"panel", "width"})
    if (fields->given(field) && output.kind != "drawing")
      diagnostics_.error(value.find(field)->place, fmt::format("'{}' is for drawings", field),
                         is_png ? "add kind: drawing" : "pdf, svg, dxf and tikz files are drawings");
  if (fields->has("width")) output.width = fields->number("width");
  if (fields->has("panel")) {
    output.panel = fields->text("panel");
    check_panel(*value.find("panel"));
  }
  return output;
}

}  // namespace lekalo::render
