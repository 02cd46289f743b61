// lekalo check: all errors of a scene, nothing made.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "command.h"

namespace lekalo::command {

void add_check(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("check", "Read a scene and report all its errors");
  sub->footer("Example:\n  lekalo check ring.yaml");
  auto options = std::make_shared<SceneOptions>();
  options->add_to(*sub);
  sub->callback([&action, options] {
    action = [options]() -> int {
      const render::LoadedScene scene = render::load_scene(options->file, options->load_options());
      print_external_notes(scene, true);
      fmt::print("{}: good: {} entities, {} objects, {} lights\n", options->file, scene.model->geometry.size(),
                 scene.model->objects.size(), scene.model->lights.size());
      return kDone;
    };
  });
}

}  // namespace lekalo::command
