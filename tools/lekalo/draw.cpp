// lekalo draw: a scene as a drawing of lines, hidden ones told apart.
#include "draw.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "command.h"
#include "engine.h"
#include "picture.h"
#include "progress.h"
#include "render/cameras/kept_points.h"
#include "render/drawing/figure.h"
#include "render/drawing/output/cairo_output.h"
#include "render/drawing/output/dxf.h"
#include "render/drawing/output/latex.h"
#include "render/drawing/output/svg.h"
#include "render/drawing/output/tikz.h"
#include "render/image/atomic_file.h"

namespace lekalo::command {

namespace {

struct Options {
  SceneOptions scene;
  EngineOptions engine;
  std::string size, crop;
  std::vector<std::string> outputs;
  double width = 0;  // millimetres; 0: the page's
  DrawSettings settings;
};

// The page keeps its width, and has as many pixels.
void set_size(const std::pair<int, int>& size, render::Model& model) {
  PictureOverrides overrides;
  overrides.size = size;
  apply(overrides, model);
  model.paper.height = model.paper.width * size.second / size.first;
  model.paper.auto_width = model.paper.auto_height = false;
}

std::filesystem::path overlay_of(const std::string& drawing) {
  return std::filesystem::path(drawing).replace_extension(".tex");
}

bool is_tikz(const std::string& path) { return path.ends_with(".tikz") || path.ends_with(".tex"); }

// Whether LaTeX can set its texts over it. TikZ files have theirs set by LaTeX in any case.
bool takes_overlay(const std::string& path) { return path.ends_with(".pdf") || path.ends_with(".png"); }

void check_name_for_latex(const std::string& path) {
  if (!render::latex_takes_file(std::filesystem::path(path).filename().string()))
    throw UsageError(fmt::format("'{}': LaTeX takes no file with # % $ \\ {{ }} \" in its name", path));
}

void check_overwriting(const render::LoadedScene& scene, const std::vector<render::OutputFile>& outputs, bool latex) {
  std::vector<std::string> written;
  for (const render::OutputFile& file : outputs) {
    written.push_back(file.path);
    if (latex || is_tikz(file.path)) check_name_for_latex(file.path);
    // A .tex file may be somebody's document.
    if (file.path.ends_with(".tex")) check_is_ours(file.path, render::kTikzMagic, "TikZ picture");
    if (!latex || !takes_overlay(file.path)) continue;
    const std::string overlay = overlay_of(file.path).string();
    if (std::any_of(outputs.begin(), outputs.end(), [&](const auto& other) { return other.path == overlay; }))
      throw UsageError(fmt::format("'{}': the texts over '{}' are written there", overlay, file.path));
    written.push_back(overlay);
    check_is_ours(overlay, render::kOverlayMagic, "LaTeX file");
  }
  check_inputs_stay(scene, written);
}

void check_kind(const std::string& path, const DrawSettings& settings) {
  if (!is_drawn(path)) throw UsageError(fmt::format("'{}': draw writes svg, pdf, png, dxf, tikz and tex", path));
  if (settings.latex && !takes_overlay(path) && !is_tikz(path))
    throw UsageError(fmt::format("'{}': --latex is for pdf and png files", path));
  if (path.ends_with(".tex") && !settings.standalone)
    throw UsageError(fmt::format("'{}': a .tex file is a document: add --standalone, or write a .tikz file", path));
}

int draw(const Options& options) {
  options.engine.apply();
  const render::KeptPoints kept;  // cameras of panels frame their objects as they are read
  const render::LoadedScene scene = options.scene.load();
  if (!options.settings.quiet) print_defaults(scene, false, true);
  std::vector<render::OutputFile> outputs;
  for (const std::string& path : options.outputs) {
    check_kind(path, options.settings);
    outputs.push_back({path, "drawing"});
  }
  if (options.outputs.empty())
    for (const render::OutputFile& file : scene.model->outputs)
      if (file.kind == "drawing" &&
          !(options.settings.latex && (file.path.ends_with(".svg") || file.path.ends_with(".dxf"))))
        outputs.push_back(file);
  const bool lacks_overlay =
      options.settings.latex &&
      std::none_of(outputs.begin(), outputs.end(), [](const auto& file) { return takes_overlay(file.path); });
  if (lacks_overlay && !options.outputs.empty())
    throw UsageError(fmt::format("'{}': --latex is for pdf and png files", outputs.front().path));
  if (outputs.empty() || lacks_overlay)
    outputs.push_back(
        {std::filesystem::path(options.scene.file).stem().string() + (options.settings.latex ? ".pdf" : ".svg"),
         "drawing"});
  if (options.settings.standalone &&
      std::none_of(outputs.begin(), outputs.end(), [](const auto& file) { return is_tikz(file.path); }))
    throw UsageError(fmt::format("'{}': --standalone is for tikz and tex files", outputs.front().path));
  if (options.width > 0)
    for (render::OutputFile& file : outputs) file.width = options.width;
  check_overwriting(scene, outputs, options.settings.latex);
  const auto model = std::make_shared<render::Model>(*scene.model);
  if (!options.size.empty()) set_size(parse_size(options.size), *model);
  if (!options.crop.empty()) set_crop(options.crop, *model);
  DrawSettings settings = options.settings;
  settings.threads = options.engine.threads;
  draw_files(model, outputs, settings);
  return kDone;
}

// As many pixels to the millimetre as the scene's pictures have.
void write_pixels(const std::string& path, const render::Sheet& sheet, const render::Model& model) {
  const double scale = 1 / render::millimetres_of_pixel(model);
  const auto pixels = [&](double length) { return std::max(1, static_cast<int>(std::lround(length * scale))); };
  render::write_png(path, render::pixels_of(sheet, pixels(sheet.width), pixels(sheet.height)));
}

// Its pictures, if it has any, stand in PNG files beside it.
void write_tikz(const std::string& path, const render::Sheet& sheet, const DrawSettings& settings) {
  const std::filesystem::path file(path);
  const render::TikzDrawing drawing = render::tikz_of(sheet, file.stem().string(), settings.standalone);
  for (const render::TikzDrawing::Picture& picture : drawing.pictures) {
    const std::filesystem::path beside = file.parent_path() / picture.file;
    render::write_file_atomically(beside, picture.bytes);
    if (!settings.quiet) fmt::print(stderr, "{}\n", beside.string());
  }
  render::write_file_atomically(path, drawing.text);
}

void write_dxf(const std::string& path, const render::Sheet& sheet, const DrawSettings& settings) {
  const render::DxfDrawing drawing = render::dxf_of(sheet);
  render::write_file_atomically(path, drawing.text);
  if (settings.quiet) return;
  for (const std::string& note : drawing.notes) fmt::print(stderr, "note: {}\n", note);
}

// What files of the same panel and width share.
struct Drawn {
  std::string panel;
  double width = 0;
  render::Figure figure;
};

void print_statistics(const render::Figure& figure, double seconds) {
  const render::LineStatistics& s = figure.statistics;
  fmt::print(stderr, "{} lines in {} pieces; {} crossings in the picture, {} rays\n", s.lines, s.pieces, s.crossings,
             s.rays);
  const double page = seconds - figure.seconds_of_world - s.seconds_of_lines - s.seconds_of_crossings -
                      s.seconds_of_rays - figure.seconds_of_ground;
  fmt::print(stderr,
             "world {:.3f} s, lines {:.3f} s, crossings {:.3f} s, rays {:.3f} s, ground {:.3f} s, page and texts "
             "{:.3f} s, in all {:.3f} s\n",
             figure.seconds_of_world, s.seconds_of_lines, s.seconds_of_crossings, s.seconds_of_rays,
             figure.seconds_of_ground, page, seconds);
}

}  // namespace

bool is_drawn(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  return ending == ".svg" || ending == ".pdf" || ending == ".png" || ending == ".dxf" || ending == ".tikz" ||
         ending == ".tex";
}

void draw_files(const std::shared_ptr<const render::Model>& model, const std::vector<render::OutputFile>& outputs,
                const DrawSettings& settings) {
  std::vector<Drawn> all;
  for (const render::OutputFile& file : outputs) {
    auto found = std::find_if(all.begin(), all.end(),
                              [&](const Drawn& one) { return one.panel == file.panel && one.width == file.width; });
    if (found == all.end()) {
      const auto begin = std::chrono::steady_clock::now();
      Progress progress(settings.quiet);
      render::FigureOptions options;
      options.panel = file.panel, options.width = file.width;
      options.progress = options.rendering = [&](double done) { progress(done); };
      options.threads = settings.threads;
      all.push_back({file.panel, file.width, render::figure_of(model, options)});
      found = std::prev(all.end());
      progress.end();
      const render::Figure& figure = found->figure;
      if (!settings.quiet) {
        for (const std::string& note : figure.notes) fmt::print(stderr, "note: {}\n", note);
        for (const std::string& what : figure.left_out) fmt::print(stderr, "note: not in the drawing: {}\n", what);
      }
      for (const std::string& cut : figure.cut_off) fmt::print(stderr, "warning: {}\n", cut);
      if (figure.incomplete > 0)
        fmt::print(stderr, "warning: of {} surface{} not all lines are known: they nearly touch or coincide ({})\n",
                   figure.incomplete, figure.incomplete == 1 ? "" : "s", fmt::join(figure.incomplete_objects, ", "));
      if (figure.open_areas > 0)
        fmt::print(stderr,
                   "warning: the borders of {} filled area{} are not known all around; straight lines close them\n",
                   figure.open_areas, figure.open_areas == 1 ? "" : "s");
      if (settings.stats)
        print_statistics(figure, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    const render::Sheet whole = found->figure.sheet;
    const bool with_overlay = settings.latex && takes_overlay(file.path);
    const render::Sheet sheet = with_overlay ? render::without_texts(whole) : whole;
    const std::string texts =
        with_overlay ? render::latex_overlay(whole, std::filesystem::path(file.path).filename().string()) : "";
    const std::string ending = std::filesystem::path(file.path).extension().string();
    if (ending == ".svg")
      render::write_file_atomically(file.path, render::svg_of(sheet, {settings.outlines}));
    else if (is_tikz(file.path))
      write_tikz(file.path, sheet, settings);
    else if (ending == ".dxf")
      write_dxf(file.path, sheet, settings);
    else if (ending == ".pdf")
      render::write_file_atomically(file.path, render::pdf_of(sheet));
    else
      write_pixels(file.path, sheet, *model);
    if (!settings.quiet) fmt::print(stderr, "{}\n", file.path);
    if (!with_overlay) continue;
    const std::filesystem::path overlay = overlay_of(file.path);
    render::write_file_atomically(overlay, texts);
    if (!settings.quiet) fmt::print(stderr, "{}\n", overlay.string());
  }
}

void add_draw(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand(
      "draw", "Draw a scene as lines (SVG, PDF, PNG, DXF, TikZ), visible and hidden ones told apart");
  sub->footer(
      "Examples:\n"
      "  lekalo draw ring.yaml -o ring.svg -o ring.pdf\n"
      "  lekalo draw ring.yaml -o ring.tikz\n"
      "  lekalo draw plate.yaml --stats\n\n"
      "Which lines are drawn and what becomes of hidden ones the objects' `lines` say, else the drawing's. Without -o "
      "the\n"
      "scene's drawings are made, or SCENE.svg.");
  auto options = std::make_shared<Options>();
  options->scene.add_to(*sub);
  sub->add_option(
         "-o,--output", options->outputs,
         "file to write (svg, pdf, png, dxf, tikz; tex with --standalone) in place of the scene's outputs; repeatable")
      ->type_name("FILE");
  sub->add_option("--size", options->size, "pixels of the page, which keeps its width: of png files, of the ground")
      ->type_name("WxH");
  sub->add_option("--width", options->width, "millimetres of the drawing; texts and lines keep their size")
      ->check(CLI::Range(1.0, 5000.0))
      ->check(not_finite)
      ->type_name("MM");
  sub->add_option("--crop", options->crop, "only this part of the page, in pixels")->type_name("X0,Y0,X1,Y1");
  options->engine.add_to(*sub);
  sub->add_flag("--latex", options->settings.latex, "texts in FILE.tex, for LaTeX to set over the drawing (pdf, png)");
  sub->add_flag("--standalone", options->settings.standalone, "tikz and tex files as documents of their own");
  sub->add_flag("--outlines", options->settings.outlines, "texts of svg files as outlines in place of text and fonts");
  sub->add_flag("--quiet", options->settings.quiet, "no progress and no notes");
  sub->add_flag("--stats", options->settings.stats, "print how many lines and pieces there are, and times");
  sub->callback([&action, options] { action = [options] { return draw(*options); }; });
}

}  // namespace lekalo::command
