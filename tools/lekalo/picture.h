// From a loaded scene to picture files: what render, make and test share.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/film/render.h"
#include "render/scene/build/load.h"

namespace lekalo::command {

// What a command asks for instead of what the scene says.
struct PictureOverrides {
  std::optional<std::pair<int, int>> size;  // pixels
  std::optional<int> samples;
  std::optional<render::Representation> representation;
  render::IntegratorPtr integrator;
};

void apply(const PictureOverrides& overrides, render::Model& model);

// What --size and --crop say. Both throw UsageError; a crop lies inside the model's picture.
std::pair<int, int> parse_size(const std::string& text);
void set_crop(const std::string& text, render::Model& model);

// Version, scene (its name without folders), samples, title and parameters; with `stamp` also the date, and the
// machine and the scene's full path unless SOURCE_DATE_EPOCH gives the date.
void add_metadata(render::RenderResult& result, const render::Model& model, const std::string& scene_file, bool stamp);

// Throws ImageError if one of the files could not be written: before hours of tracing, not after.
void check_writable(const std::vector<render::OutputFile>& files);

// Throws UsageError if one of the outputs is a file that the scene was read from.
void check_inputs_stay(const render::LoadedScene& scene, const std::vector<std::string>& outputs);
// Throws UsageError if `path`, whose name follows from that of an output, exists and does not begin as `what` does: it
// is somebody else's.
void check_is_ours(const std::filesystem::path& path, std::string_view beginning, const char* what);

// Names the defaults taken that show in what is made: in pictures (`renders`), in drawings (`draws`).
void print_defaults(const render::LoadedScene& scene, bool renders, bool draws);

// Bodies so clear that the classic light model draws nothing of their shadows: "'lens'"; empty if there are none.
std::string without_shadow(const render::Model& model);

// What the scene shows that only drawings have: "lines (silhouette), annotations"; empty if there is nothing.
std::string left_to_drawings(const render::Model& model);

// EXR, or PNG by the output's display transform, with the colour bars of the model's drawing that tell its scale.
// Atomic. Throws ImageError.
void write_picture(const render::OutputFile& file, const render::RenderResult& result, const render::Model& model);

// The moment of the run in UTC, or that of SOURCE_DATE_EPOCH: "2026-11-21", "2026-11-21T20:05:17Z".
std::string date_text(bool with_time);

}  // namespace lekalo::command
