#include "render/suite/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <system_error>

#include "render/image/atomic_file.h"
#include "render/image/colormap.h"
#include "render/image/image_error.h"
#include "render/image/png.h"

namespace lekalo::render {
namespace {

constexpr std::string_view kStyle = R"(
:root { --page: #fff; --ink: #1b1b1f; --soft: #6a6a72; --line: #d8d8de; --card: #f4f4f6; --ok: #1a7f4b; --bad: #b3261e; }
@media (prefers-color-scheme: dark) {
  :root { --page: #17171a; --ink: #ececf0; --soft: #9a9aa4; --line: #36363d; --card: #202024; --ok: #4cc38a; --bad: #ff7b72; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1500px; padding: 24px; background: var(--page); color: var(--ink);
  font: 15px/1.5 system-ui, sans-serif; }
h1 { font-size: 24px; margin: 0 0 4px; }
h2 { font-size: 17px; margin: 0; overflow-wrap: anywhere; }
.soft { color: var(--soft); }
.verdict { font-weight: 600; }
.ok { color: var(--ok); }
.bad { color: var(--bad); }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: 3px 18px 3px 0; border-bottom: 1px solid var(--line); font-weight: normal; }
th { color: var(--soft); }
td.number { text-align: right; }
.bar { position: sticky; top: 0; z-index: 1; display: flex; flex-wrap: wrap; gap: 16px; align-items: center;
  padding: 10px 0; margin-bottom: 12px; background: var(--page); border-bottom: 1px solid var(--line); }
.summary { margin-bottom: 24px; }
.summary a { color: inherit; }
section { background: var(--card); border: 1px solid var(--line); border-radius: 8px; padding: 16px; margin: 0 0 20px; }
.head { display: flex; flex-wrap: wrap; gap: 4px 14px; align-items: baseline; margin-bottom: 10px; }
.panels { display: grid; grid-template-columns: repeat(auto-fit, minmax(300px, 1fr)); gap: 14px; margin-bottom: 12px; }
figure { margin: 0; min-width: 0; }
.frame { overflow: auto; border: 1px solid var(--line); background: #777; line-height: 0; }
.frame img { width: 100%; height: auto; }
.pixels .frame { max-height: 640px; }
.pixels .frame img { width: auto; image-rendering: pixelated; }
figcaption { font-size: 13px; color: var(--soft); margin-bottom: 4px; overflow-wrap: anywhere; }
figcaption b { color: var(--ink); }
.blinking figcaption b { color: var(--bad); }
.scale { display: flex; gap: 8px; align-items: center; font-size: 12px; color: var(--soft); margin-top: 5px; }
.scale i { flex: 1; height: 10px; border-radius: 2px; }
button { font: inherit; font-size: 13px; padding: 2px 12px; border: 1px solid var(--line); border-radius: 6px;
  background: var(--page); color: var(--ink); cursor: pointer; }
button[aria-pressed=true] { background: var(--ink); color: var(--page); }
.figures { display: flex; flex-wrap: wrap; gap: 4px 24px; margin: 0; font-size: 14px; }
.figures div { display: flex; gap: 8px; }
.figures dt { color: var(--soft); }
.figures dd { margin: 0; font-variant-numeric: tabular-nums; }
.note { white-space: pre-wrap; margin: 0 0 10px; }
.only-failed section.passed { display: none; }
)";

constexpr std::string_view kScript = R"(
'use strict';
// Blink: the left panel shows A and B in turn, every half second, in the same place.
for (const section of document.querySelectorAll('section')) {
  const button = section.querySelector('button.blink');
  if (!button) continue;
  const figure = section.querySelector('figure'), image = figure.querySelector('img');
  const label = figure.querySelector('b'), file = figure.querySelector('span');
  const sides = [...section.querySelectorAll('figure')].slice(0, 2).map(f => ({
    source: f.querySelector('img').getAttribute('src'),
    label: f.querySelector('b').textContent, file: f.querySelector('span').textContent }));
  let side = 0, timer = 0;
  const show = s => { side = s; image.src = sides[s].source; label.textContent = sides[s].label; file.textContent = sides[s].file; };
  button.addEventListener('click', () => {
    const on = !timer;
    if (on) timer = setInterval(() => show(1 - side), 500); else { clearInterval(timer); timer = 0; show(0); }
    button.setAttribute('aria-pressed', on);
    figure.classList.toggle('blinking', on);
  });
}
const toggle = (id, name) => {
  const button = document.getElementById(id);
  if (button) button.addEventListener('click', () =>
    button.setAttribute('aria-pressed', document.body.classList.toggle(name)));
};
toggle('pixels', 'pixels');
toggle('only-failed', 'only-failed');
)";

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string number(double value) {
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  return fmt::format("{:.6g}", value);
}

bool is_bounded(Metric metric) { return metric == Metric::flip || metric == Metric::ssim; }

// The error that has the brightest colour: 1 where errors have a scale of their own, else the largest finite one.
double brightest_error(const ComparisonResult& result) {
  if (is_bounded(result.metric)) return 1;
  double largest = 0;
  for (const float value : result.error.values) {
    if (std::isfinite(value)) largest = std::max(largest, static_cast<double>(value));
  }
  return largest > 0 ? largest : 1;
}

DisplayImage heat_map(const ErrorMap& error, double brightest) {
  DisplayImage image{.width = error.width, .height = error.height, .samples = {}, .text = {}};
  image.samples.reserve(3 * error.values.size());
  for (const float value : error.values) {
    for (const std::uint8_t level : magma(value / brightest)) image.samples.push_back(level);
  }
  return image;
}

std::string magma_gradient() {
  std::string css = "linear-gradient(90deg";
  for (int i = 0; i <= 16; ++i) {
    const auto [r, g, b] = magma(i / 16.0);
    css += fmt::format(",#{:02x}{:02x}{:02x}", r, g, b);
  }
  return css + ")";
}

const char* metric_label(Metric metric) {
  switch (metric) {
    case Metric::flip:
      return "FLIP, mean";
    case Metric::rmse:
      return "RMSE";
    case Metric::psnr:
      return "PSNR (dB)";
    case Metric::ssim:
      return "SSIM, mean";
    case Metric::max:
      break;
  }
  return "largest difference";
}

const char* error_label(Metric metric) {
  switch (metric) {
    case Metric::flip:
      return "FLIP error";
    case Metric::ssim:
      return "1 − SSIM";
    default:
      return "Absolute difference";
  }
}

std::string limit_text(const ComparisonResult& result) {
  return (larger_is_better(result.metric) ? "at least " : "at most ") + number(result.threshold);
}

std::string verdict(bool passed) {
  return passed ? "<span class=\"verdict ok\">✓ passed</span>" : "<span class=\"verdict bad\">✗ failed</span>";
}

std::string figures(const ComparisonResult& result) {
  std::string html = "<dl class=\"figures\">\n";
  const auto add = [&](std::string_view term, const std::string& value) {
    html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", term, value);
  };
  const ErrorStatistics& s = result.statistics;
  add(metric_label(result.metric), number(result.value));
  add("limit", limit_text(result));
  add("size", fmt::format("{} × {}", result.width, result.height));
  add("layer", escaped(result.layer));
  if (result.metric != Metric::flip) add("error: mean", number(s.mean));
  add(result.metric == Metric::flip ? "weighted median" : "error: weighted median", number(s.weighted_median));
  add("weighted quartiles", number(s.weighted_first_quartile) + ", " + number(s.weighted_third_quartile));
  add("minimum", number(s.minimum));
  add("maximum", fmt::format("{} at pixel ({}, {})", number(s.maximum), s.maximum_x, s.maximum_y));
  if (result.exposure_count > 0) {
    add("exposures", fmt::format("{:.4f} to {:.4f} stops, {} steps", result.start_exposure, result.stop_exposure,
                                 result.exposure_count));
  }
  if (result.non_finite_a + result.non_finite_b > 0) {
    add("not finite", fmt::format("{} values of A, {} of B; <span class=\"{}\">{} pixels disagree</span>",
                                  result.non_finite_a, result.non_finite_b,
                                  result.non_finite_mismatches > 0 ? "bad" : "soft", result.non_finite_mismatches));
  }
  return html + "</dl>\n";
}

std::string panel(int width, int height, std::string_view label, std::string_view file, std::string_view png,
                  std::string_view below) {
  return fmt::format(
      "<figure><figcaption><b>{0}</b> <span>{1}</span></figcaption><div class=\"frame\"><img src=\"{2}\" width=\"{3}\" "
      "height=\"{4}\" alt=\"{0}\"></div>{5}</figure>\n",
      label, escaped(file), png, width, height, below);
}

// The panels of entry number `i`, whose three pictures are written beside the page.
std::string panels(const std::filesystem::path& folder, std::size_t i, const ComparisonResult& result) {
  const auto png = [&](std::string_view what) { return fmt::format("{:04}-{}.png", i, what); };
  const double brightest = brightest_error(result);
  write_png(folder / png("a"), result.shown_a);
  write_png(folder / png("b"), result.shown_b);
  write_png(folder / png("error"), heat_map(result.error, brightest));
  const std::string scale =
      fmt::format("<div class=\"scale\"><span>0</span><i></i><span>{}</span></div>", number(brightest));
  const int width = result.width, height = result.height;
  return "<div class=\"panels\">\n" + panel(width, height, "A", result.path_a, png("a"), "") +
         panel(width, height, "B", result.path_b, png("b"), "") +
         panel(width, height, error_label(result.metric), "", png("error"), scale) + "</div>\n";
}

std::string section(const std::filesystem::path& folder, std::size_t i, const ReportEntry& entry) {
  std::string html = fmt::format("<section id=\"t{}\" class=\"{}\">\n<div class=\"head\"><h2>{}</h2>{}", i,
                                 entry.passed ? "passed" : "failed", escaped(entry.name), verdict(entry.passed));
  if (entry.comparison) {
    html += fmt::format(
        "<span class=\"soft\">{} {}, {}</span>\n<button class=\"blink\" aria-pressed=\"false\">Blink A / B</button>",
        metric_label(entry.comparison->metric), number(entry.comparison->value), limit_text(*entry.comparison));
  }
  html += "</div>\n";
  if (!entry.note.empty()) html += fmt::format("<p class=\"note\">{}</p>\n", escaped(entry.note));
  if (entry.comparison) html += panels(folder, i, *entry.comparison) + figures(*entry.comparison);
  if (!entry.comparison && entry.picture) {
    const std::string png = fmt::format("{:04}-b.png", i);
    write_png(folder / png, *entry.picture);
    html += fmt::format("<div class=\"panels\">\n{}</div>\n",
                        panel(entry.picture->width, entry.picture->height, "B", "", png, ""));
  }
  return html + "</section>\n";
}

std::string summary(const std::vector<ReportEntry>& entries, const std::vector<std::size_t>& shown_order) {
  std::string html =
      "<table class=\"summary\">\n<tr><th>test</th><th>result</th><th>metric</th><th>value</th><th>limit</th></tr>\n";
  for (const std::size_t i : shown_order) {
    const ReportEntry& entry = entries[i];
    html += fmt::format("<tr><td><a href=\"#t{}\">{}</a></td><td>{}</td>", i + 1, escaped(entry.name),
                        verdict(entry.passed));
    if (entry.comparison) {
      html += fmt::format("<td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td></tr>\n",
                          metric_label(entry.comparison->metric), number(entry.comparison->value),
                          limit_text(*entry.comparison));
    } else {
      html += "<td colspan=\"3\" class=\"soft\">not compared</td></tr>\n";
    }
  }
  return html + "</table>\n";
}

}  // namespace

void write_report(const std::filesystem::path& folder, const std::string& title,
                  const std::vector<ReportEntry>& entries) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw ImageError(folder, "cannot make this folder: " + error.message(), "choose another folder");

