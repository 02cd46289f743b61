// What the commands share: options, exit codes, messages.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/scene/build/load.h"
#include "render/scene/yaml/table.h"

// Its header takes as long to parse as all of a command: only what declares options includes it.
namespace CLI {
class App;
}

namespace lekalo::command {

// Exit codes, the same for every command.
enum Exit { kDone = 0, kDiffers = 1, kUsage = 2, kSceneError = 3, kFileError = 4, kInterrupted = 5 };

// Options of every command that reads a scene.
struct SceneOptions {
  std::string file;
  std::vector<std::string> set;  // name=value
  bool allow_external = false;

  void add_to(CLI::App& app);
  render::LoadOptions load_options() const;
  // Tells doubts about what external functions say.
  render::LoadedScene load() const;
};

// The option --allow-external.
void add_allow_external(CLI::App& app, bool& allow_external);

// Writes doubts about external functions, and with `all` how each is met, to stderr.
void print_external_notes(const render::LoadedScene& scene, bool all);

// A word as it is typed in a POSIX shell: in quotes if it needs them.
std::string shell_word(const std::string& text);

// What the scene's geometry calls `name`; throws UsageError with the nearest name if there is none.
const render::Entity& find_geometry(const render::LoadedScene& scene, const std::string& name);
// A solid that is put together, as its boundary where that can be made (geometry/bodies/booleans/solid_boundary.h); the
// thing itself otherwise, and why.
render::Entity by_boundary(const render::Entity& entity, std::string* why_not = nullptr);

// A table of numbers named on the command line. Throws SceneError with the places of its errors.
render::Table load_table(const std::string& path);

// A subcommand's work; returns the exit code. Every command is one file with one add_ function.
using Action = std::function<int()>;

void add_render(CLI::App& app, Action& action);
void add_make(CLI::App& app, Action& action);
void add_test(CLI::App& app, Action& action);
void add_merge(CLI::App& app, Action& action);
void add_farm(CLI::App& app, Action& action);
void add_new(CLI::App& app, Action& action);
void add_check(CLI::App& app, Action& action);
void add_solve(CLI::App& app, Action& action);
void add_evaluate(CLI::App& app, Action& action);
void add_compare(CLI::App& app, Action& action);
void add_measure(CLI::App& app, Action& action);
void add_trace(CLI::App& app, Action& action);
void add_draw(CLI::App& app, Action& action);
void add_export(CLI::App& app, Action& action);
void add_types(CLI::App& app, Action& action);
void add_schema(CLI::App& app, Action& action);

// A number as commands print it: 17 significant digits, enough to give the same double back.
std::string digits(double x);
std::string digits(const geometry::Vec3& v);

// For CLI::Option::check: why the number is refused (NaN, infinity), empty if it is not. CLI11's own limits let NaN
// pass.
std::string not_finite(const std::string& number);

// The numbers of "1,2.5,-3": comma separated formulas without names, all finite.
std::vector<double> parse_numbers(const std::string& text, size_t count, const std::string& option);

// Wrong usage found after parsing the command line; exits with kUsage.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lekalo::command
