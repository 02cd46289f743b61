// lekalo merge: the parts of a picture, made with render --tile, put together; the same bits as made at once.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <map>

#include "render/image/image_error.h"
#include "render_command.h"

namespace lekalo::command {

namespace {

struct Options {
  std::vector<std::string> parts, outputs;
  std::string scene;
  bool quiet = false;
};

struct Part {
  std::string file;
  render::PartialHeader header;
};

Part read_part(const std::string& file) {
  try {
    return {file, render::read_partial_header(file)};
  } catch (const render::ImageError& error) {
    const std::string said = error.what();
    throw UsageError(fmt::format("{} (make the part with render --tile)", said.substr(0, said.rfind(" ("))));
  }
}

void check_is_of_same(const Part& part, const Part& first) {
  const render::PartialHeader &a = part.header, &b = first.header;
  if (a.identity != b.identity || a.settings != b.settings || a.tiles != b.tiles)
    throw UsageError(
        fmt::format("'{}' and '{}' are parts of different pictures: the scene, a parameter or the settings "
                    "were changed between them",
                    first.file, part.file));
  if (a.part.count != b.part.count)
    throw UsageError(
        fmt::format("'{}' is one of {} parts, '{}' one of {}", first.file, b.part.count, part.file, a.part.count));
}

// All parts must be there, each whole.
void check_parts(const std::vector<Part>& parts) {
  std::map<int, std::string> found;
  for (const Part& part : parts) {
    check_is_of_same(part, parts.front());
    const auto [before, is_new] = found.emplace(part.header.part.index, part.file);
    if (!is_new) throw UsageError(fmt::format("'{}' and '{}' are the same part", before->second, part.file));
  }
  const int count = parts.front().header.part.count;
  std::vector<std::string> missing;
  for (int i = 0; i < count; ++i)
    if (!found.contains(i)) missing.push_back(fmt::format("{}/{}", i + 1, count));
  if (!missing.empty())
    throw UsageError(fmt::format("the picture has gaps: missing are the parts {} (render them with --tile)",
                                 fmt::join(missing, ", ")));
  for (const Part& part : parts)
    if (part.header.done < part.header.tiles_of_part())
      throw UsageError(
          fmt::format("'{}' is not finished: {} of {} tiles (render --tile {}/{} again with --skip-existing)",
                      part.file, part.header.done, part.header.tiles_of_part(), part.header.part.index + 1, count));
}

int merge(const Options& options) {
  std::vector<Part> parts;
  for (const std::string& file : options.parts) parts.push_back(read_part(file));
  check_parts(parts);
  RenderCommand command = command_of(parts.front().header.job);
  if (!options.outputs.empty()) command.outputs = options.outputs;
  if (!options.scene.empty()) command.scene.file = options.scene;
  command.resume = options.parts;
  command.quiet = options.quiet;
  return make_pictures(command);
}

}  // namespace

void add_merge(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("merge", "Put together a picture whose parts were made with render --tile");
  sub->footer(
      "Examples:\n"
      "  lekalo merge ring.exr.*.partial -o ring.exr\n\n"
      "The parts know their scene and its options. All of them must be there, each finished, and of the same scene "
      "with\n"
      "the same settings; the picture has the same bits as one made at once. Without -o the files are written that "
      "the\n"
      "parts were made for.");
  auto options = std::make_shared<Options>();
  sub->add_option("parts", options->parts, "the parts")->required()->type_name("FILE...");
  sub->add_option("-o,--output", options->outputs, "file to write (exr, png); repeatable")
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  sub->add_option("--scene", options->scene, "the scene, where it lies elsewhere than when the parts were made")
      ->type_name("FILE");
  sub->add_flag("--quiet", options->quiet, "no progress, no notes");
  sub->callback([&action, options] { action = [options] { return merge(*options); }; });
}

}  // namespace lekalo::command
