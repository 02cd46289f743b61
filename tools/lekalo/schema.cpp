// lekalo schema: the JSON Schema of scene files and suites, for editors and validators.
#include "render/scene/manual/schema.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "command.h"

namespace lekalo::command {

void add_schema(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("schema", "Print the JSON Schema of scene files or suites, for editors");
  sub->footer(
      "Examples:\n  lekalo schema > lekalo.schema.json\n  lekalo schema --suite > suite.schema.json\n\n"
      "An editor with YAML support completes and checks a scene that begins with the line\n"
      "  # yaml-language-server: $schema=lekalo.schema.json");
  auto suite = std::make_shared<bool>(false);
  sub->add_flag("--suite", *suite, "of regression suites");
  sub->callback([&action, suite] {
    action = [suite]() -> int {
      std::fputs((*suite ? render::suite_schema() : render::scene_schema()).c_str(), stdout);
      return kDone;
    };
  });
}

}  // namespace lekalo::command
