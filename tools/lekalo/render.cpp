// lekalo render: a scene's pictures.
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "command.h"
#include "render/film/render.h"
#include "render/image/display.h"
#include "render/image/exr.h"
#include "render/image/png.h"
#include "render/scene/data_path.h"
#include "render/trace/world.h"

namespace lekalo::command {

namespace {

using render::Model;
using render::OutputFile;

std::atomic<bool> stop_requested{false};

void request_stop(int) { stop_requested = true; }

struct Options {
  SceneOptions scene;
  std::vector<std::string> outputs;
  std::string size, crop, resume;
  int samples = 0;
  int threads = 0;
  std::string representation;
  std::vector<std::string> layers;
  bool half = false, quiet = false, stats = false;
};

void parse_pair(const std::string& text, int& width, int& height) {
  int used = 0;
  if (std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &used) != 2 || used != static_cast<int>(text.size()) ||
      width < 1 || height < 1 || width > 65536 || height > 65536 || 1.0 * width * height > 1e8)
    throw UsageError(fmt::format("--size takes WIDTHxHEIGHT in pixels, found '{}'", text));
}

// One line, rewritten on a terminal, printed now and then when not.
class Progress {
 public:
  explicit Progress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}
  void operator()(double done, uint64_t rays) {
    if (quiet_) return;
    const auto now = std::chrono::steady_clock::now();
    const double elapsed = std::chrono::duration<double>(now - begin_).count();
    const double since = std::chrono::duration<double>(now - last_).count();
    if (since < (terminal_ ? 0.2 : 10.0)) return;
    last_ = now;
    const double left = done > 0 ? elapsed * (1 - done) / done : 0;
    fmt::print(stderr, "{}{:3.0f}%  {:.2f} Mrays/s  {} left{}", terminal_ ? "\r" : "", 100 * done,
               static_cast<double>(rays) / std::max(elapsed, 1e-9) / 1e6, duration(left), terminal_ ? "   " : "\n");
    std::fflush(stderr);
    shown_ = true;
  }
  void end() const {
    if (shown_ && terminal_) fmt::print(stderr, "\r{:60}\r", "");
  }
  static std::string duration(double seconds) {
    const int s = static_cast<int>(std::ceil(seconds));
    return s < 60     ? fmt::format("{} s", s)
           : s < 3600 ? fmt::format("{} min {} s", s / 60, s % 60)
                      : fmt::format("{} h {} min", s / 3600, s / 60 % 60);
  }

 private:
  bool quiet_, terminal_, shown_ = false;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now(), last_ = begin_;
};

std::vector<OutputFile> chosen_outputs(const Options& options, const Model& model) {
  std::vector<OutputFile> outputs;
  if (!options.outputs.empty()) {
    for (const std::string& path : options.outputs) {
      OutputFile file;
      file.path = path;
      const std::string ending = std::filesystem::path(path).extension().string();
      if (ending != ".exr" && ending != ".png") throw UsageError(fmt::format("'{}': render writes exr and png", path));
      // A display transform given in the scene for a png stays in force.
      for (const OutputFile& given : model.outputs)
        if (ending == ".png" && given.kind == "render" && given.path.ends_with(".png")) file = given, file.path = path;
      file.kind = "render";
      outputs.push_back(file);
    }
    return outputs;
  }
  for (const OutputFile& file : model.outputs)
    if (file.kind == "render") outputs.push_back(file);
  if (outputs.empty()) {
    OutputFile file;
    file.path = std::filesystem::path(options.scene.file).stem().string() + ".png";
    file.kind = "render";
    outputs.push_back(file);
  }
  return outputs;
}

void write(const OutputFile& file, const render::Image& image) {
  if (file.path.ends_with(".exr")) {
    render::write_exr(file.path, image);
    return;
  }
  render::DisplayTransform transform;
  transform.exposure = file.exposure;
  transform.curve = file.filmic ? render::ToneCurve::filmic : render::ToneCurve::none;
  const render::DisplayResult shown = render::to_display(image, transform);
  if (shown.non_finite > 0) fmt::print(stderr, "{}: {} pixels are not finite\n", file.path, shown.non_finite);
  render::write_png(file.path, shown.image);
}

