// lekalo types: what scene files can name, from the declarations.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "command.h"
#include "geometry/expression/nearest_name.h"
#include "render/image/image_error.h"
#include "render/scene/manual/manual.h"
#include "render/scene/yaml/data_path.h"

namespace lekalo::command {

namespace {

struct Options {
  std::string name, folder;
};

void write_reference(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  for (const auto& [name, text] : render::reference_pages()) {
    std::ofstream file(folder / name, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw render::ImageError(folder / name, "cannot be written", "name a folder that you may write to");
  }
}

// A file that comes with the program, studio/softbox: what it says about itself, and its parameters.
bool describe_shipped(const std::string& name) {
  if (name.find('/') == std::string::npos || name.find("..") != std::string::npos) return false;
  for (const std::filesystem::path& folder : render::data_folders()) {
    const std::filesystem::path path = folder / (name.ends_with(".yaml") ? name : name + ".yaml");
    std::ifstream file(path);
    if (!file) continue;
    fmt::print("{} (shipped file)\n", name);
    bool begins = true;
    for (std::string line; std::getline(file, line);) {
      begins = begins && line.starts_with('#');
      if (begins) fmt::print("  {}\n", line.substr(std::min<size_t>(2, line.size())));
      if (line.starts_with("parameters:")) fmt::print("\n  {}\n", line);
    }
    return true;
  }
  return false;
}

int describe_one(const std::string& name) {
  bool found = false;
  std::vector<std::string> known;
  for (const render::TypeDeclaration& type : render::all_types()) {
    known.push_back(type.name);
    if (type.name != name) continue;
    fmt::print("{}{}", found ? "\n" : "", render::description_of(type));
    found = true;
  }
  if (const std::string section = render::description_of_section(name); !section.empty()) {
    fmt::print("{}{}", found ? "\n" : "", section);
    found = true;
  }
  if (name == "formulas") {
    fmt::print("{}{}", found ? "\n" : "", render::description_of_formulas());
    found = true;
  }
  if (name == "repeat") {
    fmt::print("{}{}", found ? "\n" : "", render::description_of_repeat());
    found = true;
  }
  if (const std::string style = render::description_of_style(name); !style.empty()) {
    fmt::print("{}{}", found ? "\n" : "", style);
    found = true;
  }
  found = describe_shipped(name) || found;
  if (found) return kDone;
  const auto nearest = geometry::nearest_name(name, known);
  std::string meant;
  if (nearest)
    meant = "'" + *nearest + "'";
  else
    for (const std::string& other : known)
      if (other.find(name) != std::string::npos) meant += (meant.empty() ? "'" : ", '") + other + "'";
  throw UsageError(fmt::format("there is no type called '{}'{}; 'lekalo types' lists them", name,
                               meant.empty() ? "" : fmt::format(" (did you mean {}?)", meant)));
}

}  // namespace

void add_types(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("types", "List the types that scene files can name, or explain one, or a section");
  sub->footer(
      "Examples:\n  lekalo types\n  lekalo types circle\n  lekalo types drawing\n  lekalo types formulas\n  lekalo "
      "types --markdown "
      "docs/reference");
  auto options = std::make_shared<Options>();
  auto* name = sub->add_option("type", options->name, "a type or a section to explain");
  sub->add_option("--markdown", options->folder, "write the reference manual into this folder")
      ->type_name("DIR")
      ->excludes(name);
  sub->callback([&action, options] {
    action = [options]() -> int {
      if (!options->folder.empty()) {
        write_reference(options->folder);
        return kDone;
      }
      if (!options->name.empty()) return describe_one(options->name);
      fmt::print("{}", render::list_of_types());
      return kDone;
    };
  });
}

}  // namespace lekalo::command
