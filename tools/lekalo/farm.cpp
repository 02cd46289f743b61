// lekalo farm: the commands that make a scene's frames, or the parts of one picture, on many machines.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "render_command.h"

namespace lekalo::command {

namespace {

struct Options {
  SceneOptions scene;
  std::string scheduler;
  std::vector<std::string> outputs;
  std::string size, frames;
  int samples = 0, tiles = 0, threads = 0;
  bool merge = false;
};

// "lekalo render SCENE ..." with all options but those that choose frames or parts.
std::string render_words(const Options& options) {
  std::string words = "lekalo render " + shell_word(options.scene.file);
  for (const std::string& one : options.scene.set) words += " --set " + shell_word(one);
  if (options.scene.allow_external) words += " --allow-external";
  for (const std::string& one : options.outputs) words += " -o " + shell_word(one);
  if (!options.size.empty()) words += " --size " + shell_word(options.size);
  if (options.samples > 0) words += fmt::format(" --samples {}", options.samples);
  if (options.threads > 0) words += fmt::format(" --threads {}", options.threads);
  if (!options.frames.empty()) words += " --frames " + shell_word(options.frames);
  return words + " --skip-existing --quiet --progress";
}

// The task with this number, which may be a variable of the shell.
std::string task_words(const Options& options, const std::string& number) {
  return render_words(options) +
         (options.tiles > 0 ? fmt::format(" --tile {}/{}", number, options.tiles) : fmt::format(" --only {}", number));
}

std::string merge_words(const Options& options) {
  std::string words = "lekalo merge";
  for (int i = 0; i < options.tiles; ++i)
    words += " " + shell_word(partial_of(options.outputs.front(), render::PicturePart{i, options.tiles}));
  return words + " --quiet";
}

// Each task may be started again at any time: it goes on where it was.
std::string slurm_script(const Options& options, size_t tasks) {
  const std::string cpus = options.threads > 0 ? fmt::format(" --cpus-per-task={}", options.threads) : "";
  std::string text = fmt::format(
      "#!/bin/sh\n"
      "# Run it where the scene lies: sh FILE. Slurm's own SBATCH_... variables choose partition, account and times.\n"
      "set -e\n"
      "job=$(sbatch --parsable --requeue --open-mode=append --job-name=lekalo --signal=TERM@60{} --array=1-{} <<'END'\n"
      "#!/bin/sh\n"
      "exec {}\n"
      "END\n"
      ")\n"
      "echo \"$job\"\n",
      cpus, tasks, task_words(options, "\"$SLURM_ARRAY_TASK_ID\""));
  if (options.tiles > 0)
    text += fmt::format(
        "sbatch --parsable --job-name=lekalo-merge --dependency=afterok:\"${{job%%;*}}\" <<'END'\n"
        "#!/bin/sh\n"
        "exec {}\n"
        "END\n",
        merge_words(options));
  return text;
}

int farm(const Options& options) {
  if (options.frames.empty() == (options.tiles == 0))
    throw UsageError("farm takes either --frames, a task for each picture, or --tiles, a task for each part of one");
  if (options.tiles > 0 && options.outputs.empty())
    throw UsageError("--tiles needs -o FILE: parts are called after the picture");
  if (options.merge && (options.tiles == 0 || options.scheduler != "list"))
    throw UsageError("--merge is of 'farm list' with --tiles");
  const size_t tasks =
      options.tiles > 0 ? static_cast<size_t>(options.tiles) : parse_frames(options.frames, "--frames").size();
  if (options.scheduler == "slurm")
    fmt::print("{}", slurm_script(options, tasks));
  else if (options.merge)
    fmt::print("{}\n", merge_words(options));
  else
    for (size_t i = 1; i <= tasks; ++i) fmt::print("{}\n", task_words(options, std::to_string(i)));
  return kDone;
}

}  // namespace

void add_farm(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("farm", "Print the commands that make many frames, or one picture, on many machines");
  sub->footer(
      "Examples:\n"
      "  lekalo farm slurm ring.yaml --frames tube=0.1..0.5:24 -o ring.png | sh\n"
      "  lekalo farm slurm ring.yaml --tiles 8 -o ring.exr | sh\n"
      "  lekalo farm list ring.yaml --tiles 8 -o ring.exr | parallel && lekalo farm list ring.yaml --tiles 8 -o "
      "ring.exr --merge | sh\n\n"
      "slurm: a script that submits an array of tasks, with --tiles also a merge that waits for them. list: one "
      "command\n"
      "a line for any other scheduler. A task that is started again goes on where it was.");
  auto options = std::make_shared<Options>();
  sub->add_option("scheduler", options->scheduler, "slurm or list")
      ->required()
      ->type_name("NAME")
      ->check(CLI::IsMember({"slurm", "list"}));
  options->scene.add_to(*sub);
  sub->add_option("-o,--output", options->outputs, "file to write (exr, png); repeatable")->type_name("FILE");
  sub->add_option("--size", options->size, "picture size in pixels")->type_name("WxH");
  sub->add_option("--samples", options->samples, "samples per pixel")->check(CLI::Range(1, 1 << 20));
  sub->add_option("--threads", options->threads, "of each task; all cores by default")->check(CLI::Range(1, 4096));
  sub->add_option("--frames", options->frames, "N numbered pictures while a parameter runs from A to B")
      ->type_name("NAME=A..B:N");
  sub->add_option("--tiles", options->tiles, "N parts of one picture")->check(CLI::Range(1, 100000))->type_name("N");
  sub->add_flag("--merge", options->merge, "with list: the command that puts the parts together");
  sub->callback([&action, options] { action = [options] { return farm(*options); }; });
}

}  // namespace lekalo::command
