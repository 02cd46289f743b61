// lekalo render and make: a scene's pictures, once, as a sequence, or again whenever the scene changes.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "command.h"
#include "draw.h"
#include "engine.h"
#include "frames.h"
#include "job_list.h"
#include "picture.h"
#include "progress.h"
#include "render/film/denoise.h"
#include "render/image/image_error.h"
#include "render/integrators/path.h"
#include "render/materials/textured_color.h"
#include "render/trace/world.h"
#include "render_command.h"
#include "watch.h"

namespace lekalo::command {

namespace {

using render::Model;
using render::OutputFile;

std::atomic<bool> interrupted{false};   // by Ctrl-C
std::atomic<bool> stop_tracing{false};  // by Ctrl-C, or because a watched file has changed

std::atomic<bool> building{false};  // there is no picture yet that could be saved

void interrupt(int signal) {
  interrupted = stop_tracing = true;
  if (!building) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

struct Building {
  Building() { building = true; }
  ~Building() { building = false; }
};

using Options = RenderCommand;

void print_statistics(const render::WorldStatistics& world, const render::RenderResult& result, double built) {
  const uint64_t rays = result.camera_rays + result.shadow_rays + result.other_rays;
  fmt::print(stderr,
             "read and build   {:.3f} s ({} pieces, {} triangles, {} instances, {:.2f} MiB, objects {:.2f} MiB, "
             "hierarchy {:.2f} MiB)\n",
             built, world.pieces, world.triangles, world.instances, static_cast<double>(world.bytes) / 1048576,
             static_cast<double>(world.object_bytes) / 1048576, static_cast<double>(world.hierarchy_bytes) / 1048576);
  for (const auto& method : world.methods)
    fmt::print(stderr, "lines met by     {}: {} {}, {} pieces, {:.2f} MiB\n", method.name, method.count,
               method.count == 1 ? "surface or shape" : "surfaces and shapes", method.pieces,
               static_cast<double>(method.bytes) / 1048576);
  fmt::print(stderr,
             "trace            {:.3f} s\n"
             "rays             {} camera, {} shadow, {} other: {:.3f} Mrays/s\n",
             result.seconds, result.camera_rays, result.shadow_rays, result.other_rays,
             static_cast<double>(rays) / std::max(result.seconds, 1e-9) / 1e6);
}

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
    if (file.kind == "render" || options.make_drawings) outputs.push_back(file);
  if (outputs.empty()) {
    OutputFile file;
    file.path = std::filesystem::path(options.scene.file).stem().string() + ".png";
    file.kind = "render";
    outputs.push_back(file);
  }
  return outputs;
}

// What one run of the command keeps while it goes through frames and changes of the scene.
struct Run {
  const Options& options;
  std::vector<Frame> instants;  // while the shutter is open: one, or several of a parameter
  std::optional<FileWatch> watch;
  bool restart = false;  // a file changed while its picture was made
};

PictureOverrides overrides_of(const Options& options) {
  PictureOverrides overrides;
  if (!options.size.empty()) overrides.size = parse_size(options.size);
  if (options.samples > 0) overrides.samples = options.samples;
  if (!options.representation.empty())
    overrides.representation =
        options.representation == "mesh" ? render::Representation::mesh : render::Representation::direct;
  return overrides;
}

render::LoadedScene load(Run& run, const Frame& frame, const Frame& instant) {
  std::vector<std::filesystem::path> files;
  render::LoadOptions load = run.options.scene.load_options();
  for (const auto& setting : {frame.setting, instant.setting})
    if (setting) load.set_parameters.push_back(*setting);
  load.files_read = &files;
  const auto watch = [&] {
    if (run.watch) run.watch->include(files);
  };
  try {
    render::LoadedScene scene = render::load_scene(run.options.scene.file, load);
    watch();
    return scene;
  } catch (const render::SceneError&) {
    watch();
    throw;
  }
}

// Stops the picture in work when a file changes.
void stop_at_change(Run& run, const std::stop_token& ended) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any wake;
  while (!ended.stop_requested()) {
    if (run.watch->changed()) {
      run.restart = stop_tracing = true;
      return;
    }
    wake.wait_for(lock, ended, std::chrono::milliseconds(100), [] { return false; });
  }
}

render::RenderResult render_watched(Run& run, const render::World& world, const render::RenderOptions& settings) {
  std::jthread watching;
  if (run.watch) watching = std::jthread([&](const std::stop_token& ended) { stop_at_change(run, ended); });
  return render::render(world, settings);
}

bool is_variance(const render::Channel& channel) { return channel.name.starts_with("variance."); }

// Adds the light of a picture to `sum`, with its variance and the number of its samples; what else its layers hold
// takes the place of that there where `takes_data`.
void add_picture(render::Image& sum, const render::Image& picture, bool takes_data) {
  for (size_t c = 0; c < sum.channels.size(); ++c) {
    render::Channel& to = sum.channels[c];
    const render::Channel& from = picture.channels[c];
    if (render::is_light_channel(to.name) || is_variance(to) || to.name == "samples") {
      for (size_t i = 0; i < to.values.size(); ++i) to.values[i] += from.values[i];
      for (size_t i = 0; i < to.ids.size(); ++i) to.ids[i] += from.ids[i];
    } else if (takes_data) {
      to = from;
    }
  }
}

// Makes of the picture of the first instant the mean of those of all: what moves is blurred, by as many places as there
// are instants. Layers of what is seen are those of the instant in the middle.
void blur(Run& run, const Frame& frame, const Model& first, const render::RenderOptions& settings,
          render::RenderResult& result) {
  const size_t count = run.instants.size();
  for (size_t k = 1; k < count && result.complete && !run.restart; ++k) {
    const render::LoadedScene scene = load(run, frame, run.instants[k]);
    apply(overrides_of(run.options), *scene.model);
    scene.model->make_camera = nullptr;
    scene.model->film = first.film;
    scene.model->film.seed += static_cast<uint32_t>(k);
    const render::World world(scene.model, render::keeps_layer(scene.model->film, "uv"));
    const render::RenderResult next = render_watched(run, world, settings);
    result.complete = result.complete && next.complete;
    result.not_finite += next.not_finite;
    result.seconds += next.seconds;
    result.camera_rays += next.camera_rays;
    result.shadow_rays += next.shadow_rays;
    result.other_rays += next.other_rays;
    add_picture(result.image, next.image, k == count / 2);
  }
  if (!result.complete) return;
  const auto n = static_cast<float>(count);
  for (render::Channel& channel : result.image.channels)
    if (const bool varies = is_variance(channel); varies || render::is_light_channel(channel.name))
      for (float& value : channel.values) value /= varies ? n * n : n;
  if (render::find_channel(result.image, "denoised.R")) render::denoise(result.image);
}

// No ray of the camera met anything, and there is no background but what is transparent.
bool is_empty(const render::Image& image) {
  const render::Channel* alpha = render::find_channel(image, "A");
  return alpha && std::all_of(alpha->values.begin(), alpha->values.end(), [](float a) { return a == 0; });
}

// How a command that makes frames is changed for one of them, which goes on as one picture.
std::string of_one_frame(const render::ParameterSetting& setting, const std::vector<OutputFile>& outputs) {
  std::string change = ", --set " + shell_word(setting.name + "=" + setting.value);
  for (const OutputFile& file : outputs) change += " -o " + shell_word(file.path);
  return change + " in place of --frames and -o,";
}

// Of the scene and of all that the command changes of the picture.
uint64_t identity_of(const Options& options, const render::LoadedScene& scene) {
  const render::Film& film = scene.model->film;
  uint64_t hash = scene.hash;
  for (const int value :
       {film.width, film.height, film.samples, film.crop.x0, film.crop.y0, film.crop.x1, film.crop.y1})
    hash = render::hash_combine(hash, static_cast<uint64_t>(value));
  for (const std::string& layer : render::film_layers())
    hash = render::hash_combine(hash, render::keeps_layer(film, layer) ? 1 : 0);
  for (const char letter : options.representation)
    hash = render::hash_combine(hash, static_cast<unsigned char>(letter));
  return hash;
}

// What was kept of that very picture by this version of the program, if the work on it was begun.
std::optional<render::PartialHeader> begun(const std::string& partial, uint64_t identity) {
  try {
    const render::PartialHeader header = render::read_partial_header(partial);
    return header.identity == identity ? std::optional(header) : std::nullopt;
  } catch (const render::ImageError&) {
    return std::nullopt;
  }
}

// For --skip-existing. A picture that has a partial file beside it is not done.
bool is_made(const std::vector<OutputFile>& outputs, const std::vector<OutputFile>& drawings,
             const std::string& partial, const std::optional<render::PicturePart>& part,
             const std::optional<render::PartialHeader>& kept) {
  std::error_code ignored;
  if (part) return kept && kept->done == kept->tiles_of_part();
  const auto exists = [&](const OutputFile& file) { return std::filesystem::exists(file.path, ignored); };
  return !std::filesystem::exists(partial, ignored) && std::all_of(outputs.begin(), outputs.end(), exists) &&
         std::all_of(drawings.begin(), drawings.end(), exists);
}

int render_frame(Run& run, const Frame& frame, bool first) {
  const Options& options = run.options;
  const auto begin = std::chrono::steady_clock::now();
  std::optional<Building> until_traced(std::in_place);
  const render::LoadedScene scene = load(run, frame, run.instants.front());
  const std::shared_ptr<Model> model = scene.model;
  apply(overrides_of(options), *model);
  if (first && (!options.quiet || options.stats)) print_external_notes(scene, options.stats);
  if (!options.crop.empty()) set_crop(options.crop, *model);
  std::vector<OutputFile> outputs = chosen_outputs(options, *model);
  for (OutputFile& file : outputs) file.path = numbered(file.path, frame);
  const auto drawings = std::stable_partition(outputs.begin(), outputs.end(),
                                              [](const OutputFile& file) { return file.kind == "render"; });
  const std::optional<render::PicturePart> part = parse_part(options.tile);
  if (part && drawings == outputs.begin())
    throw UsageError("--tile makes a part of a picture, and all outputs of this scene are drawings: leave it out");
  std::vector<std::string> written;
  for (const OutputFile& file : outputs) written.push_back(file.path);
  const std::vector<OutputFile> drawn(drawings, outputs.end());
  outputs.erase(drawings, outputs.end());
  const std::string partial = outputs.empty() ? "" : partial_of(outputs.front().path, part);
  if (!partial.empty()) written.push_back(partial);
  check_inputs_stay(scene, written);
  if (!partial.empty()) check_is_ours(partial, render::kPartialMagic, "partial picture");
  if (options.half) model->film.half_color = true;
  if (!options.layers.empty()) model->film.layers = options.layers;
  // Only OpenEXR files have room for more than colour.
  if (std::none_of(outputs.begin(), outputs.end(), [](const OutputFile& f) { return f.path.ends_with(".exr"); }))
    model->film.layers = {"color"};
  const uint64_t identity = identity_of(options, scene);
  std::vector<std::string> resume = options.resume;
  if (resume == std::vector<std::string>{""})  // no FILE is given: what was kept, if there is any
    resume = std::filesystem::exists(partial) ? std::vector{partial} : std::vector<std::string>{};
  if (options.skip_existing) {
    const auto kept = partial.empty() ? std::nullopt : begun(partial, identity);
    if (is_made(outputs, drawn, partial, part, kept)) {
      if (!options.quiet) fmt::print(stderr, "{}: is there already\n", part ? partial : written.front());
      return kDone;
    }
    if (kept) resume = {partial};
  }
  if (!options.quiet && first) {
    print_defaults(scene, !outputs.empty(), !drawn.empty());
    if (const std::string missing = left_to_drawings(*model); !outputs.empty() && !missing.empty())
      fmt::print(stderr, "note: not in the picture, but in drawings: {}\n", missing);
    if (const std::string clear = without_shadow(*model); !outputs.empty() && !clear.empty())
      fmt::print(stderr,
                 "note: light goes straight through clear bodies, which throw no shadow ({}); integrator: {{ shadows: "
                 "opaque }} draws one, `absorption` of the material a tinted one\n",
                 clear);
    const std::any made = model->integrator ? model->integrator->made_from() : std::any();
    const auto* path = std::any_cast<render::PathOptions>(&made);
    if (const std::string endless = path ? render::without_photons(*model) : ""; !endless.empty() && path->photons > 0)
      fmt::print(stderr, "note: no photons are sent, as '{}' mirrors or refracts and has no bounds: give it a size\n",
                 endless);
    if (path && path->photons == 0 && !outputs.empty() && render::misses_light(*model))
      fmt::print(
          stderr,
          "note: light of points and parallel light that mirrors and clear bodies throw is left out; `photons` of "
          "the integrator path bring it, and lights that have a size (sphere_light, angular_diameter of "
          "distant_light) throw it\n");
  }
  if (!drawn.empty() && !part)
    draw_files(model, drawn, {.quiet = options.quiet, .stats = options.stats, .threads = options.engine.threads});
  if (outputs.empty()) return kDone;
  model->make_camera = nullptr;  // with what it knows of very many objects: no other picture is made of this model
  check_writable(outputs);
  const auto instants = static_cast<int>(run.instants.size());
  for (const char* mattes : {"cryptomatte_object", "cryptomatte_material"})
    if (instants > 1 && render::keeps_layer(model->film, mattes))
      throw UsageError(
          fmt::format("--shutter does not go with the layer '{}': the mattes of instants do not add up; leave it out "
                      "with --layers",
                      mattes));
  model->film.samples = (model->film.samples + instants - 1) / instants;

  const render::World world(model, render::keeps_layer(model->film, "uv"));
  const double built = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  Progress progress(options.quiet, options.progress, frame.suffix.empty() ? "" : outputs.front().path);
  until_traced.reset();
  stop_tracing = interrupted.load();
  render::RenderOptions settings;
  settings.threads = options.engine.threads;
  settings.stop = &stop_tracing;
  settings.progress = [&](double done, uint64_t rays) { progress(done, rays); };
  settings.identity = identity;
  if (instants == 1) settings.partial_file = partial;
  settings.warning = [](const std::string& reason) {
    fmt::print(stderr, "warning: what is done cannot be kept for --resume: {}\n", reason);
  };
  settings.resume_files = resume;
  settings.part = part;
  settings.job =
      job_of(options, frame, {written.begin(), written.begin() + static_cast<std::ptrdiff_t>(outputs.size())},
             model->film.layers);
  render::RenderResult result = render_watched(run, world, settings);
  if (instants > 1) blur(run, frame, *model, settings, result);
  progress.end();
  if (run.restart && !result.complete && !interrupted) {
    std::error_code ignored;
    std::filesystem::remove(settings.partial_file, ignored);
    return kDone;
  }
  add_metadata(result, *model, options.scene.file, options.stamp);
  for (const OutputFile& file : outputs) {
    if (part || (options.skip_existing && !result.complete)) break;  // what is there passes for the whole picture
    // A picture that is there may be a good one.
    if (!result.complete && std::filesystem::exists(file.path)) {
      fmt::print(stderr, "interrupted: {} stays as it was\n", file.path);
      continue;
    }
    write_picture(file, result, *model);
    if (!options.quiet) fmt::print(stderr, "{}\n", file.path);
  }
  if (!options.quiet)
    for (const std::string& note : result.notes) fmt::print(stderr, "note: {}\n", note);
  if (is_empty(result.image) && result.complete && !options.quiet)
    fmt::print(stderr, "note: nothing is seen in the picture\n");
  if (result.not_finite > 0)
    fmt::print(stderr, "warning: {} samples were not finite and were left out\n", result.not_finite);
  if (options.stats) print_statistics(world.statistics(), result, built);
  if (!result.complete && instants > 1) return kInterrupted;           // nothing is kept of it
  if ((!result.complete || part) && !result.saved) return kFileError;  // the warning has said why
  if (part && result.part_complete) {
    if (!options.quiet) fmt::print(stderr, "{}\n", partial);
    return kDone;
  }
  if (!result.complete) {
    fmt::print(stderr, "interrupted: what was done is in {}; go on with the same command{} and --resume {}\n", partial,
               frame.setting ? of_one_frame(*frame.setting, outputs) : "", shell_word(partial));
    return kInterrupted;
  }
  // What an interrupted run has left, or this one has saved on the way.
  std::error_code ignored;
  std::filesystem::remove(settings.partial_file, ignored);
  return kDone;
}

int render_frames(Run& run, const std::vector<Frame>& frames) {
  int worst = kDone;
  for (const Frame& frame : frames) {
    if (interrupted) return kInterrupted;
    const int code = render_frame(run, frame, &frame == &frames.front());
    if (code == kInterrupted || run.restart) return code;
    worst = std::max(worst, code);
  }
  return worst;
}

// Again whenever a file changes, until Ctrl-C.
int render_and_watch(Run& run, const std::vector<Frame>& frames) {
  run.watch.emplace();
  run.watch->include({run.options.scene.file});
  for (;;) {
    run.watch->refresh();
    run.restart = false;
    try {
      if (render_frames(run, frames) == kInterrupted) return kInterrupted;
    } catch (const render::SceneError& error) {
      std::fputs(error.what(), stderr);
    } catch (const render::ImageError& error) {
      fmt::print(stderr, "lekalo: {}\n", error.what());
    }
    if (run.restart) continue;
    if (!run.options.quiet)
      fmt::print(stderr, "watching {} file{}; Ctrl-C ends\n", run.watch->count(), run.watch->count() == 1 ? "" : "s");
    if (!run.watch->wait(interrupted)) return kDone;
  }
}

void add_options(CLI::App& sub, const std::shared_ptr<Options>& options) {
  options->scene.add_to(sub);
  sub.add_option("-o,--output", options->outputs, "file to write (exr, png); repeatable")->type_name("FILE");
  sub.add_option("--size", options->size, "picture size in pixels")->type_name("WxH");
  sub.add_option("--samples", options->samples, "samples per pixel")->check(CLI::Range(1, 1 << 20));
  options->engine.add_to(sub);
  sub.add_option("--crop", options->crop, "only this part, in pixels")->type_name("X0,Y0,X1,Y1");
  sub.add_option("--representation", options->representation, "of every object: direct or mesh")
      ->check(CLI::IsMember({"direct", "mesh"}));
  sub.add_option("--layers", options->layers,
                 "layers of OpenEXR files, separated by commas; all from color to samples by default")
      ->delimiter(',')
      ->check(CLI::IsMember(render::film_layers()))
      ->type_name("NAMES");
  sub.add_flag("--half", options->half, "R G B A of OpenEXR files as half (11 bits) in place of float");
  sub.add_option("--frames", options->frames, "N numbered pictures while a parameter runs from A to B")
      ->type_name("NAME=A..B:N");
  sub.add_option("--only", options->only, "of --frames only these, by number")->type_name("9-16,20");
  sub.add_flag("--skip-existing", options->skip_existing,
               "leave out pictures that are there already, and go on with those that were begun");
  sub.add_option("--tile", options->tile, "part I of N of the picture, kept for 'lekalo merge'")->type_name("I/N");
  sub.add_flag("--progress", options->progress, "progress as lines for other programs");
  sub.add_option(
         "--shutter", options->shutter,
         "motion blur: the mean of N pictures while a parameter runs from A to B, the samples shared among them")
      ->type_name("NAME=A..B:N");
  sub.add_flag("--watch", options->watch, "again when the scene or a file that it reads changes, until Ctrl-C");
  sub.add_option("--resume", options->resume,
                 "go on from a .partial file; without FILE from that of the picture, if there is one")
      ->type_name("FILE")
      ->expected(0, 1);
  sub.add_flag("--stamp", options->stamp, "put date, machine and the scene's path into the pictures");
  sub.add_flag("--quiet", options->quiet, "no progress, no notes");
  sub.add_flag("--stats", options->stats, "print times, counts and memory");
}

}  // namespace

