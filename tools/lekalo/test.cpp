// lekalo test: a regression suite of pictures and numbers.
#include <fmt/format.h>
#include <fnmatch.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <system_error>

#include "command.h"
#include "engine.h"
#include "geometry/expression/nearest_name.h"
#include "picture.h"
#include "render/image/atomic_file.h"
#include "render/image/image_error.h"
#include "suite.h"

namespace lekalo::command {

namespace {

struct Options {
  EngineOptions engine;
  std::string suite, report, junit, reason;
  std::vector<std::string> filters, accept;
  int jobs = 1;
  bool allow_external = false;
  bool json = false, quiet = false;
};

int accept_pictures(const Options& options, const render::Suite& suite) {
  if (options.reason.find_first_not_of(" \t\n") == std::string::npos || options.reason.find('\n') != std::string::npos)
    throw UsageError("--accept needs --reason TEXT: one line that says why the picture is right");
  for (const std::string& name : options.accept) {
    accept(suite, name, options.reason);
    if (!options.quiet) fmt::print("{}\n", golden_file(suite, name).string());
  }
  return kDone;
}

std::vector<std::string> selected(const Options& options, const render::Suite& suite) {
  std::vector<std::string> names, known;
  for (const render::SuiteTest& test : suite.tests) {
    known.push_back(test.name);
    const bool wanted = options.filters.empty() ||
                        std::any_of(options.filters.begin(), options.filters.end(), [&](const std::string& pattern) {
                          return fnmatch(pattern.c_str(), test.name.c_str(), 0) == 0;
                        });
    if (wanted) names.push_back(test.name);
  }
  if (!names.empty() || options.filters.empty()) return names;
  const auto nearest = geometry::nearest_name(options.filters.front(), known);
  throw UsageError(fmt::format("no test matches --filter {}{}", fmt::join(options.filters, " "),
                               nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : ""));
}

void print(const TestResult& result, size_t width) {
  const bool passed = result.verdict == Verdict::passed;
  fmt::print("{}  {:<{}}  {:6.2f} s  {}\n", passed ? "passed" : "FAILED", result.name, width, result.seconds,
             passed ? result.figures : "");
  for (const std::string& message : result.messages) {
    std::string text = "        " + message;
    for (size_t i = text.find('\n'); i != std::string::npos; i = text.find('\n', i + 1)) text.insert(i + 1, 8, ' ');
    fmt::print("{}\n", text);
  }
  std::fflush(stdout);
}

int exit_code(const std::vector<TestResult>& results) {
  Verdict worst = Verdict::passed;
  for (const TestResult& result : results) worst = std::max(worst, result.verdict);
  return worst == Verdict::passed        ? kDone
         : worst == Verdict::failed      ? kDiffers
         : worst == Verdict::scene_error ? kSceneError
                                         : kFileError;
}

void print_summary(const Options& options, const std::vector<TestResult>& results) {
  std::vector<std::string> failed;
  for (const TestResult& result : results)
    if (result.verdict != Verdict::passed) failed.push_back(result.name);
  if (failed.empty())
    fmt::print("all {} passed\n", results.size());
  else
    fmt::print("{} of {} failed: {}\n", failed.size(), results.size(), fmt::join(failed, ", "));
  if (!options.report.empty()) fmt::print("{}/index.html\n", options.report);
}

// Before the work of hours: --report and --junit can be written, and --junit is none of the suite's own files.
void check_outputs(const Options& options, const render::Suite& suite) {
  if (!options.report.empty()) {
    std::error_code told_below;
    std::filesystem::create_directories(options.report, told_below);
    check_writable({render::OutputFile{options.report + "/index.html", ""}});
  }
  if (options.junit.empty()) return;
  std::vector<std::filesystem::path> own{suite.file};
  for (const render::SuiteTest& test : suite.tests) {
    own.insert(own.end(), {test.scene, golden_file(suite, test.name), golden_note(suite, test.name),
                           result_file(suite, test.name)});
    own.insert(own.end(), test.includes.begin(), test.includes.end());
    for (const render::Expectation& expected : test.expectations)
      if (!expected.samples.empty()) own.push_back(expected.samples);
  }
  for (const std::filesystem::path& file : own)
    if (render::resolved_path(file) == render::resolved_path(options.junit))
      throw UsageError(fmt::format("--junit {}: this is a file of the suite and would be overwritten", options.junit));
  check_writable({render::OutputFile{options.junit, ""}});
}

int run(const Options& options) {
  options.engine.apply();
  const render::Suite suite = render::read_suite(options.suite);
  if (!options.accept.empty()) return accept_pictures(options, suite);
  if (!options.reason.empty()) throw UsageError("--reason belongs to --accept NAME");

  check_outputs(options, suite);
  std::error_code error;
  std::filesystem::create_directories(suite.results, error);
  if (error) throw render::ImageError(suite.results, "cannot make this folder: " + error.message(), "check the rights");
  RunOptions run;
  run.selected = selected(options, suite);
  run.jobs = options.jobs;
  run.threads = options.engine.threads;
  run.allow_external = options.allow_external;
  size_t width = 0;
  for (const std::string& name : run.selected) width = std::max(width, name.size());
  run.finished = [&](const TestResult& result) {
    if (!options.json && (!options.quiet || result.verdict != Verdict::passed)) print(result, width);
  };
  const auto results = run_suite(suite, run);
  if (!results) {
    fmt::print(stderr, "interrupted\n");
    return kInterrupted;
  }
  if (!options.junit.empty()) write_junit(options.junit, suite, *results);
  if (!options.report.empty()) write_suite_report(options.report, suite, *results);
  if (options.json)
    fmt::print("{}\n", results_as_json(*results));
  else if (!options.quiet)
    print_summary(options, *results);
  return exit_code(*results);
}

}  // namespace

void add_test(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("test", "Run a regression suite of pictures and numbers");
  sub->footer(
      "Examples:\n"
      "  lekalo test suite.yaml\n"
      "  lekalo test suite.yaml --filter 'fillet_*' --jobs 2 --report build/report --junit build/report/junit.xml\n"
      "  lekalo test suite.yaml --accept fillet_07 --reason 'new cap rule'\n\n"
      "Exit code 0: all as expected; 1: something differs, is missing, too slow or crashed; 3: a scene is wrong;\n"
      "4: a file cannot be read or written.");
  auto options = std::make_shared<Options>();
  sub->add_option("suite", options->suite, "suite file")->required()->type_name("SUITE");
  sub->add_option("--filter", options->filters, "only tests whose name matches, * stands for anything; repeatable")
      ->type_name("PATTERN");
  sub->add_option("--jobs", options->jobs, "tests at a time [1]")->check(CLI::Range(1, 1024));
  options->engine.add_to(*sub);
  add_allow_external(*sub, options->allow_external);
  sub->add_option("--report", options->report, "write a page with all pictures and figures")->type_name("DIR");
  sub->add_option("--junit", options->junit, "write the results as JUnit XML")->type_name("FILE");
  sub->add_option("--accept", options->accept, "make the last run's picture of this test golden; repeatable")
      ->type_name("NAME");
  sub->add_option("--reason", options->reason, "why; kept in golden/NAME.txt")->type_name("TEXT");
  sub->add_flag("--json", options->json, "print the results as JSON");
  sub->add_flag("--quiet", options->quiet, "print failures only");
  sub->callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace lekalo::command
