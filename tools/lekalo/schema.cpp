// lekalo schema: the JSON Schema of scene files, for editors and validators.
#include "render/scene/schema.h"

#include <cstdio>

#include "command.h"

namespace lekalo::command {

void add_schema(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("schema", "Print the JSON Schema of scene files, for editors");
  sub->footer(
      "Example:\n  lekalo schema > lekalo.schema.json\n\n"
      "An editor with YAML support completes and checks a scene that begins with the line\n"
      "  # yaml-language-server: $schema=lekalo.schema.json");
  sub->callback([&action] {
    action = []() -> int {
      std::fputs(render::scene_schema().c_str(), stdout);
      return kDone;
    };
  });
}

}  // namespace lekalo::command
