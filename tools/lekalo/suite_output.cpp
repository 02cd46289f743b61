// What a run of a suite leaves for people and for other programs: HTML, JUnit XML, JSON.
#include <fmt/format.h>

#include <algorithm>

#include "json.h"
#include "render/image/atomic_file.h"
#include "render/image/exr.h"
#include "render/image/layers.h"
#include "render/scene/values/characters.h"
#include "render/scene/yaml/include.h"
#include "render/suite/report.h"
#include "suite.h"

namespace lekalo::command {

namespace fs = std::filesystem;
using render::Suite;

namespace {

constexpr size_t kLongestNote = 1 << 20;

const char* word(Verdict verdict) {
  switch (verdict) {
    case Verdict::passed:
      return "passed";
    case Verdict::failed:
      return "failed";
    case Verdict::scene_error:
      return "scene_error";
    case Verdict::file_error:
      break;
  }
  return "file_error";
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

// The last line of golden/NAME.txt: why the golden picture is as it is.
std::string last_reason(const Suite& suite, const std::string& test) {
  std::string why;
  const auto text = render::read_file(golden_note(suite, test), kLongestNote, true, why);
  if (!text) return {};
  const size_t end = text->find_last_not_of("\n ");
  if (end == std::string::npos) return {};
  const size_t begin = text->rfind('\n', end);
  const size_t first = begin == std::string::npos ? 0 : begin + 1;
  return text->substr(first, end + 1 - first);
}

// The compared layer of a test's picture, as a display shows it.
render::DisplayImage shown(const Suite& suite, const render::SuiteTest& test) {
  const fs::path file = result_file(suite, test.name);
  const render::Layer layer = render::select_layer(render::read_exr(file), test.layer, file);
  return render::quantize(render::display_values(layer, render::finite_range(layer.image)));
}

}  // namespace

void write_suite_report(const fs::path& folder, const Suite& suite, const std::vector<TestResult>& results) {
  std::vector<render::ReportEntry> entries;
  for (const TestResult& result : results) {
    const render::SuiteTest& test = *suite.find(result.name);
    render::ReportEntry entry{.name = result.name,
                              .passed = result.verdict == Verdict::passed,
                              .note = joined(result.messages),
                              .comparison = {},
                              .picture = {}};
    if (entry.note.empty()) entry.note = result.figures;
    if (test.against.empty())
      if (const std::string reason = last_reason(suite, result.name); !reason.empty())
        entry.note += fmt::format("{}golden picture: {}", entry.note.empty() ? "" : "\n", reason);
    if (!result.figures.empty())
      entry.comparison = judge_picture(suite, test).comparison;
    else if (result.has_picture)
      entry.picture = shown(suite, test);
    entries.push_back(std::move(entry));
  }
  render::write_report(folder, suite.file.string(), entries);
}

void write_junit(const fs::path& file, const Suite& suite, const std::vector<TestResult>& results) {
  const auto count = [&](auto&& is) { return std::count_if(results.begin(), results.end(), is); };
  double seconds = 0;
  for (const TestResult& result : results) seconds += result.seconds;
  const std::string name = render::xml_text(suite.file.stem().string());
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  xml += fmt::format("<testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\">\n", name,
                     results.size(), count([](const TestResult& r) { return r.verdict == Verdict::failed; }),
                     count([](const TestResult& r) { return r.verdict > Verdict::failed; }), seconds);
  for (const TestResult& result : results) {
    xml += fmt::format("<testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"", name, render::xml_text(result.name),
                       result.seconds);
    if (result.verdict == Verdict::passed) {
      xml += "/>\n";
      continue;
    }
    const char* element = result.verdict == Verdict::failed ? "failure" : "error";
    const std::string first = result.messages.empty() ? "" : result.messages.front();
    xml += fmt::format(">\n<{0} message=\"{1}\" type=\"{2}\">{3}</{0}>\n</testcase>\n", element,
                       render::xml_text(first.substr(0, first.find('\n'))), word(result.verdict),
                       render::xml_text(joined(result.messages)));
  }
  xml += "</testsuite>\n</testsuites>\n";
  render::write_file_atomically(file, xml);
}

std::string results_as_json(const std::vector<TestResult>& results) {
  ordered_json all = ordered_json::array();
  for (const TestResult& result : results)
    all.push_back({{"name", result.name},
                   {"verdict", word(result.verdict)},
                   {"passed", result.verdict == Verdict::passed},
                   {"figures", result.figures},
                   {"messages", result.messages},
                   {"seconds", result.seconds}});
  return all.dump(2, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace lekalo::command
