// Accepting a picture as golden: the only way in which lekalo changes one.
#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <cstdlib>

#include "command.h"
#include "geometry/expression/nearest_name.h"
#include "picture.h"
#include "render/image/atomic_file.h"
#include "render/image/exr.h"
#include "render/image/image_error.h"
#include "render/image/layers.h"
#include "render/scene/yaml/include.h"
#include "suite.h"

namespace lekalo::command {

namespace fs = std::filesystem;

namespace {

constexpr size_t kLongestNote = 1 << 20;

std::string who() {
  for (const char* variable : {"GIT_AUTHOR_NAME", "USER"})
    if (const char* name = std::getenv(variable); name && *name) return name;
  const passwd* user = getpwuid(getuid());
  return user ? user->pw_name : fmt::format("user {}", getuid());
}

}  // namespace

void accept(const render::Suite& suite, const std::string& name, const std::string& reason) {
  const render::SuiteTest* test = suite.find(name);
  if (!test) {
    std::vector<std::string> known;
    for (const render::SuiteTest& one : suite.tests) known.push_back(one.name);
    const auto nearest = geometry::nearest_name(name, known);
    throw UsageError(fmt::format("--accept: the suite has no test '{}'{}", name,
                                 nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : ""));
  }
  if (!test->against.empty())
    throw UsageError(
        fmt::format("--accept: '{}' is compared with '{}' and has no golden picture", name, test->against));
  const fs::path result = result_file(suite, name), golden = golden_file(suite, name), note = golden_note(suite, name);
  if (!fs::exists(result))
    throw UsageError(
        fmt::format("--accept: there is no {}; run the suite first and look at the picture", result.string()));
  const render::Image picture = render::keep_layer(render::read_exr(result), test->layer, result);
  std::error_code error;
  fs::create_directories(suite.golden, error);
  if (error) throw render::ImageError(suite.golden, "cannot make this folder: " + error.message(), "check the rights");
  std::string log, why;
  if (fs::exists(note)) {
    const auto text = render::read_file(note, kLongestNote, true, why);
    if (!text) throw render::ImageError(note, why, "it holds the reasons of earlier changes");
    log = *text;
    if (!log.empty() && !log.ends_with('\n')) log += '\n';
  }
  log += fmt::format("{} {}: {}\n", date_text(false), who(), reason);
  render::write_exr(golden, picture);
  render::write_file_atomically(note, log);
}

}  // namespace lekalo::command
