// lekalo draw: a scene as a drawing of lines, hidden ones told apart.
#include "draw.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "command.h"
#include "progress.h"
#include "render/drawing/svg.h"
#include "render/image/atomic_file.h"

namespace lekalo::command {

namespace {

struct Options {
  SceneOptions scene;
  std::vector<std::string> outputs;
  DrawSettings settings;
};

// What the drawing leaves out, in words.
std::string left_out(const render::Model& model) {
  std::string text;
  const auto add = [&](const char* what) { text += (text.empty() ? "" : ", ") + std::string(what); };
  if (!model.drawing.annotations.empty()) add("annotations");
  if (model.drawing.axes) add("axes");
  if (model.drawing.legend) add("legend");
  if (model.drawing.ground != render::Ground::none) add("ground");
  if (!model.panels.empty()) add("panels");
  return text;
}

int draw(const Options& options) {
  const render::LoadedScene scene = options.scene.load();
  const bool quiet = options.settings.quiet;
  if (!quiet)
    for (const std::string& line : scene.defaults_taken) fmt::print(stderr, "default: {}\n", line);
  std::vector<std::string> outputs = options.outputs;
  if (outputs.empty())
    for (const render::OutputFile& file : scene.model->outputs)
      if (file.kind == "drawing") outputs.push_back(file.path);
  if (outputs.empty()) outputs = {std::filesystem::path(options.scene.file).stem().string() + ".svg"};
  int code = kDone;
  std::vector<std::string> made;
  for (const std::string& path : outputs) {
    if (is_drawn(path)) {
      made.push_back(path);
    } else if (!options.outputs.empty()) {
      throw UsageError(fmt::format("'{}': draw writes svg", path));
    } else {
      fmt::print(stderr, "{}: not made: this version draws svg\n", path);
      code = kFileError;
    }
  }
  if (made.empty()) return code;
  if (const std::string missing = left_out(*scene.model); !quiet && !missing.empty())
    fmt::print(stderr, "note: not in the drawing yet: {}\n", missing);
  draw_files(scene.model, made, options.settings);
  return code;
}

}  // namespace

bool is_drawn(const std::string& path) { return std::filesystem::path(path).extension() == ".svg"; }

void draw_files(const std::shared_ptr<const render::Model>& model, const std::vector<std::string>& outputs,
                const DrawSettings& settings) {
  const auto begin = std::chrono::steady_clock::now();
  const render::World world(model);
  Progress progress(settings.quiet);
  const render::VisibleLines drawing = visible_lines(world, [&](double done) { progress(done, 0); });
  progress.end();
  std::vector<std::string> names;
  for (const render::Object* object : world.objects()) names.push_back(object->name);
  const std::string text = svg_of(drawing, *model, names);
  for (const std::string& path : outputs) {
    render::write_file_atomically(path, text);
    if (!settings.quiet) fmt::print(stderr, "{}\n", path);
  }
  if (drawing.incomplete > 0)
    fmt::print(stderr, "warning: of {} surface{} not all lines are known: they nearly touch or coincide\n",
               drawing.incomplete, drawing.incomplete == 1 ? "" : "s");
  if (settings.stats) {
    const render::LineStatistics& s = drawing.statistics;
    fmt::print(stderr, "{} lines in {} pieces; {} crossings in the picture, {} rays\n", s.lines, s.pieces, s.crossings,
               s.rays);
    fmt::print(stderr, "lines {:.3f} s, crossings {:.3f} s, rays {:.3f} s, in all {:.3f} s\n", s.seconds_of_lines,
               s.seconds_of_crossings, s.seconds_of_rays,
               std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
}

void add_draw(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("draw", "Draw a scene as lines in an SVG file, visible and hidden ones told apart");
  sub->footer(
      "Examples:\n"
      "  lekalo draw ring.yaml -o ring.svg\n"
      "  lekalo draw plate.yaml --stats\n\n"
      "Which lines are drawn and what becomes of hidden ones the objects' `lines` say, else the drawing's. Without -o "
      "the\n"
      "scene's drawings are made, or SCENE.svg.");
  auto options = std::make_shared<Options>();
  options->scene.add_to(*sub);
  sub->add_option("-o,--output", options->outputs, "file to write (svg) in place of the scene's outputs; repeatable")
      ->type_name("FILE");
  sub->add_flag("--quiet", options->settings.quiet, "no progress and no notes");
  sub->add_flag("--stats", options->settings.stats, "print how many lines and pieces there are, and times");
  sub->callback([&action, options] { action = [options] { return draw(*options); }; });
}

}  // namespace lekalo::command
