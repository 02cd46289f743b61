// The parts of `lekalo test`.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/suite/suite.h"

namespace lekalo::command {

enum class Verdict {
  passed,
  failed,       // something differs, a golden picture is missing, too slow, crashed
  scene_error,  // the scene is wrong
  file_error    // a file cannot be read or written
};

struct TestResult {
  std::string name;
  Verdict verdict = Verdict::passed;
  std::string figures;                // of the comparison, in a few words; empty: not compared
  std::vector<std::string> messages;  // what is wrong, each one or more lines
  double seconds = 0;
  bool has_picture = false;
};

// The picture of a test in the results folder, the golden one, and the text about the golden one.
std::filesystem::path result_file(const render::Suite& suite, const std::string& test);
std::filesystem::path golden_file(const render::Suite& suite, const std::string& test);
std::filesystem::path golden_note(const render::Suite& suite, const std::string& test);

// --- suite_judge.cpp: one test.

struct Judged {
  render::ComparisonResult comparison;
  std::string figures;
  bool passed = false;  // by every limit
};

// The test's picture against the golden one or that of the other test. Throws ImageError.
Judged judge_picture(const render::Suite& suite, const render::SuiteTest& test);

// Renders, looks at the numbers and, if `judge`, at the picture.
TestResult run_test(const render::Suite& suite, const render::SuiteTest& test, int threads, bool judge,
                    bool allow_external);

// --- suite_run.cpp: all tests, each in a process of its own, so that one that hangs or crashes is only itself lost.

struct RunOptions {
  std::vector<std::string> selected;  // tests to judge; others are run only where one of these needs their picture
  int jobs = 1;
  int threads = 0;              // of each test; 0: the cores shared by the jobs
  bool allow_external = false;  // scenes may run code from outside the program
  std::function<void(const TestResult&)> finished;
};

// Results of the selected tests in the suite's order; nothing if interrupted by Ctrl-C.
std::optional<std::vector<TestResult>> run_suite(const render::Suite& suite, const RunOptions& options);

// --- suite_output.cpp

// HTML pages with pictures and figures. Throws ImageError.
void write_suite_report(const std::filesystem::path& folder, const render::Suite& suite,
                        const std::vector<TestResult>& results);
// JUnit XML (the dialect that Jenkins and GitLab read). Throws ImageError.
void write_junit(const std::filesystem::path& file, const render::Suite& suite, const std::vector<TestResult>& results);
std::string results_as_json(const std::vector<TestResult>& results);

// --- suite_accept.cpp

// Makes the picture of the last run the golden one and writes down who did it, when and why. Throws UsageError if
// there is no such test or picture, ImageError.
void accept(const render::Suite& suite, const std::string& test, const std::string& reason);

}  // namespace lekalo::command
