// lekalo check: all errors of a scene, nothing made.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <exception>

#include "command.h"
#include "json.h"

namespace lekalo::command {

namespace {

using render::Diagnostic;
using render::Place;
using render::Severity;

struct Options {
  SceneOptions scene;
  bool json = false;
};

ordered_json text_or_null(const std::string& text) { return text.empty() ? ordered_json(nullptr) : ordered_json(text); }

// Null where there is no file, no line.
void add_place(ordered_json& out, const Place& place) {
  const bool has_line = place.file && place.line > 0;
  out["file"] = place.file ? ordered_json(place.file->name) : ordered_json(nullptr);
  out["line"] = has_line ? ordered_json(place.line) : ordered_json(nullptr);
  out["column"] = has_line ? ordered_json(place.column) : ordered_json(nullptr);
  out["length"] = has_line ? ordered_json(place.length) : ordered_json(nullptr);
}

const char* word_of(Severity severity) {
  return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "note";
}

ordered_json as_json(const Diagnostic& found) {
  ordered_json out;
  out["severity"] = word_of(found.severity);
  add_place(out, found.place);
  out["message"] = found.message;
  out["hint"] = text_or_null(found.hint);
  out["replacement"] = text_or_null(render::replacement_of(found));
  out["notes"] = ordered_json::array();
  for (const Diagnostic& note : found.notes) out["notes"].push_back(as_json(note));
  out["included_from"] = ordered_json::array();
  if (found.place.file)
    for (Place from = found.place.file->included_from; from.file; from = from.file->included_from) {
      ordered_json place;
      add_place(place, from);
      out["included_from"].push_back(place);
    }
  return out;
}

// What went wrong without a place in a scene file.
Diagnostic without_place(const std::string& message) { return {Severity::error, {}, message, {}, {}}; }

int print_report(const Options& options, const render::LoadedScene* scene, const std::vector<Diagnostic>& found,
                 size_t more, int code) {
  ordered_json out;
  out["file"] = options.scene.file;
  out["good"] = code == kDone;
  out["diagnostics"] = ordered_json::array();
  for (const Diagnostic& one : found) out["diagnostics"].push_back(as_json(one));
  out["more"] = more;
  if (scene) {
    out["entities"] = scene->model->geometry.size();
    out["objects"] = scene->model->objects.size();
    out["lights"] = scene->model->lights.size();
  }
  // Scenes may hold bytes that are no UTF-8, and messages quote them.
  fmt::print("{}\n", out.dump(2, ' ', false, ordered_json::error_handler_t::replace));
  return code;
}

std::vector<Diagnostic> diagnostics_of(const std::vector<render::ExternalNote>& notes) {
  std::vector<Diagnostic> found;
  for (const render::ExternalNote& note : notes) {
    found.push_back(render::Diagnostics::note(note.place, note.text));
    for (const std::string& doubt : note.doubts) found.push_back({Severity::warning, note.place, doubt, {}, {}});
  }
  return found;
}

int check_as_json(const Options& options) {
  const render::LoadOptions load = options.scene.load_options();
  try {
    const render::LoadedScene scene = render::load_scene(options.scene.file, load);
    return print_report(options, &scene, diagnostics_of(scene.external_notes), 0, kDone);
  } catch (const render::SceneError& error) {
    const render::Diagnostics& all = error.diagnostics();
    return print_report(options, nullptr, all.sorted(), all.dropped(), all.cannot_read() ? kFileError : kSceneError);
  } catch (const std::invalid_argument& error) {
    return print_report(options, nullptr, {without_place(error.what())}, 0, kSceneError);
  } catch (const std::exception& error) {
    return print_report(options, nullptr, {without_place(error.what())}, 0, kFileError);
  }
}

int check(const Options& options) {
  if (options.json) return check_as_json(options);
  const render::LoadedScene scene = render::load_scene(options.scene.file, options.scene.load_options());
  print_external_notes(scene, true);
  fmt::print("{}: good: {} entities, {} objects, {} lights\n", options.scene.file, scene.model->geometry.size(),
             scene.model->objects.size(), scene.model->lights.size());
  return kDone;
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("check", "Read a scene and report all its errors");
  sub->footer("Examples:\n  lekalo check ring.yaml\n  lekalo check ring.yaml --json");
  auto options = std::make_shared<Options>();
  options->scene.add_to(*sub);
  sub->add_flag("--json", options->json, "print the errors and warnings as JSON, for editors and scripts");
  sub->callback([&action, options] { action = [options] { return check(*options); }; });
}

}  // namespace lekalo::command
