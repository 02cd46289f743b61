// The `lekalo` command: finds the subcommand, runs it, turns exceptions into messages and exit codes.
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <system_error>

#include "command.h"
#include "command_table.h"
#include "geometry/expression/nearest_name.h"
#include "render/external/library.h"
#include "render/image/image_error.h"

using namespace lekalo;

namespace {

// The examples come first: they say more than the list of options.
class ExamplesFirst : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    if (mode == CLI::AppFormatMode::Sub) return make_expanded(app);
    const std::string footer = app->get_footer();
    return make_description(app) + (footer.empty() ? "" : "\n" + footer + "\n\n") + make_usage(app, std::move(name)) +
           make_positionals(app) + make_groups(app, mode) + make_subcommands(app, mode);
  }
};

// What CLI11 found wrong, with the option that was probably meant.
std::string failure(const CLI::App* app, const CLI::Error& error) {
  const auto chosen = app->get_subcommands();
  const CLI::App* command = chosen.empty() ? app : chosen.front();
  std::string message = error.what();
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError)) {
    const std::vector<std::string> rest = app->remaining(true);
    const auto option = std::find_if(rest.begin(), rest.end(), [](const auto& word) { return word.starts_with("-"); });
    const std::string& unknown = option == rest.end() ? rest.front() : *option;
    std::vector<std::string> known;
    for (const CLI::Option* one : command->get_options())
      for (const std::string& name : one->get_lnames()) known.push_back("--" + name);
    const auto nearest = geometry::nearest_name(unknown.substr(0, unknown.find('=')), known);
    message = fmt::format("there is no {} '{}'{}", option == rest.end() ? "place for" : "option", unknown,
                          nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : "");
  }
  return fmt::format("{}\n'{} --help' shows how to use it\n", message,
                     command == app ? "lekalo" : "lekalo " + command->get_name());
}

// A library that calls exit() must not pass for success; nothing of this program's output is written any more.
void tell_early_end() {
  if (render::tell_library_call("ended the program")) _exit(command::kFileError);
}

// A file opened by this program must not become its standard output or error because that was closed. What stands in
// for them cannot be written either.
void hold_closed_files() {
  for (int file = 0; file <= STDERR_FILENO; ++file)
    if (fcntl(file, F_GETFD) < 0 && open("/dev/null", file == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) return;
}

ssize_t write_message(void*, const char* text, size_t size) {
  (void)!write(STDERR_FILENO, text, size);
  return static_cast<ssize_t>(size);
}

// A message that cannot be written (disk full, closed) ends no work: fmt throws where a stream fails, this one does
// not.
void lose_messages_quietly() {
  std::FILE* messages = fopencookie(nullptr, "w", {nullptr, write_message, nullptr, nullptr});
  if (!messages) return;
  std::setvbuf(messages, nullptr, _IONBF, 0);
  stderr = messages;
}

// `error_number`: why, 0 if it is not known any more. A pipe that nobody reads on needs no message.
int tell_lost_output(int error_number) {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  const bool unread = poll(&output, 1, 0) > 0 && (output.revents & POLLERR);
  if (!unread)
    fmt::print(stderr, "lekalo: standard output: cannot write{}{}\n", error_number ? ": " : " all of it",
               error_number ? std::strerror(error_number) : "");
  return command::kFileError;
}

int run(int argc, char** argv) {
  CLI::App app{"Renders and draws geometric models from scene files.\n\n  lekalo render scenes/primer/teapot.yaml\n",
               "lekalo"};
  app.formatter(std::make_shared<ExamplesFirst>());
  app.set_version_flag("--version", "lekalo " LEKALO_VERSION);
  app.require_subcommand(1);
  app.failure_message(failure);
  command::Action action;
  command::add_render(app, action);
  command::add_make(app, action);
  command::add_merge(app, action);
  command::add_farm(app, action);
  command::add_new(app, action);
  command::add_check(app, action);
  command::add_solve(app, action);
  command::add_evaluate(app, action);
  command::add_compare(app, action);
  command::add_test(app, action);
  command::add_measure(app, action);
  command::add_trace(app, action);
  command::add_draw(app, action);
  command::add_export(app, action);
  command::add_types(app, action);
  command::add_schema(app, action);
  command::add_completions(app, action);

  if (argc > 1 && argv[1][0] != '-') {
    std::vector<std::string> names;
    for (const CLI::App* sub : app.get_subcommands({})) names.push_back(sub->get_name());
    if (std::find(names.begin(), names.end(), argv[1]) == names.end()) {
      const auto nearest = geometry::nearest_name(argv[1], names);
      fmt::print(stderr, "there is no command '{}'{}\n'lekalo --help' lists them\n", argv[1],
                 nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : "");
      return command::kUsage;
    }
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? command::kDone : command::kUsage;
  }
  try {
    return action();
  } catch (const render::SceneError& error) {
    std::fputs(error.what(), stderr);
    return error.diagnostics().cannot_read() ? command::kFileError : command::kSceneError;
  } catch (const render::ImageError& error) {
    fmt::print(stderr, "lekalo: {}\n", error.what());
    return command::kFileError;
  } catch (const command::UsageError& error) {
    fmt::print(stderr, "lekalo: {}\n", error.what());
    return command::kUsage;
  } catch (const std::invalid_argument& error) {
    // What the scene asks of geometry that cannot be done.
    fmt::print(stderr, "lekalo: {}\n", error.what());
    return command::kSceneError;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "lekalo: not enough memory\n");
    return command::kFileError;
  } catch (const std::system_error& error) {
    if (std::ferror(stdout)) return tell_lost_output(error.code().value());
    fmt::print(stderr, "lekalo: {}\n", error.what());
    return command::kFileError;
  } catch (const std::exception& error) {
    fmt::print(stderr, "lekalo: {}\n", error.what());
    return command::kFileError;
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::atexit(tell_early_end);
  hold_closed_files();
  lose_messages_quietly();
  const int code = run(argc, argv);
  if (code == command::kFileError) return code;
  errno = 0;
  return std::fflush(stdout) != 0 || std::ferror(stdout) ? tell_lost_output(errno) : code;
}