int make_pictures(const RenderCommand& command) {
  const std::vector<Frame> frames = chosen_frames(parse_frames(command.frames, "--frames"), command.only);
  if (!command.resume.empty() && (!command.frames.empty() || command.watch))
    throw UsageError("--resume continues one picture: it does not go with --frames or --watch");
  if (!command.shutter.empty() && (!command.resume.empty() || !command.tile.empty()))
    throw UsageError("--shutter does not go with --resume or --tile: nothing is kept of pictures that are not done");
  if (command.watch && (!command.tile.empty() || command.skip_existing))
    throw UsageError("--watch makes pictures again and again: it does not go with --tile or --skip-existing");
  command.engine.apply();
  struct sigaction action = {};
  action.sa_handler = interrupt;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  Run run{command, parse_frames(command.shutter, "--shutter"), {}};
  return command.watch ? render_and_watch(run, frames) : render_frames(run, frames);
}

void add_render(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("render", "Render a scene's pictures (OpenEXR, PNG)");
  sub->footer(
      "Examples:\n"
      "  lekalo render scenes/primer/teapot.yaml\n"
      "  lekalo render ring.yaml --set r=0.3 --size 1920x1080 --samples 256 -o ring.exr -o ring.png\n"
      "  lekalo render ring.yaml --frames tube=0.1..0.5:24     (ring_0001.png to ring_0024.png)\n"
      "  lekalo render wheel.yaml --shutter turn=0..30:64      (blurred by its motion)\n"
      "  lekalo render ring.yaml --watch                       (again whenever the scene changes)\n"
      "Without -o the scene's own outputs are written, or SCENE.png.");
  auto options = std::make_shared<Options>();
  add_options(*sub, options);
  sub->callback([&action, options] { action = [options] { return make_pictures(*options); }; });
}

void add_make(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("make", "Write everything that a scene lists under outputs");
  sub->footer(
      "Examples:\n"
      "  lekalo make figure.yaml\n"
      "  lekalo make figure.yaml --watch\n"
      "  lekalo make --list paper.lekalo                       (the figures that a LaTeX document lacks)");
  auto options = std::make_shared<Options>();
  auto list = std::make_shared<std::string>();
  options->make_drawings = true;
  add_options(*sub, options);
  auto* scene = sub->get_option("scene")->required(false);
  sub->add_option("--list", *list, "a command on each line: those whose files are missing, side by side")
      ->type_name("FILE")
      ->excludes(scene);
  sub->callback([&action, options, list, scene] {
    if (list->empty() && scene->empty()) throw CLI::RequiredError("scene");
    action = [options, list] { return list->empty() ? make_pictures(*options) : make_listed(*list, options->quiet); };
  });
}

}  // namespace lekalo::command