  std::vector<std::size_t> shown_order(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) shown_order[i] = i;
  std::stable_partition(shown_order.begin(), shown_order.end(), [&](std::size_t i) { return !entries[i].passed; });
  const auto failed = std::count_if(entries.begin(), entries.end(), [](const ReportEntry& e) { return !e.passed; });

  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}</title>\n"
      "<style>{1}.scale i {{ background: {2}; }}\n</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
      escaped(title), kStyle, magma_gradient());
  html += failed == 0 ? fmt::format("<div class=\"verdict ok\">✓ all {} passed</div>\n", entries.size())
                      : fmt::format("<div class=\"verdict bad\">✗ {} of {} failed</div>\n", failed, entries.size());
  html += "<div class=\"bar\"><button id=\"pixels\" aria-pressed=\"false\">Pixel for pixel</button>";
  if (entries.size() > 1) html += "<button id=\"only-failed\" aria-pressed=\"false\">Only failed</button>";
  html += "</div>\n";
  if (entries.size() > 1) html += summary(entries, shown_order);
  for (const std::size_t i : shown_order) html += section(folder, i + 1, entries[i]);
  html += fmt::format("<script>{}</script>\n</body>\n</html>\n", kScript);
  write_file_atomically(folder / "index.html", html);
}

}  // namespace lekalo::render