int run(const Options& options) {
  const auto begin = std::chrono::steady_clock::now();
  const render::LoadedScene scene = options.scene.load();
  auto model = std::make_shared<Model>(*scene.model);
  if (!options.quiet)
    for (const std::string& line : scene.defaults_taken) fmt::print(stderr, "default: {}\n", line);
  if (!options.size.empty()) {
    int width = 0, height = 0;
    parse_pair(options.size, width, height);
    model->film.width = width;
    model->film.height = height;
    model->camera = scene.model->make_camera(width, height);
  }
  if (options.samples > 0) model->film.samples = options.samples;
  if (!options.representation.empty())
    for (render::Object& object : model->objects)
      object.representation =
          options.representation == "mesh" ? render::Representation::mesh : render::Representation::direct;
  if (!options.crop.empty()) {
    const std::vector<double> c = parse_numbers(options.crop, 4, "--crop");
    model->film.crop = {static_cast<int>(c[0]), static_cast<int>(c[1]), static_cast<int>(c[2]), static_cast<int>(c[3])};
    const auto& f = model->film;
    if (!(f.crop.x0 >= 0 && f.crop.y0 >= 0 && f.crop.x0 < f.crop.x1 && f.crop.y0 < f.crop.y1 && f.crop.x1 <= f.width &&
          f.crop.y1 <= f.height))
      throw UsageError(
          fmt::format("--crop {} does not lie inside the picture of {} x {} pixels", options.crop, f.width, f.height));
  }
  const std::vector<OutputFile> outputs = chosen_outputs(options, *model);
  if (options.half) model->film.half_color = true;
  if (!options.layers.empty()) model->film.layers = options.layers;
  // Only OpenEXR files have room for more than colour.
  if (std::none_of(outputs.begin(), outputs.end(), [](const OutputFile& f) { return f.path.ends_with(".exr"); }))
    model->film.layers = {"color"};

  const render::World world(model);
  const double built = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  struct sigaction action = {};
  action.sa_handler = request_stop;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);

  Progress progress(options.quiet);
  render::RenderOptions settings;
  settings.threads = options.threads;
  settings.stop = &stop_requested;
  settings.progress = [&](double done, uint64_t rays) { progress(done, rays); };
  settings.identity = scene.hash;
  settings.partial_file = outputs.front().path + ".partial";
  settings.resume_file = options.resume;
  render::RenderResult result = render::render(world, settings);
  progress.end();

  result.image.metadata["lekalo.version"] = std::string(LEKALO_VERSION);
  result.image.metadata["lekalo.scene"] = std::filesystem::path(options.scene.file).filename().string();
  result.image.metadata["lekalo.samples"] = model->film.samples;
  if (!model->title.empty()) result.image.metadata["lekalo.title"] = model->title;
  for (const auto& [name, value] : model->parameters) result.image.metadata["lekalo.parameter." + name] = value;
  if (!result.complete) result.image.metadata["lekalo.incomplete"] = 1;
  for (const OutputFile& file : outputs) {
    write(file, result.image);
    if (!options.quiet) fmt::print(stderr, "{}\n", file.path);
  }
  if (result.not_finite > 0)
    fmt::print(stderr, "warning: {} samples were not finite and were left out\n", result.not_finite);
  if (options.stats) {
    const render::WorldStatistics s = world.statistics();
    const uint64_t rays = result.camera_rays + result.shadow_rays + result.other_rays;
    fmt::print(stderr,
               "read and build   {:.3f} s ({} pieces, {} triangles, {} instances, {:.2f} MiB)\n"
               "trace            {:.3f} s\n"
               "rays             {} camera, {} shadow, {} other: {:.3f} Mrays/s\n",
               built, s.pieces, s.triangles, s.instances, static_cast<double>(s.bytes) / 1048576, result.seconds,
               result.camera_rays, result.shadow_rays, result.other_rays,
               static_cast<double>(rays) / std::max(result.seconds, 1e-9) / 1e6);
  }
  if (!result.complete) {
    fmt::print(stderr, "interrupted: what was done is in {}; go on with --resume {}\n", outputs.front().path,
               settings.partial_file);
    return kInterrupted;
  }
  return kDone;
}

}  // namespace

void add_render(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("render", "Render a scene's pictures (OpenEXR, PNG)");
  sub->footer(
      "Examples:\n"
      "  lekalo render scenes/primer/teapot.yaml\n"
      "  lekalo render ring.yaml --set tube=0.3 --size 1920x1080 --samples 256 -o ring.exr -o ring.png\n"
      "Without -o the scene's own outputs are written, or SCENE.png.");
  auto options = std::make_shared<Options>();
  options->scene.add_to(*sub);
  sub->add_option("-o,--output", options->outputs, "file to write (exr, png); repeatable")->type_name("FILE");
  sub->add_option("--size", options->size, "picture size in pixels")->type_name("WxH");
  sub->add_option("--samples", options->samples, "samples per pixel")->check(CLI::Range(1, 1 << 20));
  sub->add_option("--threads", options->threads, "threads; all cores by default")->check(CLI::Range(1, 1024));
  sub->add_option("--crop", options->crop, "only this part, in pixels")->type_name("X0,Y0,X1,Y1");
  sub->add_option("--representation", options->representation, "of every object: direct or mesh")
      ->check(CLI::IsMember({"direct", "mesh"}));
  sub->add_flag("--half", options->half, "R G B A of OpenEXR files as half (11 bits) in place of float");
  sub->add_option("--layers", options->layers, "layers of OpenEXR files, separated by commas; all by default")
      ->delimiter(',')
      ->check(CLI::IsMember(render::film_layers()))
      ->type_name("NAMES");
  sub->add_option("--resume", options->resume, "continue from a .partial file")->type_name("FILE");
  sub->add_flag("--quiet", options->quiet, "no progress, no notes");
  sub->add_flag("--stats", options->stats, "print times, counts and memory");
  sub->callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace lekalo::command
