// lekalo compare: how much two pictures differ, where, and whether that is too much.
#include "render/image/compare.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>

#include "command.h"
#include "render/suite/report.h"

namespace lekalo::command {

namespace {

struct Options {
  std::string a, b;
  std::string metric = "flip";
  std::optional<double> threshold;
  std::string layer;
  std::string report;
  bool json = false, quiet = false;
};

// JSON has no infinity: those figures are null there.
nlohmann::ordered_json to_json(const render::ComparisonResult& result) {
  const render::ErrorStatistics& error = result.statistics;
  nlohmann::ordered_json json;
  json["metric"] = render::metric_name(result.metric);
  json["value"] = result.value;
  json["threshold"] = result.threshold;
  json["passed"] = result.passed;
  json["layer"] = result.layer;
  json["size"] = {result.width, result.height};
  json["error"] = {{"mean", error.mean},
                   {"weighted_median", error.weighted_median},
                   {"weighted_first_quartile", error.weighted_first_quartile},
                   {"weighted_third_quartile", error.weighted_third_quartile},
                   {"minimum", error.minimum},
                   {"maximum", error.maximum},
                   {"maximum_pixel", {error.maximum_x, error.maximum_y}}};
  json["non_finite"] = {
      {"a", result.non_finite_a}, {"b", result.non_finite_b}, {"mismatches", result.non_finite_mismatches}};
  if (result.exposure_count > 0) {
    json["exposures"] = {
        {"start", result.start_exposure}, {"stop", result.stop_exposure}, {"count", result.exposure_count}};
  }
  return json;
}

void print_text(const render::ComparisonResult& result) {
  const render::ErrorStatistics& error = result.statistics;
  fmt::print("{} {:.6g}, {} {:.6g}: {}\n", render::metric_name(result.metric), result.value,
             render::larger_is_better(result.metric) ? "at least" : "at most", result.threshold,
             result.passed ? "passed" : "differs");
  fmt::print(
      "  error per pixel: mean {:.6g}, weighted quartiles {:.6g} {:.6g} {:.6g}, maximum {:.6g} at pixel ({}, {})\n",
      error.mean, error.weighted_first_quartile, error.weighted_median, error.weighted_third_quartile, error.maximum,
      error.maximum_x, error.maximum_y);
  if (result.exposure_count > 0) {
    fmt::print("  seen at {} exposures from {:.4f} to {:.4f} stops\n", result.exposure_count, result.start_exposure,
               result.stop_exposure);
  }
  if (result.non_finite_a + result.non_finite_b > 0) {
    fmt::print("  NaN or infinite: {} values of A, {} of B; {} pixels disagree\n", result.non_finite_a,
               result.non_finite_b, result.non_finite_mismatches);
  }
}

int run(const Options& options) {
  const render::ComparisonResult result = render::compare_images(
      options.a, options.b,
      {.metric = *render::metric_from_name(options.metric), .threshold = options.threshold, .layer = options.layer});
  if (!options.report.empty()) {
    render::write_report(
        options.report, fmt::format("{} and {}", options.a, options.b),
        {{.name = result.layer, .passed = result.passed, .note = "", .comparison = result, .picture = {}}});
  }
  if (options.json) {
    fmt::print("{}\n", to_json(result).dump(2));
  } else if (!options.quiet) {
    print_text(result);
    if (!options.report.empty()) fmt::print("  {}/index.html\n", options.report);
  }
  return result.passed ? kDone : kDiffers;
}

}  // namespace

void add_compare(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("compare", "Compare two pictures; exit code 1 if they differ too much");
  sub->footer(
      "Examples:\n"
      "  lekalo compare golden/ring.exr ring.exr --threshold 0.01 --report report\n"
      "  lekalo compare a.exr b.exr --layer depth --metric max --threshold 1e-5\n\n"
      "flip (mean FLIP error, HDR-FLIP between floating-point pictures), rmse and max are better when smaller,\n"
      "psnr (decibels) and ssim when larger. A is the reference.");
  auto options = std::make_shared<Options>();
  sub->add_option("a", options->a, "reference picture: EXR, PNG, JPEG, ...")->required()->type_name("A");
  sub->add_option("b", options->b, "picture to compare with it")->required()->type_name("B");
  sub->add_option("--metric", options->metric, "flip, rmse, psnr, ssim or max [flip]")
      ->type_name("NAME")
      ->check(CLI::IsMember({"flip", "rmse", "psnr", "ssim", "max"}));
  sub->add_option("--threshold", options->threshold, "worst value that passes [without: only equal pictures]")
      ->type_name("X")
      ->check(not_finite);
  sub->add_option("--layer", options->layer,
                  "color, normal, geometric_normal, depth, position, uv, albedo or an OpenEXR layer [color]")
      ->type_name("NAME");
  sub->add_option("--report", options->report, "write a page with both pictures and the error map")->type_name("DIR");
  sub->add_flag("--json", options->json, "print the figures as JSON");
  sub->add_flag("--quiet", options->quiet, "print nothing");
  sub->callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace lekalo::command
