#include "picture.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <set>

#include "command.h"
#include "render/drawing/picture_scale.h"
#include "render/image/atomic_file.h"
#include "render/image/display.h"
#include "render/image/exr.h"
#include "render/image/png.h"
#include "render/integrators/classic.h"
#include "render/lines/strokes.h"
#include "render/materials/materials.h"
#include "render/model/placed_objects.h"

namespace lekalo::command {

namespace {

std::optional<std::time_t> source_date() {
  const char* text = std::getenv("SOURCE_DATE_EPOCH");
  if (!text || !*text) return std::nullopt;
  char* end = nullptr;
  const long long seconds = std::strtoll(text, &end, 10);
  return *end == '\0' && seconds >= 0 ? std::optional(static_cast<std::time_t>(seconds)) : std::nullopt;
}

}  // namespace

void apply(const PictureOverrides& overrides, render::Model& model) {
  if (overrides.size) {
    std::tie(model.film.width, model.film.height) = *overrides.size;
    model.camera = model.make_camera(model.film.width, model.film.height);
  }
  if (overrides.samples) model.film.samples = *overrides.samples;
  if (overrides.representation)
    for (render::Object& object : model.objects) object.representation = *overrides.representation;
  if (overrides.integrator) model.integrator = overrides.integrator;
}

std::pair<int, int> parse_size(const std::string& text) {
  int used = 0, width = 0, height = 0;
  if (std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &used) != 2 || used != static_cast<int>(text.size()) ||
      width < 1 || height < 1)
    throw UsageError(fmt::format("--size takes WIDTHxHEIGHT in pixels, found '{}'", text));
  using render::Film;
  if (width > Film::kMaxSide || height > Film::kMaxSide || 1.0 * width * height > Film::kMaxPixels)
    throw UsageError(fmt::format("--size {} is too large: a side has at most {} pixels, a picture {:.0f} million", text,
                                 Film::kMaxSide, Film::kMaxPixels / 1e6));
  return {width, height};
}

void set_crop(const std::string& text, render::Model& model) {
  const std::vector<double> c = parse_numbers(text, 4, "--crop");
  if (!(c[0] < c[2] && c[1] < c[3]))
    throw UsageError(
        fmt::format("--crop {}: nothing is left; write two corners X0,Y0,X1,Y1 with X0 < X1, Y0 < Y1", text));
  if (std::any_of(c.begin(), c.end(), [](double x) { return x != std::floor(x); }))
    throw UsageError(fmt::format("--crop {}: pixels are whole numbers", text));
  auto& f = model.film;
  f.crop = {static_cast<int>(c[0]), static_cast<int>(c[1]), static_cast<int>(c[2]), static_cast<int>(c[3])};
  if (!(f.crop.x0 >= 0 && f.crop.y0 >= 0 && f.crop.x0 < f.crop.x1 && f.crop.y0 < f.crop.y1 && f.crop.x1 <= f.width &&
        f.crop.y1 <= f.height))
    throw UsageError(
        fmt::format("--crop {} does not lie inside the picture of {} x {} pixels", text, f.width, f.height));
}

void add_metadata(render::RenderResult& result, const render::Model& model, const std::string& scene_file, bool stamp) {
  auto& metadata = result.image.metadata;
  metadata["lekalo.version"] = std::string(LEKALO_VERSION);
  metadata["lekalo.scene"] = std::filesystem::path(scene_file).filename().string();
  metadata["lekalo.samples"] = model.film.samples;
  if (!model.title.empty()) metadata["lekalo.title"] = model.title;
  for (const auto& [name, value] : model.parameters) metadata["lekalo.parameter." + name] = value;
  if (!result.complete) metadata["lekalo.incomplete"] = 1;
  if (!stamp) return;
  metadata["lekalo.date"] = date_text(true);
  if (source_date()) return;
  char supporting_surface[HOST_NAME_MAX + 1] = {};
  if (gethostname(supporting_surface, HOST_NAME_MAX) == 0) metadata["lekalo.host"] = std::string(supporting_surface);
  metadata["lekalo.path"] = std::filesystem::absolute(scene_file).string();
}

void check_writable(const std::vector<render::OutputFile>& files) {
  for (const render::OutputFile& file : files) {
    // Opening a pipe would already say something to its reader.
    const auto status = std::filesystem::status(file.path);
    if (!std::filesystem::exists(status) || std::filesystem::is_regular_file(status) ||
        std::filesystem::is_directory(status))
      render::AtomicFile probe(file.path);
  }
}

