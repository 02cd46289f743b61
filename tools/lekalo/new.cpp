// lekalo new: a commented scene to start from.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>

#include "command.h"
#include "render/image/atomic_file.h"
#include "starting_files.h"

namespace lekalo::command {

namespace {

struct Options {
  std::string name, kind = "picture";
};

std::string with_name(std::string text, const std::string& name) {
  constexpr std::string_view placeholder = "NAME";
  for (size_t at = text.find(placeholder); at != std::string::npos; at = text.find(placeholder, at + name.size()))
    text.replace(at, placeholder.size(), name);
  return text;
}

// "ring", "ring.yaml", "figures/ring.lekalo.yaml": the file; its name without the endings.
std::filesystem::path file_named(const std::string& name) {
  return name.ends_with(".yaml") || name.ends_with(".yml") ? name : name + ".yaml";
}

std::string stem_of(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  const std::string_view ending = ".lekalo";
  return stem.ends_with(ending) ? stem.substr(0, stem.size() - ending.size()) : stem;
}

// The name stands in plain words of the file, and as a file's name in its comments.
void check_name(const std::string& stem) {
  const auto is_plain = [](unsigned char c) { return c < 0x80 && (std::isalnum(c) || c == '_' || c == '-'); };
  if (stem.empty() || !std::all_of(stem.begin(), stem.end(), is_plain) || stem.front() == '-')
    throw UsageError(fmt::format("'{}': the name of a scene has letters, digits, _ and - only", stem));
}

void write_new(const std::filesystem::path& file, const std::string& text) {
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(file, ignored)))
    throw UsageError(fmt::format("'{}' exists; give another name", file.string()));
  render::write_file_atomically(file, text);
  fmt::print("{}\n", file.string());
}

// The comments name the file as it is called.
std::string starting_text(const char* text, const std::filesystem::path& file, const std::string& stem) {
  std::string result = text;
  const std::string named = "NAME.yaml";
  const std::string name = file.filename().string();
  for (size_t at = result.find(named); at != std::string::npos; at = result.find(named, at + name.size()))
    result.replace(at, named.size(), name);
  return with_name(result, stem);
}

int write_starting_file(const Options& options) {
  const std::filesystem::path file = file_named(options.name);
  const std::string stem = stem_of(file);
  check_name(stem);
  const auto* found = std::find_if(std::begin(kStartingFiles), std::end(kStartingFiles),
                                   [&](const StartingFile& one) { return one.kind == options.kind; });
  write_new(file, starting_text(found->text, file, stem));
  if (options.kind == "suite")
    write_new(file.parent_path() / (stem + "_scene.yaml"), starting_text(kSceneOfSuite, file, stem));
  return kDone;
}

std::vector<std::string> kinds() {
  std::vector<std::string> names;
  for (const StartingFile& one : kStartingFiles) names.emplace_back(one.kind);
  return names;
}

}  // namespace

void add_new(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("new", "Write a commented scene to start from");
  sub->footer(
      "Examples:\n"
      "  lekalo new ring\n"
      "  lekalo new figures/block --kind drawing\n\n"
      "Writes NAME.yaml, never over a file that exists. A suite comes with a scene that it tests.");
  auto options = std::make_shared<Options>();
  sub->add_option("name", options->name, "name of the scene, with or without .yaml")->required()->type_name("NAME");
  sub->add_option("--kind", options->kind, "what it makes")
      ->type_name("KIND")
      ->capture_default_str()
      ->check(CLI::IsMember(kinds()));
  sub->callback([&action, options] { action = [options] { return write_starting_file(*options); }; });
}

}  // namespace lekalo::command
