// One test of a suite: its numbers and its picture.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <system_error>

#include "command.h"
#include "measure.h"
#include "picture.h"
#include "render/image/exr.h"
#include "render/image/image_error.h"
#include "render/trace/world.h"
#include "suite.h"

namespace lekalo::command {

namespace fs = std::filesystem;
using render::Expectation;
using render::Metric;
using render::PictureLimits;
using render::Suite;
using render::SuiteTest;

namespace {

render::LoadedScene load(const SuiteTest& test, bool allow_external) {
  render::LoadOptions options;
  options.allow_external = allow_external;
  for (const auto& [name, value] : test.set) options.set_parameters.push_back({name, value});
  for (const fs::path& file : test.includes) options.includes.push_back(file);
  return render::load_scene(test.scene, options);
}

// Length, area and volume; a message for each that is not as expected.
void check_measures(const Expectation& expected, const render::Entity& entity, std::vector<std::string>& messages) {
  const ordered_json found = measures(expected.name, entity);
  for (const auto& [figure, number] : expected.measures) {
    if (!found.contains(figure)) {
      messages.push_back(fmt::format("'{}' has no {}: it is a {}{}", expected.name, figure,
                                     found["kind"].get<std::string>(),
                                     found.value("closed", true) ? "" : " that is not closed"));
      continue;
    }
    const double value = found[figure].get<double>();
    const double allowed = expected.tolerance * (number != 0 ? std::abs(number) : 1);
    if (std::abs(value - number) <= allowed) continue;
    messages.push_back(fmt::format("{} of '{}' is {}, expected {}: {:.3g} apart, at most {:.3g}", figure, expected.name,
                                   digits(value), digits(number), std::abs(value - number), allowed));
  }
}

void check_samples(const Expectation& expected, const render::Entity& entity, std::vector<std::string>& messages) {
  const ordered_json found = compare_with_table(expected.name, entity, load_table(expected.samples.string()),
                                                expected.samples.string(), expected.tolerance);
  if (found["passed"].get<bool>()) return;
  messages.push_back(fmt::format("'{}' lies {:.6g} away from {}:{}, at most {:.3g} is allowed", expected.name,
                                 found["maximum_distance"].get<double>(), expected.samples.string(),
                                 found["worst"][0]["line"].get<int>(), expected.tolerance));
}

void check_numbers(const Expectation& expected, const render::LoadedScene& scene, std::vector<std::string>& messages) {
  const render::Entity& entity = find_geometry(scene, expected.name);
  if (expected.samples.empty())
    check_measures(expected, entity, messages);
  else
    check_samples(expected, entity, messages);
}

void render_picture(const Suite& suite, const SuiteTest& test, const render::LoadedScene& scene, int threads) {
  const auto model = std::make_shared<render::Model>(*scene.model);
  apply({test.size, test.samples, test.representation, test.integrator}, *model);
  model->film.layers.clear();  // all, whatever the scene keeps
  const render::World world(model);
  render::RenderOptions settings;
  settings.threads = threads;
  settings.identity = scene.hash;
  render::RenderResult result = render::render(world, settings);
  add_metadata(result, *model, test.scene.string(), false);
  render::write_exr(result_file(suite, test.name), result.image);
}

Verdict verdict_of(const render::SceneError& error) {
  return error.diagnostics().cannot_read() ? Verdict::file_error : Verdict::scene_error;
}

std::string limit_text(const std::optional<double>& limit, const char* words) {
  return limit ? fmt::format(" ({} {:.4g})", words, *limit) : "";
}

}  // namespace

fs::path result_file(const Suite& suite, const std::string& test) { return suite.results / (test + ".exr"); }
fs::path golden_file(const Suite& suite, const std::string& test) { return suite.golden / (test + ".exr"); }
fs::path golden_note(const Suite& suite, const std::string& test) { return suite.golden / (test + ".txt"); }

Judged judge_picture(const Suite& suite, const SuiteTest& test) {
  const PictureLimits& limits = test.limits;
  render::CompareOptions options{.metric = limits.metric, .threshold = std::nullopt, .layer = test.layer};
  const bool flip = limits.metric == Metric::flip, least = render::larger_is_better(limits.metric);
  options.threshold = flip ? limits.mean : least ? limits.minimum : limits.maximum;
  if (flip && !limits.mean && limits.maximum) options.threshold = 1;  // no mean error is larger
  const fs::path expected = test.against.empty() ? golden_file(suite, test.name) : result_file(suite, test.against);
  Judged judged;
  judged.comparison = render::compare_images(expected, result_file(suite, test.name), options);
  const render::ComparisonResult& result = judged.comparison;
  judged.passed = result.passed && (!flip || !limits.maximum || result.statistics.maximum <= *limits.maximum);
  if (flip)
    judged.figures = fmt::format("flip mean {:.4g}{}, maximum {:.4g}{}", result.value,
                                 limits.mean || limits.maximum ? limit_text(limits.mean, "at most") : " (at most 0)",
                                 result.statistics.maximum, limit_text(limits.maximum, "at most"));
  else
    judged.figures = fmt::format("{} {:.4g} ({} {:.4g})", render::metric_name(result.metric), result.value,
                                 least ? "at least" : "at most", result.threshold);
  if (result.non_finite_mismatches > 0)
    judged.figures += fmt::format(", {} pixels are not finite in one picture only", result.non_finite_mismatches);
  return judged;
}

TestResult run_test(const Suite& suite, const SuiteTest& test, int threads, bool judge, bool allow_external) {
  TestResult result;
  result.name = test.name;
  const auto fail = [&](Verdict verdict, std::string message) {
    result.verdict = std::max(result.verdict, verdict);
    while (message.ends_with('\n')) message.pop_back();
    result.messages.push_back(std::move(message));
  };
  try {
    const render::LoadedScene scene = load(test, allow_external);
    for (const Expectation& expected : test.expectations) {
      if (!judge) break;
      std::vector<std::string> messages;
      try {
        check_numbers(expected, scene, messages);
      } catch (const UsageError& error) {
        fail(Verdict::failed, error.what());
      } catch (const render::SceneError& error) {
        fail(verdict_of(error), error.what());
      }
      for (std::string& message : messages) fail(Verdict::failed, std::move(message));
    }
    render_picture(suite, test, scene, threads);
    result.has_picture = true;
    if (!judge) return result;
    if (test.against.empty() && !fs::exists(golden_file(suite, test.name))) {
      fail(Verdict::failed, fmt::format("{} is missing; if {} is right: lekalo test {} --accept {} --reason TEXT",
                                        golden_file(suite, test.name).string(), result_file(suite, test.name).string(),
                                        suite.file.string(), test.name));
      return result;
    }
    const Judged judged = judge_picture(suite, test);
    result.figures = judged.figures;
    if (!judged.passed)
      fail(Verdict::failed, fmt::format("differs from {}: {}", judged.comparison.path_a, judged.figures));
  } catch (const render::SceneError& error) {
    fail(verdict_of(error), error.what());
  } catch (const render::ImageError& error) {
    fail(Verdict::file_error, error.what());
  } catch (const std::bad_alloc&) {
    fail(Verdict::failed, "not enough memory");
  } catch (const std::exception& error) {
    fail(Verdict::failed, error.what());
  }
  return result;
}

}  // namespace lekalo::command