void check_inputs_stay(const render::LoadedScene& scene, const std::vector<std::string>& outputs) {
  for (const std::string& output : outputs)
    for (const std::filesystem::path& input : scene.files)
      if (render::resolved_path(output) == render::resolved_path(input))
        throw UsageError(
            fmt::format("'{}' is read by the scene and would be overwritten; write another file with -o", output));
}

void check_is_ours(const std::filesystem::path& path, std::string_view beginning, const char* what) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return;
  std::string found(beginning.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  if (file.read(found.data(), static_cast<std::streamsize>(found.size())) && found == beginning) return;
  throw UsageError(
      fmt::format("'{}' is no {} of lekalo and would be overwritten; move it away, or write another file "
                  "with -o",
                  path.string(), what));
}

void print_defaults(const render::LoadedScene& scene, bool renders, bool draws) {
  const render::Model& model = *scene.model;
  // A page without panels is one of the scene's own.
  render::Panel page;
  page.drawing = model.drawing;
  const std::vector<render::Panel> panels = model.panels.empty() ? std::vector{page} : model.panels;
  const auto shows_in = [](render::DefaultTaken::Of of, const render::Panel& panel) {
    switch (of) {
      case render::DefaultTaken::Of::objects:
        return !panel.objects;
      case render::DefaultTaken::Of::lights:
        return panel.drawing.ground == render::Ground::shaded;
      case render::DefaultTaken::Of::view:
        return !panel.own_camera;
    }
    return true;
  };
  for (const render::DefaultTaken& one : scene.defaults_taken)
    if (renders || (draws && std::any_of(panels.begin(), panels.end(),
                                         [&](const render::Panel& panel) { return shows_in(one.of, panel); })))
      fmt::print(stderr, "default: {}\n", one.text);
}

std::string without_shadow(const render::Model& model) {
  const std::any made = model.integrator ? model.integrator->made_from() : std::any();
  const auto* classic = std::any_cast<render::ClassicOptions>(&made);
  const bool are_cast = std::any_of(model.lights.begin(), model.lights.end(), [](const render::LightPtr& light) {
    return light->casts_shadows() && light->ambient().is_zero();
  });
  std::set<std::string> names;
  const render::Object* opaque = nullptr;  // on which shadows fall
  render::each_object(model.objects, [&](const render::Object& object) {
    const std::any material = object.material ? object.material->made_from() : std::any();
    const auto* clear = std::any_cast<render::Dielectric>(&material);
    if (!clear && !std::holds_alternative<render::GroupPtr>(object.shape)) opaque = &object;
    if (clear && clear->absorption == geometry::Vec3(0)) names.insert(object.name);
  });
  if (!classic || classic->shadows != render::ShadowMode::transparent || !are_cast || !opaque) return {};
  std::string text;
  for (const std::string& name : names) text += fmt::format("{}'{}'", text.empty() ? "" : ", ", name);
  return text;
}

std::string left_to_drawings(const render::Model& model) {
  std::vector<std::string> left = render::left_to_drawings(model.objects);
  const bool has_bars = render::has_color_bars(model);
  if (std::any_of(model.drawing.annotations.begin(), model.drawing.annotations.end(),
                  [&](const render::Annotation& one) { return !has_bars || !render::tells_scale_of_ground(one); }))
    left.push_back("annotations");
  if (!model.panels.empty()) left.push_back("panels");
  bool has_lines = false;
  render::each_object(model.objects,
                      [&](const render::Object& one) { has_lines = has_lines || render::has_lines_in_pictures(one); });
  if (has_lines && model.camera && !model.camera->is_linear())
    left.push_back("lines, points and helpers (before a perspective or parallel camera; tubes are seen)");
  std::string names;
  for (const std::string& name : left) names += (names.empty() ? "" : ", ") + name;
  return names;
}

void write_picture(const render::OutputFile& file, const render::RenderResult& result, const render::Model& model) {
  if (file.path.ends_with(".exr")) {
    render::write_exr(file.path, result.image);
    return;
  }
  const render::DisplayResult shown = render::to_display(result.image, file.display);
  if (shown.non_finite > 0) fmt::print(stderr, "{}: {} pixels are not finite\n", file.path, shown.non_finite);
  const bool has_bars = result.scale && result.complete && render::has_color_bars(model);
  render::write_png(file.path, has_bars ? render::with_color_bars(shown.image, model, *result.scale) : shown.image);
}

std::string date_text(bool with_time) {
  const std::time_t now = source_date().value_or(std::time(nullptr));
  return fmt::format(fmt::runtime(with_time ? "{:%Y-%m-%dT%H:%M:%SZ}" : "{:%Y-%m-%d}"), fmt::gmtime(now));
}

}  // namespace lekalo::command
